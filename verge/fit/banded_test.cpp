// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/banded.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace verge::fit {
namespace {

TEST(Banded, SolvesATridiagonalSystemByHand) {
  BandedMatrix a(3, 1);
  for (std::size_t i = 0; i < 3; ++i) a.at(i, i) = 2.0;
  a.at(0, 1) = a.at(1, 0) = a.at(1, 2) = a.at(2, 1) = -1.0;
  const auto x = solve(a, {{1.0, 0.0}, {0.0, 0.0}, {1.0, 4.0}}).value();
  EXPECT_NEAR(x[0].x, 1.0, 1e-14);
  EXPECT_NEAR(x[1].x, 1.0, 1e-14);
  EXPECT_NEAR(x[0].y, 1.0, 1e-14);
  EXPECT_NEAR(x[2].y, 3.0, 1e-14);
}

TEST(Banded, ASingularMatrixGivesNone) {
  BandedMatrix a(2, 1);
  a.at(0, 0) = a.at(0, 1) = a.at(1, 0) = a.at(1, 1) = 1.0;
  EXPECT_FALSE(solve(a, {{1.0, 1.0}, {1.0, 1.0}}).has_value());
  EXPECT_FALSE(solve(BandedMatrix(2, 0), {{1.0, 1.0}, {1.0, 1.0}}).has_value());
}

TEST(Banded, AnEntryThatIsNotANumberGivesNone) {
  BandedMatrix a(1, 0);
  a.at(0, 0) = std::nan("");
  EXPECT_FALSE(solve(a, {{1.0, 1.0}}).has_value());
}

TEST(Banded, AgreesWithADenseSolverOfAnOutsideLibrary) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::size_t size : {1U, 2U, 5U, 40U}) {
    for (const std::size_t half : {0U, 1U, 3U}) {
      const auto n = static_cast<Eigen::Index>(size);
      BandedMatrix banded(size, half);
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
      Eigen::MatrixX2d right(n, 2);
      std::vector<Vec2> b;
      for (std::size_t i = 0; i < size; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        for (std::size_t j = i < half ? 0 : i - half; j < std::min(size, i + half + 1); ++j) {
          banded.at(i, j) = uniform(engine) + (i == j ? 8.0 : 0.0);
          dense(row, static_cast<Eigen::Index>(j)) = banded.at(i, j);
        }
        b.push_back({uniform(engine), uniform(engine)});
        right.row(row) << b.back().x, b.back().y;
      }
      const Eigen::MatrixX2d expected = dense.fullPivLu().solve(right);
      const auto x = solve(banded, b).value();
      for (std::size_t i = 0; i < size; ++i) {
        EXPECT_NEAR(x[i].x, expected(static_cast<Eigen::Index>(i), 0), 1e-12);
        EXPECT_NEAR(x[i].y, expected(static_cast<Eigen::Index>(i), 1), 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace verge::fit
