// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/discriminant.hpp"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace verge::fit {
namespace {

using Sample = std::array<double, 3>;

/// Two clouds whose dimensions depend on each other and have very different units.
struct Clouds {
  std::vector<Sample> first, other;
};
Clouds clouds(std::size_t n1, std::size_t n0, double unit = 1.0) {
  std::mt19937 random(20261126);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto sample = [&](double x, double y, double z) {
    const double a = noise(random);
    const double b = noise(random);
    const double c = noise(random);
    return Sample{unit * (x + 0.1 * a), y + 2.0 * a + b, 1e-4 * (z + c - b)};
  };
  Clouds made;
  for (std::size_t i = 0; i < n1; ++i) made.first.push_back(sample(0.15, 1.0, 0.5));
  for (std::size_t i = 0; i < n0; ++i) made.other.push_back(sample(0.0, 0.0, 0.0));
  return made;
}

Moments moments_of(const std::vector<Sample>& samples) {
  Moments moments(3);
  for (const Sample& sample : samples) moments.add(sample);
  return moments;
}

double value_of(const Discriminant& d, const Sample& x) {
  return d.weights[0] * x[0] + d.weights[1] * x[1] + d.weights[2] * x[2] - d.threshold;
}

TEST(Moments, AreTheDefinitionsAndAddUp) {
  const Clouds made = clouds(50, 70);
  const Moments whole = moments_of(made.first);
  Sample mean{};
  for (const Sample& s : made.first) {
    for (std::size_t k = 0; k < 3; ++k) mean[k] += s[k] / 50.0;
  }
  double scatter01 = 0.0;
  for (const Sample& s : made.first) scatter01 += (s[0] - mean[0]) * (s[1] - mean[1]);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(whole.mean()[k], mean[k], 1e-12);
  EXPECT_NEAR(whole.scatter()[1], scatter01, 1e-10);
  EXPECT_EQ(whole.scatter()[1], whole.scatter()[3]);

  Moments sum = moments_of({made.first.begin(), made.first.begin() + 20});
  sum += moments_of({made.first.begin() + 20, made.first.end()});
  sum += Moments(3);
  EXPECT_EQ(sum.count(), 50U);
  EXPECT_NEAR(sum.scatter()[1], scatter01, 1e-10);
}

TEST(Discriminant, OfTwoAxesIsWhatIsWorkedOutByHand) {
  // Means (2, 0) and (0, 0).
  Moments first(2);
  first.add(std::array{1.0, 0.0});
  first.add(std::array{3.0, 0.0});
  Moments other(2);
  other.add(std::array{-1.0, 0.5});
  other.add(std::array{1.0, -0.5});
  const auto d = fit_discriminant(first, other, 0.0);
  ASSERT_TRUE(d);
  // S_W = [[2, -0.5], [-0.5, 0.25]], S_W^-1 (2, 0) = (2, 4).
  EXPECT_NEAR(d->weights[0], 2.0, 1e-12);
  EXPECT_NEAR(d->weights[1], 4.0, 1e-12);
  EXPECT_NEAR(d->threshold, 2.0, 1e-12);  // half of w . (2, 0), classes of one size
}

TEST(Discriminant, PointsTheWayOfOpenCVs) {
  const Clouds made = clouds(400, 900);
  cv::Mat_<double> data(0, 3);
  std::vector<int> labels;
  for (const auto* side : {&made.first, &made.other}) {
    for (const Sample& s : *side) {
      data.push_back(cv::Mat_<double>(1, 3, const_cast<double*>(s.data())));
      labels.push_back(side == &made.first ? 1 : 0);
    }
  }
  const cv::LDA outside(data, labels, 1);
  const auto ours = fit_discriminant(moments_of(made.first), moments_of(made.other), 0.0);
  ASSERT_TRUE(ours);
  const double ratio = outside.eigenvectors().at<double>(0, 0) / ours->weights[0];
  for (int k = 1; k < 3; ++k) {
    EXPECT_NEAR(outside.eigenvectors().at<double>(k, 0) / ours->weights[static_cast<std::size_t>(k)] / ratio,
                1.0, 1e-6);
  }
}

TEST(Discriminant, DecidesTheSameInOtherUnits) {
  const auto metres =
      fit_discriminant(moments_of(clouds(300, 500).first), moments_of(clouds(300, 500).other), 1e-3);
  const Clouds large = clouds(300, 500, 1000.0);
  const auto millimetres = fit_discriminant(moments_of(large.first), moments_of(large.other), 1e-3);
  ASSERT_TRUE(metres && millimetres);
  EXPECT_NEAR(metres->weights[0] / millimetres->weights[0], 1000.0, 1e-6);
  EXPECT_NEAR(metres->threshold, millimetres->threshold, 1e-9);
}

TEST(Discriminant, ARareClassIsHarderToBelieve) {
  const Clouds made = clouds(100, 1000);
  const auto d = fit_discriminant(moments_of(made.first), moments_of(made.other), 1e-3);
  ASSERT_TRUE(d);
  const Moments first = moments_of(made.first);
  const Moments other = moments_of(made.other);
  Sample middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * (first.mean()[k] + other.mean()[k]);
  EXPECT_NEAR(value_of(*d, middle), -std::log(10.0), 1e-9);
}

TEST(Discriminant, WhatDoesNotSpreadWeighsNothing) {
  Clouds made = clouds(100, 100);
  for (Sample& s : made.first) s[1] = 7.0;
  for (Sample& s : made.other) s[1] = 7.0;
  const auto d = fit_discriminant(moments_of(made.first), moments_of(made.other), 0.0);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->weights[1], 0.0);
  EXPECT_GT(d->weights[0], 0.0);
}

TEST(Discriminant, IsNoneWhereNothingCanBeTold) {
  const Clouds made = clouds(100, 100);
  const Moments some = moments_of(made.first);
  EXPECT_FALSE(fit_discriminant(some, moments_of({made.other[0]}), 1e-3));
  EXPECT_FALSE(fit_discriminant(moments_of({}), some, 1e-3));
  const Moments still = moments_of({Sample{1, 2, 3}, Sample{1, 2, 3}});
  EXPECT_FALSE(fit_discriminant(still, still, 1e-3));
  Clouds twice = made;  // one dimension said twice
  for (auto* side : {&twice.first, &twice.other}) {
    for (Sample& s : *side) s[1] = s[0];
  }
  EXPECT_FALSE(fit_discriminant(moments_of(twice.first), moments_of(twice.other), 0.0));
  EXPECT_TRUE(fit_discriminant(moments_of(twice.first), moments_of(twice.other), 1e-3));
}

}  // namespace
}  // namespace verge::fit
