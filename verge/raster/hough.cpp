// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>

#include "verge/raster/blocks.hpp"
#include "verge/raster/hough_axis.hpp"

namespace verge::raster {
namespace {

/// The bins of a block: one load, one sum, one store. A block of 4 x 4 falls into at most 6.
using Lanes = std::array<std::uint16_t, 8>;

constexpr int kLargest = kBlockSides.front() * kBlockSides.front();
constexpr std::int64_t kOne = std::int64_t{1} << HoughAxis::kBits;

/// How the pixels of a block fall into bins at one angle. That depends only on where between two bins its
/// upper left pixel lies, its fraction; and from one threshold of the fraction to the next it stays the same.
class Stamp {
 public:
  Stamp(const HoughAxis& axis, int side) {
    std::vector<Pixel> pixels = pixels_of(axis, side);
    for (const Pixel& pixel : pixels) first_bin_ = std::min(first_bin_, pixel.bin);
    Lanes lanes{};
    for (const Pixel& pixel : pixels) ++lanes.at(lane_of(pixel));
    std::ranges::sort(pixels, {}, &Pixel::threshold);
    fill(pixels, lanes);
    std::size_t rank = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      while (thresholds_.at(rank) <= static_cast<std::int64_t>(bucket) << kBucketShift) ++rank;
      ranks_.at(bucket) = static_cast<std::uint8_t>(rank);
    }
  }

  /// Adds a block whose upper left pixel has these HoughAxis::steps; `zero` is the bin of rho = 0.
  void add(std::int64_t steps, std::uint16_t* zero) const {
    const std::int64_t fraction = steps & (kOne - 1);
    std::size_t rank = ranks_[static_cast<std::size_t>(fraction >> kBucketShift)];
    while (fraction >= thresholds_[rank]) ++rank;
    std::uint16_t* const at = zero + first_bin_ + (steps >> HoughAxis::kBits);
    Lanes sum;  // copied out and in, so that the compiler may add all lanes at once
    std::memcpy(&sum, at, sizeof sum);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = static_cast<std::uint16_t>(sum[i] + lanes_[rank][i]);
    std::memcpy(at, &sum, sizeof sum);
  }

 private:
  static constexpr std::size_t kBuckets = 256;
  static constexpr int kBucketShift = HoughAxis::kBits - 8;

  /// `bin` is where the pixel lies while the fraction is below its threshold, from the upper left one's on.
  struct Pixel {
    int bin = 0;
    std::int64_t threshold = 0;
  };

  static std::vector<Pixel> pixels_of(const HoughAxis& axis, int side) {
    std::vector<Pixel> pixels;
    for (int row = 0; row < side; ++row) {
      for (int col = 0; col < side; ++col) {
        const std::int64_t steps = col * axis.right() + row * axis.down();
        pixels.push_back({static_cast<int>(steps >> HoughAxis::kBits), kOne - (steps & (kOne - 1))});
      }
    }
    return pixels;
  }

  [[nodiscard]] std::size_t lane_of(const Pixel& pixel) const {
    return static_cast<std::size_t>(pixel.bin - first_bin_);
  }

  /// A set of lanes for each stretch of the fraction; pixels move on by one bin at their thresholds.
  void fill(const std::vector<Pixel>& sorted, Lanes lanes) {
    thresholds_.fill(std::numeric_limits<std::int64_t>::max());
    lanes_.front() = lanes;
    std::size_t rank = 0;
    for (std::size_t i = 0; i < sorted.size() && sorted[i].threshold < kOne; ++i) {
      if (i == 0 || sorted[i].threshold != sorted[i - 1].threshold)
        thresholds_.at(rank++) = sorted[i].threshold;
      --lanes.at(lane_of(sorted[i]));
      ++lanes.at(lane_of(sorted[i]) + 1);
      lanes_.at(rank) = lanes;
    }
  }

  int first_bin_ = 0;
  std::array<std::int64_t, kLargest> thresholds_{};  // ascending; the last is never reached
  std::array<Lanes, kLargest> lanes_{};
  std::array<std::uint8_t, kBuckets> ranks_{};  // by the fraction's first bits: lanes to begin the search at
};

int reach_of(const Picture& picture) {
  if (picture.grey.empty()) return 0;
  return static_cast<int>(std::ceil(std::hypot(picture.rows - 1, picture.cols - 1)));
}

}  // namespace

double hough_theta_rad(int angle, int angles) {
  return std::numbers::pi * (static_cast<double>(angle) / angles - 0.5);
}

double Accumulator::theta_rad(int angle) const { return hough_theta_rad(angle, angles); }

std::span<const std::uint16_t> Accumulator::column(int angle) const {
  const auto size = static_cast<std::size_t>(bins());
  return std::span(counts).subspan(static_cast<std::size_t>(angle) * size, size);
}

std::uint16_t Accumulator::at(int angle, int rho) const {
  return column(angle)[static_cast<std::size_t>(std::ptrdiff_t{rho} + reach)];
}

struct HoughTransform::Tables {
  struct Angle {
    HoughAxis axis;
    std::array<Stamp, kBlockSides.size() - 1> stamps;  // single pixels need none
  };
  std::vector<Angle> angles;
};

HoughTransform::HoughTransform(int angles) {
  assert(angles >= 1);
  static_assert(kBlockSides.size() == 3 && kBlockSides.back() == 1);
  Tables tables;
  tables.angles.reserve(static_cast<std::size_t>(angles));
  for (int angle = 0; angle < angles; ++angle) {
    const HoughAxis axis(hough_theta_rad(angle, angles));
    tables.angles.push_back({axis, {Stamp(axis, kBlockSides[0]), Stamp(axis, kBlockSides[1])}});
  }
  tables_ = std::make_shared<const Tables>(std::move(tables));
}

Accumulator HoughTransform::operator()(const Picture& picture) const {
  // Lanes without a pixel in them may lie beyond either end of a column.
  constexpr std::ptrdiff_t kSpare = std::tuple_size_v<Lanes>;
  const Blocks blocks = blocks_of(picture);
  Accumulator result{static_cast<int>(tables_->angles.size()), reach_of(picture), {}};
  result.counts.reserve(tables_->angles.size() * static_cast<std::size_t>(result.bins()));
  std::vector<std::uint16_t> column(static_cast<std::size_t>(result.bins() + 2 * kSpare));
  std::uint16_t* const zero = column.data() + kSpare + result.reach;
  for (const auto& [axis, stamps] : tables_->angles) {
    std::ranges::fill(column, std::uint16_t{0});
    for (std::size_t size = 0; size < stamps.size(); ++size) {
      for (const BlockCorner block : blocks[size]) stamps[size].add(axis.steps(block.col, block.row), zero);
    }
    for (const BlockCorner pixel : blocks.back()) ++zero[axis.rho(pixel.col, pixel.row)];
    result.counts.insert(result.counts.end(), column.begin() + kSpare, column.end() - kSpare);
  }
  return result;
}

}  // namespace verge::raster
