// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough_axis.hpp"

#include <cmath>

namespace verge::raster {
namespace {

std::int64_t whole_steps(double pixels) { return std::llround(std::ldexp(pixels, HoughAxis::kBits)); }

}  // namespace

HoughAxis::HoughAxis(double theta_rad)
    : right_(whole_steps(std::cos(theta_rad))), down_(whole_steps(std::sin(theta_rad))) {}

}  // namespace verge::raster
