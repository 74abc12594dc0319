// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/raster/picture.hpp"

namespace verge::raster {

/// How edges are found in a grey picture. Paper 2 names Canny (title page, keywords) and as the most common
/// ones Sobel, Prewitt and Laplacian (III; P2-28).
enum class EdgeFilter : std::uint8_t {
  kNone,  ///< The picture as it is: squares are marks already, and Canny outlines each of them (A1.3 d).
  kCanny,
  kSobel,
  kPrewitt,
  kLaplacian,
};

}  // namespace verge::raster

namespace verge {
template <>
inline constexpr std::array enum_names<raster::EdgeFilter> =
    std::to_array<std::string_view>({"none", "canny", "sobel", "prewitt", "laplacian"});
}  // namespace verge

namespace verge::raster {

struct EdgeOptions {
  EdgeFilter filter = EdgeFilter::kNone;
  /// Standard deviation of a Gaussian before the filter, pixels; 0: none. Without a filter it plays no part.
  double gaussian_px = 0.0;
  /// A pixel is an edge where the filter answers with more than this share of its answer to a straight step
  /// from 0 to 255.
  double threshold = 0.5;
  /// Canny's second threshold, at most the other: edges are followed as far as the answer is above it.
  double low_threshold = 0.2;
};

/// The edges in a picture: 255 on an edge, 0 elsewhere. The filters other than Canny do not thin: both pixels
/// beside a step are edges. Beyond the picture its outermost pixels go on. An empty picture has no edges. The
/// result depends on the arguments alone, and the thread that calls does the work, as long as no other calls
/// at the same time.
[[nodiscard]] Picture find_edges(const Picture& picture, const EdgeOptions& options);

}  // namespace verge::raster
