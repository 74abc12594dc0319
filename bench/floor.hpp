// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace verge::bench {

/// The least that anything that looks at every point of a scan can do: polynomial angle, bin of 1 degree by
/// 0.5 m (to 120 m), lowest z kept. Other programs and our own stages are given as multiples of it, measured
/// beside them, because milliseconds do not carry over from one machine to the next.
class Floor {
 public:
  Floor();
  /// One pass over the points; the lowest z of each bin, metres.
  std::span<const float> run(std::span<const float> x, std::span<const float> y, std::span<const float> z);

 private:
  std::vector<float> lowest_;
};

}  // namespace verge::bench
