// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "verge/core/vec.hpp"

namespace verge::fit {

/// How the parameters of key points Q_0 .. Q_n are spread over [0, 1] (paper 3, III-3).
enum class Parameterization : std::uint8_t {
  /// u_k = u_{k-1} + sqrt|Q_k - Q_{k-1}| / sum sqrt|Q_k - Q_{k-1}|: the paper's word, with the radicals that
  /// its
  /// print lost (Piegl and Tiller, The NURBS Book, 2nd ed., Eq. 9.6).
  kCentripetal,
  /// u_k = u_{k-1} + |Q_k - Q_{k-1}| / sum |Q_k - Q_{k-1}|: what its formula says once the sum is not
  /// repeated
  /// in each step, which would make u_k = k (Eq. 9.4 and 9.5).
  kChordLength,
};

/// Where the interior knots of a clamped knot vector stand.
enum class KnotPlacement : std::uint8_t {
  kAveraged,  ///< By the parameters: each knot has points on both sides (Eq. 9.8, or 9.68 and 9.69).
  kUniform,   ///< u_{j+p} = j / (n - p + 1), the "uniform non-periodic" of the paper's title.
};

/// The parameters u_0 = 0 <= .. <= u_n = 1, both ends exact. None for fewer than 2 points or for points that
/// all coincide.
[[nodiscard]] std::optional<std::vector<double>> parameters(std::span<const Vec2> points,
                                                            Parameterization kind);

/// Clamped knots for interpolation, paper 3 Eq. (5) (Eq. 9.8): u_{j+p} = (1/p) sum_{i=j}^{j+p-1} u_i,
/// j = 1 .. n-p, for n + 1 parameters and as many control points. Needs n >= p >= 1.
[[nodiscard]] std::vector<double> averaged_knots(std::span<const double> parameters, std::size_t degree);

/// Clamped knots with evenly spread interior, u_{j+p} = j / (n - p + 1), for n + 1 control points. n >= p.
[[nodiscard]] std::vector<double> uniform_knots(std::size_t control_points, std::size_t degree);

/// Clamped knots for least squares with fewer control points (n + 1) than parameters, so that every span
/// holds parameters (Eq. 9.68 and 9.69). Needs p <= n < number of parameters.
[[nodiscard]] std::vector<double> least_squares_knots(std::span<const double> parameters,
                                                      std::size_t control_points, std::size_t degree);

}  // namespace verge::fit
