// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Every comparison with an outside library (Eigen and its Splines module), in one file: its templates take
// long to compile.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unsupported/Eigen/Splines>

#include "verge/fit/banded.hpp"
#include "verge/fit/bspline_interpolation.hpp"
#include "verge/fit/bspline_least_squares.hpp"
#include "verge/fit/knots.hpp"
#include "verge/fit/line.hpp"
#include "verge/fit/polynomial.hpp"
#include "verge/fit/test_clusters.hpp"
#include "verge/fit/test_points.hpp"

namespace verge::fit {
namespace {

Eigen::Matrix2Xd columns_of(const std::vector<Vec2>& points) {
  Eigen::Matrix2Xd columns(2, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y;
  return columns;
}

/// D^2 as rows, written out from its definition on the Greville abscissae.
Eigen::MatrixXd dense_penalty(const std::vector<double>& knots, std::size_t degree) {
  const auto n = static_cast<Eigen::Index>(knots.size() - degree - 1);
  const auto xi = [&](Eigen::Index i) {
    double sum = 0.0;
    for (std::size_t j = 1; j <= degree; ++j) sum += knots[static_cast<std::size_t>(i) + j];
    return sum / static_cast<double>(degree);
  };
  const double h = (xi(n - 1) - xi(0)) / static_cast<double>(n - 1);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n - 2, n);
  for (Eigen::Index i = 0; i + 2 < n; ++i) {
    rows(i, i) = h / (xi(i + 1) - xi(i));
    rows(i, i + 2) = h / (xi(i + 2) - xi(i + 1));
    rows(i, i + 1) = -rows(i, i) - rows(i, i + 2);
  }
  return rows;
}

/// Ratio of the greatest to the least singular value of the 17 columns of a polynomial of degree 16; `column`
/// gives the k-th from x.
template <class Column>
double condition(const std::vector<Vec2>& points, Column column) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 17);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    for (Eigen::Index k = 0; k < 17; ++k)
      rows(i, k) = column(static_cast<int>(k), points[static_cast<std::size_t>(i)].x);
  }
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(rows).singularValues();
  return singular(0) / singular(16);
}

/// For the powers of x in metres; of x about its mean over its deviation; and for Chebyshev's polynomials of
/// x on [-1, 1].
std::vector<double> conditions(const std::vector<Vec2>& points) {
  const auto n = static_cast<double>(points.size());
  double mean = 0.0;
  for (const Vec2 p : points) mean += p.x / n;
  double variance = 0.0;
  for (const Vec2 p : points) variance += (p.x - mean) * (p.x - mean) / (n - 1.0);
  const Polynomial scale = fit_polynomial(points, 1).value().curve;
  return {condition(points, [](int k, double x) { return std::pow(x, k); }),
          condition(points, [&](int k, double x) { return std::pow((x - mean) / std::sqrt(variance), k); }),
          condition(points, [&](int k, double x) {
            Polynomial column{scale.middle_m, scale.half_m, std::vector<double>(17, 0.0)};
            column.chebyshev_m[static_cast<std::size_t>(k)] = 1.0;
            return value_at(column, x);
          })};
}

TEST(OutsideOracle, ChebyshevsBasisIsWellConditionedWherePowersAreNot) {
  const auto edge = conditions(testing::straight_edge(60, 1));
  const auto car = conditions(testing::l_shaped_car(0.25, 3));
  EXPECT_GT(edge[0], 1e25);  // 3e29: of no use in double precision
  EXPECT_GT(car[0], 1e25);
  EXPECT_NEAR(edge[1], 2.9e6, 0.2e6);
  EXPECT_GT(car[1], 1e11);  // 5e11
  EXPECT_NEAR(edge[2], 2.84, 0.1);
  EXPECT_NEAR(car[2], 541.0, 10.0);
}

TEST(OutsideOracle, TheLinesDirectionIsTheFirstEigenvectorOfTheScatter) {
  rc::check([](const testing::RawSteps& raw) {
    const auto points = testing::steps_of(raw);
    const auto fit = fit_line(points);
    RC_PRE(fit.has_value());
    const Eigen::Matrix2Xd columns = columns_of(points);
    const Eigen::Matrix2Xd centred = columns.colwise() - columns.rowwise().mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(centred * centred.transpose());
    RC_PRE(solver.eigenvalues()(0) < 0.98 * solver.eigenvalues()(1));
    const Eigen::Vector2d axis = solver.eigenvectors().col(1);
    RC_ASSERT(std::abs(cross(fit->line.direction, {axis(0), axis(1)})) < 1e-6);
  });
}

