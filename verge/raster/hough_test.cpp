// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/hough.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/raster/hough_peaks.hpp"
#include "verge/raster/test_pictures.hpp"

namespace verge::raster {
namespace {

/// Every marked pixel at every angle, in real numbers, as the paper says it (III-A).
/// The cosine of 60 degrees is a half, and not the double below it: halves are told with a little slack.
std::vector<std::uint16_t> exhaustive(const Picture& picture, int angles) {
  const int reach = static_cast<int>(std::ceil(std::hypot(picture.rows - 1.0, picture.cols - 1.0)));
  const auto bins = static_cast<std::size_t>(2 * reach + 1);
  std::vector<std::uint16_t> counts(static_cast<std::size_t>(angles) * bins);
  for (int angle = 0; angle < angles; ++angle) {
    const double theta = deg_to_rad(-90.0 + angle * 180.0 / angles);
    const double c = std::cos(theta);
    const double s = std::sin(theta);
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        if (picture.at(y, x) == 0) continue;
        const auto bin = static_cast<std::size_t>(std::floor(x * c + y * s + 0.5 + 1e-9) + reach);
        ++counts[static_cast<std::size_t>(angle) * bins + bin];
      }
    }
  }
  return counts;
}

TEST(Hough, EqualsTheExhaustiveAccumulator) {
  struct Case {
    int rows, cols, angles;
    double share;
    int side;
  };
  const std::vector<Case> cases = {
      {1, 1, 180, 1.0, 1},      {1, 200, 180, 0.3, 1},     {200, 1, 180, 0.3, 3}, {90, 128, 180, 0.1, 1},
      {131, 129, 180, 0.01, 3}, {127, 190, 180, 0.004, 5}, {60, 70, 180, 1.0, 1}, {70, 65, 720, 0.05, 2},
      {80, 64, 7, 0.05, 4},     {40, 50, 1, 0.2, 2},       {3, 8192, 36, 0.5, 3}, {501, 601, 180, 0.002, 5}};
  unsigned seed = 1;
  for (const Case& c : cases) {
    const Picture picture = testing::sown(c.rows, c.cols, c.share, c.side, ++seed);
    const Accumulator found = HoughTransform(c.angles)(picture);
    EXPECT_EQ(found.angles, c.angles);
    EXPECT_EQ(found.counts, exhaustive(picture, c.angles))
        << c.rows << " x " << c.cols << ", side " << c.side;
  }
}

TEST(Hough, CountsThePixelsOfALineInOneBin) {
  Picture picture(40, 60);
  testing::fill(picture, 5, 17, 30, 1);                      // a column: theta = 0, rho = x
  testing::fill(picture, 8, 20, 1, 35);                      // a row: theta = -90, rho = -y
  for (int i = 0; i < 20; ++i) picture.at(39 - i, i) = 255;  // rising to the right: clockwise by 45 degrees
  const Accumulator found = HoughTransform()(picture);
  EXPECT_GE(found.at(90, 17), 30);
  EXPECT_GE(found.at(0, -8), 35);
  EXPECT_GE(found.at(135, static_cast<int>(std::lround(39.0 / std::sqrt(2.0)))), 20);
  EXPECT_DOUBLE_EQ(found.theta_rad(0), deg_to_rad(-90.0));
  EXPECT_DOUBLE_EQ(found.theta_rad(179), deg_to_rad(89.0));
}

TEST(Hough, OfAnEmptyPictureHasOneEmptyBinAnAngle) {
  const Accumulator found = HoughTransform(4)(Picture());
  EXPECT_EQ(found.counts, std::vector<std::uint16_t>(4));
  EXPECT_TRUE(hough_peaks(found).empty());
  EXPECT_TRUE(hough_peaks(Accumulator{}).empty());
  EXPECT_TRUE(hough_peaks(HoughTransform()(Picture(50, 50))).empty());
}

/// An accumulator of one degree a column with rho in -500 .. 500, which holds these counts.
struct Cell {
  int theta_deg, rho, count;
};
Accumulator accumulator_of(const std::vector<Cell>& cells) {
  Accumulator all{180, 500, {}};
  all.counts.resize(180 * static_cast<std::size_t>(all.bins()));
  for (const Cell& cell : cells) {
    all.counts[static_cast<std::size_t>((cell.theta_deg + 90) * all.bins() + cell.rho + all.reach)] =
        static_cast<std::uint16_t>(cell.count);
  }
  return all;
}

/// The peaks as "theta/rho/count ...".
std::string peaks_of(const std::vector<Cell>& cells, const PeakOptions& options = {}) {
  std::string text;
  for (const HoughPeak& peak : hough_peaks(accumulator_of(cells), options)) {
    text += std::to_string(std::lround(rad_to_deg(peak.theta_rad))) + '/' + std::to_string(peak.rho_px) +
            '/' + std::to_string(peak.count) + ' ';
  }
  return text;
}

TEST(HoughPeaks, HaveNoOtherWithinThreeDegreesAndAHundredthOfTheRange) {
  EXPECT_EQ(peaks_of({{10, 100, 90}, {13, 110, 80}, {7, 90, 70}}), "10/100/90 ");
  EXPECT_EQ(peaks_of({{10, 100, 90}, {14, 100, 80}}), "10/100/90 14/100/80 ");
  EXPECT_EQ(peaks_of({{10, 100, 90}, {10, 111, 80}}), "10/100/90 10/111/80 ");
  EXPECT_EQ(peaks_of({{10, 100, 90}, {10, 111, 80}}, {.rho_share = 0.011}), "10/100/90 ");
}

TEST(HoughPeaks, AreTheSameLineAfterAHalfTurn) {
  EXPECT_EQ(peaks_of({{-90, 200, 90}, {89, -200, 80}}), "-90/200/90 ");
  EXPECT_EQ(peaks_of({{88, -200, 90}, {-89, 195, 80}}), "88/-200/90 ");
  EXPECT_EQ(peaks_of({{88, -200, 90}, {-88, 195, 80}}), "88/-200/90 -88/195/80 ");
  EXPECT_EQ(peaks_of({{-90, 200, 90}, {89, 200, 80}}), "-90/200/90 89/200/80 ");
}

TEST(HoughPeaks, ASuppressedCellSuppressesNoOther) {
  EXPECT_EQ(peaks_of({{0, 0, 90}, {3, 0, 80}, {6, 0, 70}}), "0/0/90 6/0/70 ");
}

TEST(HoughPeaks, OfEqualsComeByAngleThenByRho) {
  EXPECT_EQ(peaks_of({{40, 0, 50}, {-20, 300, 50}, {-20, -300, 50}, {80, 80, 60}}),
            "80/80/60 -20/-300/50 -20/300/50 40/0/50 ");
}

TEST(HoughPeaks, AreAtMostSoManyAndAtLeastAShareOfTheGreatest) {
  EXPECT_EQ(peaks_of({{0, 0, 100}, {20, 0, 30}, {40, 0, 29}}), "0/0/100 20/0/30 ");
  EXPECT_EQ(peaks_of({{0, 0, 100}, {20, 0, 30}, {40, 0, 29}}, {.least_share = 0.0}),
            "0/0/100 20/0/30 40/0/29 ");
  EXPECT_EQ(peaks_of({{0, 0, 100}, {20, 0, 90}, {40, 0, 80}}, {.most = 2}), "0/0/100 20/0/90 ");
  EXPECT_EQ(peaks_of({{0, 0, 100}}, {.most = 0}), "");
}

}  // namespace
}  // namespace verge::raster
