// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/edges.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>

#include "verge/raster/test_pictures.hpp"

namespace verge::raster {
namespace {

constexpr int kSide = 40;
constexpr int kFrom = 10;  // the square's first row and column, and its last
constexpr int kTo = 29;

Picture square() {
  Picture picture(kSide, kSide);
  testing::fill(picture, kFrom, kFrom, kTo - kFrom + 1, kTo - kFrom + 1);
  return picture;
}

Picture edges(const Picture& picture, EdgeFilter filter, double gaussian_px = 0.0) {
  return find_edges(picture, {.filter = filter, .gaussian_px = gaussian_px});
}

/// Pixels from the square's outline: 0 for its outermost pixels, positive inside.
int depth(int row, int col) { return std::min({row - kFrom, kTo - row, col - kFrom, kTo - col}); }

int marks(const Picture& picture) {
  return static_cast<int>(std::ranges::count_if(picture.grey, [](auto grey) { return grey != 0; }));
}

TEST(Edges, WithoutAFilterThePictureStays) {
  EXPECT_EQ(edges(square(), EdgeFilter::kNone), square());
  EXPECT_EQ(edges(square(), EdgeFilter::kNone, 2.0), square());
}

TEST(Edges, OfASquareAreItsOutlineForEveryFilter) {
  for (const EdgeFilter filter :
       {EdgeFilter::kCanny, EdgeFilter::kSobel, EdgeFilter::kPrewitt, EdgeFilter::kLaplacian}) {
    const Picture found = edges(square(), filter);
    for (int row = 0; row < kSide; ++row) {
      for (int col = 0; col < kSide; ++col) {
        const bool near = depth(row, col) == 0 || depth(row, col) == -1;
        const int grey = found.at(row, col);
        EXPECT_TRUE(grey == 0 || (near && grey == 255))
            << static_cast<int>(filter) << ": " << row << ' ' << col;
      }
    }
    for (int i = kFrom + 1; i < kTo; ++i) {  // corners aside, on each of its sides
      EXPECT_TRUE(found.is_marked(i, kFrom) || found.is_marked(i, kFrom - 1)) << static_cast<int>(filter);
      EXPECT_TRUE(found.is_marked(i, kTo) || found.is_marked(i, kTo + 1)) << static_cast<int>(filter);
      EXPECT_TRUE(found.is_marked(kFrom, i) || found.is_marked(kFrom - 1, i)) << static_cast<int>(filter);
      EXPECT_TRUE(found.is_marked(kTo, i) || found.is_marked(kTo + 1, i)) << static_cast<int>(filter);
    }
  }
}

TEST(Edges, AreTwoPixelsThickButForCannys) {
  const int outline = 4 * (kTo - kFrom);
  EXPECT_NEAR(marks(edges(square(), EdgeFilter::kCanny)), outline, 8);
  for (const EdgeFilter filter : {EdgeFilter::kSobel, EdgeFilter::kPrewitt, EdgeFilter::kLaplacian}) {
    EXPECT_NEAR(marks(edges(square(), filter)), 2 * outline, 12) << static_cast<int>(filter);
  }
}

// Why Hough works on the squares themselves by default (A1.3 d).
TEST(Edges, ByCannyDoubleALine) {
  Picture line(kSide, kSide);
  testing::fill(line, 0, 18, kSide, 5);
  const Picture found = edges(line, EdgeFilter::kCanny);
  for (int row = 1; row + 1 < kSide; ++row) {
    int columns = 0;
    for (int col = 0; col < kSide; ++col) columns += found.is_marked(row, col) ? 1 : 0;
    EXPECT_EQ(columns, 2) << row;
    EXPECT_FALSE(found.is_marked(row, 20)) << row;
  }
}

TEST(Edges, AreFewerBehindAGaussianForASpeck) {
  Picture speck(kSide, kSide);
  speck.at(20, 20) = 255;
  EXPECT_GT(marks(edges(speck, EdgeFilter::kLaplacian)), 0);
  EXPECT_EQ(marks(edges(speck, EdgeFilter::kLaplacian, 2.0)), 0);
  EXPECT_GT(marks(edges(square(), EdgeFilter::kCanny, 1.0)), 0);
}

TEST(Edges, ByCannyAreFollowedDownToTheLowThreshold) {
  Picture fading(kSide, kSide);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 20; col < kSide; ++col) fading.at(row, col) = static_cast<std::uint8_t>(255 - 6 * row);
  }
  const auto length = [&](double low) {
    return marks(find_edges(fading, {.filter = EdgeFilter::kCanny, .threshold = 0.7, .low_threshold = low}));
  };
  EXPECT_NEAR(length(0.7), 0.3 * 255.0 / 6.0, 2.0);
  EXPECT_NEAR(length(0.3), 0.7 * 255.0 / 6.0, 2.0);
}

TEST(Edges, OfAnEmptyAndOfAnEvenPictureAreNone) {
  Picture grey(5, 5);
  std::ranges::fill(grey.grey, std::uint8_t{200});
  for (const EdgeFilter filter :
       {EdgeFilter::kCanny, EdgeFilter::kSobel, EdgeFilter::kPrewitt, EdgeFilter::kLaplacian}) {
    EXPECT_EQ(edges(Picture(), filter), Picture());
    EXPECT_EQ(edges(grey, filter), Picture(5, 5));
  }
}

std::ptrdiff_t threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                       std::filesystem::directory_iterator());
}

TEST(Edges, AreFoundOnTheThreadThatAsks) {
  const Picture large = testing::sown(1000, 1000, 0.01, 5, 1);
  const std::ptrdiff_t before = threads();
  const Picture found = edges(large, EdgeFilter::kCanny, 1.0);
  EXPECT_EQ(threads(), before);
  EXPECT_EQ(edges(large, EdgeFilter::kCanny, 1.0), found);
}

}  // namespace
}  // namespace verge::raster
