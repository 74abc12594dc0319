// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Decodes a recording of an ibeo scanner and prints the columns of its scans as numbers of this machine, for
// tests/oracle/ibeo_decoder.py to compare with its own.
//
//     ibeo_columns lux|alasca FILE
//
// A scan: 'S', stamp (0 or 1, int64 ns), number of points and of times (uint32), then x, y, z (float32), ring
// (int64), echo (uint8), flags (uint32), pulse width (float32), time (float64), column by column. A part that
// is damaged: 'E'.
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"

namespace {

using namespace verge;

template <class T>
void print(const T& value) {
  std::fwrite(&value, sizeof(T), 1, stdout);
}

template <class T>
void print(const std::vector<T>& column) {
  if (!column.empty()) std::fwrite(column.data(), sizeof(T), column.size(), stdout);
}

void print_scan(const io::Decoded& scan) {
  const Cloud& cloud = scan.cloud;
  print('S');
  print(static_cast<std::uint8_t>(scan.stamp_ns ? 1 : 0));
  print(scan.stamp_ns.value_or(0));
  print(static_cast<std::uint32_t>(cloud.x.size()));
  print(static_cast<std::uint32_t>(cloud.time_s.size()));
  print(cloud.x);
  print(cloud.y);
  print(cloud.z);
  print(cloud.ring);
  print(cloud.echo);
  print(cloud.flags);
  print(cloud.pulse_width);
  print(cloud.time_s);
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", to_string(error).c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  auto input = io::Input::open(argv[2], {});
  if (!input) return fail(input.error());
  const bool lux = std::string_view(argv[1]) == "lux";
  auto recording = lux ? io::open_ibeo(std::move(*input)) : io::open_alasca(std::move(*input));
  if (!recording) return fail(recording.error());
  while (true) {
    const auto scan = (*recording)->next();
    if (scan && !*scan) return 0;
    if (scan) {
      print_scan(**scan);
    } else {
      print('E');
    }
  }
}
