// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "verge/detect/registry.hpp"
#include "verge/io/source.hpp"

int main(int argc, char** argv) {
  auto source = verge::io::open(argc > 1 ? argv[1] : "verge-demo/LIDAR_TOP");
  if (!source) {
    std::cerr << to_string(source.error()) << '\n';
    return 1;
  }
  const auto detector = verge::detect::make("gradient");
  while (true) {
    const auto scan = (*source)->next();  // a scan, none at the end, or why this one cannot be used
    if (!scan) {
      std::cerr << to_string(scan.error()) << '\n';
      continue;
    }
    if (!*scan) break;
    for (const verge::Boundary& boundary : detector->process(**scan).boundaries) {
      std::cout << (*scan)->frame << ": " << name_of(boundary.side) << ", " << boundary.points.size()
                << " points, confidence " << boundary.confidence << '\n';
    }
  }
}
