// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/discriminant.hpp"

#include <cassert>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace verge::fit {
namespace {

Eigen::Map<const Eigen::VectorXd> mean_of(const Moments& moments) {
  return {moments.mean().data(), static_cast<Eigen::Index>(moments.dimensions())};
}

Eigen::MatrixXd scatter_of(const Moments& moments) {
  const auto d = static_cast<Eigen::Index>(moments.dimensions());
  return Eigen::Map<const Eigen::MatrixXd>(moments.scatter().data(), d, d);  // symmetric
}

/// 1 / deviation of each dimension, 0 where it does not spread.
Eigen::VectorXd scales_of(const Eigen::MatrixXd& within) {
  constexpr double kLeast = 1e-12;  // of squares: less is rounding
  return within.diagonal().unaryExpr([](double v) { return v > kLeast * kLeast ? 1.0 / std::sqrt(v) : 0.0; });
}

}  // namespace

Moments::Moments(std::size_t dimensions) : mean_(dimensions, 0.0), scatter_(dimensions * dimensions, 0.0) {}

void Moments::add(std::span<const double> sample) {
  assert(sample.size() == dimensions());
  Moments one(dimensions());
  one.count_ = 1;
  one.mean_.assign(sample.begin(), sample.end());
  *this += one;
}

Moments& Moments::operator+=(const Moments& more) {
  assert(more.dimensions() == dimensions());
  const std::size_t d = dimensions();
  const auto n = static_cast<double>(count_);
  const auto m = static_cast<double>(more.count_);
  if (more.count_ == 0) return *this;
  for (std::size_t i = 0; i < d; ++i) {
    for (std::size_t j = 0; j < d; ++j) {
      const double between = (more.mean_[i] - mean_[i]) * (more.mean_[j] - mean_[j]);
      scatter_[i * d + j] += more.scatter_[i * d + j] + between * n * m / (n + m);
    }
  }
  for (std::size_t i = 0; i < d; ++i) mean_[i] += (more.mean_[i] - mean_[i]) * m / (n + m);
  count_ += more.count_;
  return *this;
}

std::optional<Discriminant> fit_discriminant(const Moments& first, const Moments& other, double shrinkage) {
  assert(first.dimensions() == other.dimensions() && shrinkage >= 0.0);
  if (first.count() < 2 || other.count() < 2) return std::nullopt;
  const auto n1 = static_cast<double>(first.count());
  const auto n0 = static_cast<double>(other.count());
  const Eigen::MatrixXd within = (scatter_of(first) + scatter_of(other)) / (n1 + n0 - 2.0);
  const Eigen::VectorXd scale = scales_of(within);
  const double spread = (scale.array() > 0.0).cast<double>().sum();
  if (!(spread > 0.0) || !within.allFinite()) return std::nullopt;
  Eigen::MatrixXd scaled = scale.asDiagonal() * within * scale.asDiagonal();
  const double mean_variance = scaled.trace() / spread;
  // What does not spread gets a variance of its own, so that it weighs 0 and the rest can be solved for.
  scaled.diagonal().array() +=
      shrinkage * mean_variance + (scale.array() > 0.0).select(0.0, Eigen::ArrayXd::Ones(scale.size()));
  const Eigen::LLT<Eigen::MatrixXd> solver(scaled);
  constexpr double kLeastCondition = 1e-13;
  if (solver.info() != Eigen::Success || !(solver.rcond() > kLeastCondition)) return std::nullopt;
  const Eigen::VectorXd apart = mean_of(first) - mean_of(other);
  const Eigen::VectorXd w = scale.asDiagonal() * solver.solve(scale.asDiagonal() * apart);
  const double middle = 0.5 * w.dot(mean_of(first) + mean_of(other));
  return Discriminant{{w.begin(), w.end()}, middle + std::log(n0 / n1)};
}

}  // namespace verge::fit
