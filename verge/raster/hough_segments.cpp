// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "verge/raster/hough_axis.hpp"

namespace verge::raster {
namespace {

/// The stations of a peak's marked pixels along its line, metres, ascending.
class Stations {
 public:
  Stations(const Picture& picture, const Grid& grid, const HoughPeak& peak)
      : picture_(picture),
        grid_(grid),
        peak_(peak),
        axis_(peak.theta_rad),
        along_(to_metres(peak, grid).along()) {
    const double right = std::cos(peak.theta_rad);
    const double down = std::sin(peak.theta_rad);
    if (std::fabs(right) >= std::fabs(down)) {
      for (int row = 0; row < picture.rows; ++row) {
        for (const int col : around((peak.rho_px - row * down) / right)) take(col, row);
      }
    } else {
      for (int col = 0; col < picture.cols; ++col) {
        for (const int row : around((peak.rho_px - col * right) / down)) take(col, row);
      }
    }
    std::ranges::sort(stations_m_);
  }

  [[nodiscard]] std::span<const double> metres() const { return stations_m_; }

 private:
  /// A bin is at most sqrt(2) pixels wide along a row or a column.
  static std::array<int, 3> around(double place) {
    const int nearest = static_cast<int>(std::lround(place));
    return {nearest - 1, nearest, nearest + 1};
  }

  void take(int col, int row) {
    if (!picture_.is_marked(row, col) || axis_.rho(col, row) != peak_.rho_px) return;
    const Vec2 centre{static_cast<double>(col), static_cast<double>(row)};
    stations_m_.push_back(dot(along_, to_metres(grid_, centre)));
  }

  const Picture& picture_;
  const Grid& grid_;
  const HoughPeak& peak_;
  HoughAxis axis_;
  Vec2 along_;
  std::vector<double> stations_m_;
};

constexpr double kRounding_m = 1e-9;  // a gap of 30 cells of 0.1 m is 3 m, whatever the last bit says

/// The segments of one peak; `origin` is the point of its line at station 0.
std::vector<HoughSegment> segments_of(std::span<const double> stations_m, Vec2 origin, Vec2 along,
                                      const SegmentOptions& options) {
  std::vector<HoughSegment> segments;
  for (std::size_t begin = 0, i = 1; i <= stations_m.size(); ++i) {
    if (i < stations_m.size() && stations_m[i] - stations_m[i - 1] <= options.fill_gap_m + kRounding_m)
      continue;
    if (stations_m[i - 1] - stations_m[begin] >= options.min_length_m - kRounding_m) {
      segments.push_back({.from = origin + stations_m[begin] * along,
                          .to = origin + stations_m[i - 1] * along,
                          .pixels = static_cast<int>(i - begin)});
    }
    begin = i;
  }
  return segments;
}

}  // namespace

Vec2 NormalLine::along() const { return {std::cos(theta_rad), -std::sin(theta_rad)}; }

double NormalLine::signed_distance(Vec2 p) const {
  return p.x * std::sin(theta_rad) + p.y * std::cos(theta_rad) - distance_m;
}

Vec2 NormalLine::foot(Vec2 p) const {
  return p - signed_distance(p) * Vec2{std::sin(theta_rad), std::cos(theta_rad)};
}

NormalLine to_metres(const HoughPeak& peak, const Grid& grid) {
  return {peak.theta_rad, grid.y_max_m * std::cos(peak.theta_rad) + grid.x_max_m * std::sin(peak.theta_rad) -
                              grid.cell_m * peak.rho_px};
}

std::vector<HoughSegment> hough_segments(const Picture& picture, const Grid& grid,
                                         std::span<const HoughPeak> peaks, const SegmentOptions& options) {
  std::vector<HoughSegment> all;
  for (std::size_t peak = 0; peak < peaks.size(); ++peak) {
    const NormalLine line = to_metres(peaks[peak], grid);
    const Stations stations(picture, grid, peaks[peak]);
    auto segments = segments_of(stations.metres(), line.foot({0.0, 0.0}), line.along(), options);
    if (options.max_len && segments.size() > 1) {
      segments = {*std::ranges::max_element(segments, {}, &HoughSegment::length_m)};
    }
    for (HoughSegment& segment : segments) {
      segment.peak = peak;
      all.push_back(segment);
    }
  }
  return all;
}

}  // namespace verge::raster