TEST(OutsideOracle, BandedSystemsHaveTheSolutionOfADenseSolver) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const std::size_t size : {1U, 2U, 5U, 40U}) {
    for (const std::size_t half : {0U, 1U, 3U}) {
      const auto n = static_cast<Eigen::Index>(size);
      BandedMatrix banded(size, half);
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
      Eigen::MatrixXd right(n, 2);
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
      const Eigen::MatrixXd expected = dense.householderQr().solve(right);
      const auto x = solve(banded, b).value();
      for (std::size_t i = 0; i < size; ++i) {
        EXPECT_NEAR(x[i].x, expected(static_cast<Eigen::Index>(i), 0), 1e-12);
        EXPECT_NEAR(x[i].y, expected(static_cast<Eigen::Index>(i), 1), 1e-12);
      }
    }
  }
}

TEST(OutsideOracle, ChordLengthParametersAreTheirs) {
  const std::vector<Vec2> q{{0.0, 0.0}, {1.0, 0.5}, {2.5, 0.0}, {2.5, 3.0}, {9.0, 3.5}};
  Eigen::RowVectorXd expected;
  Eigen::ChordLengths(columns_of(q), expected);
  const auto u = parameters(q, Parameterization::kChordLength).value();
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], expected(static_cast<Eigen::Index>(i)), 1e-15);
}

TEST(OutsideOracle, AveragedKnotsAreTheirs) {
  rc::check([](const testing::RawSteps& raw) {
    const auto points = testing::steps_of(raw);
    RC_PRE(points.size() >= 4U);
    const auto u = parameters(points, Parameterization::kCentripetal).value();
    const Eigen::RowVectorXd given =
        Eigen::Map<const Eigen::RowVectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
    Eigen::RowVectorXd expected;
    Eigen::KnotAveraging(given, 3, expected);
    const auto knots = averaged_knots(u, 3);
    RC_ASSERT(static_cast<Eigen::Index>(knots.size()) == expected.size());
    for (std::size_t i = 0; i < knots.size(); ++i)
      RC_ASSERT(std::abs(knots[i] - expected(static_cast<Eigen::Index>(i))) < 1e-14);
  });
}

TEST(OutsideOracle, TheInterpolatingCurveIsTheirs) {
  rc::check([](const testing::RawSteps& raw) {
    const auto q = testing::steps_of(raw);
    RC_PRE(q.size() >= 4U);
    const auto theirs = Eigen::SplineFitting<Eigen::Spline<double, 2, 3>>::Interpolate(columns_of(q), 3);
    const auto ours = interpolate(q, {.parameterization = Parameterization::kChordLength}).value();
    for (int i = 0; i <= 100; ++i) {
      const Eigen::Array2d expected = theirs(i / 100.0);
      const Vec2 got = evaluate(ours, i / 100.0);
      RC_ASSERT(std::hypot(got.x - expected(0), got.y - expected(1)) < 1e-7);
    }
  });
}

TEST(OutsideOracle, TheLeastSquaresSplineSolvesTheStackedDenseSystem) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (const double penalty : {0.0, 0.1, 10.0}) {
    std::vector<double> u;
    std::vector<Vec2> points;
    std::vector<double> weights;
    for (int i = 0; i < 60; ++i) {
      u.push_back(uniform(engine));
      points.push_back({10.0 * uniform(engine), uniform(engine)});
      weights.push_back(uniform(engine));
    }
    const auto knots = uniform_knots(8, 3);
    const Eigen::MatrixXd d2 = std::sqrt(penalty) * dense_penalty(knots, 3);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(60 + d2.rows(), 8);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(60 + d2.rows(), 2);
    rows.bottomRows(d2.rows()) = d2;
    for (std::size_t k = 0; k < 60; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const double root = std::sqrt(weights[k]);
      for (std::size_t i = 0; i < 8; ++i)
        rows(row, static_cast<Eigen::Index>(i)) = root * basis(knots, i, 4, u[k]);
      right.row(row) << root * points[k].x, root * points[k].y;
    }
    const Eigen::MatrixXd expected = rows.householderQr().solve(right);
    const auto curve = least_squares_spline(points, weights, u, knots, 3, penalty).value();
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(curve.control_points[i].x, expected(static_cast<Eigen::Index>(i), 0), 1e-8);
      EXPECT_NEAR(curve.control_points[i].y, expected(static_cast<Eigen::Index>(i), 1), 1e-8);
    }
  }
}

}  // namespace
}  // namespace verge::fit
