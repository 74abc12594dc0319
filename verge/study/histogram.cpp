// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/histogram.hpp"

#include <cassert>
#include <cmath>
#include <cstdlib>

namespace verge::study {

void Histogram::add(double value) {
  assert(std::isfinite(value));
  ++bins_[static_cast<std::int64_t>(std::llround(value / step_))];
}

Histogram& Histogram::operator+=(const Histogram& more) {
  assert(step_ == more.step_);
  for (const auto& [bin, count] : more.bins_) bins_[bin] += count;
  return *this;
}

Histogram Histogram::sizes() const {
  Histogram sizes(step_);
  for (const auto& [bin, count] : bins_) sizes.bins_[std::abs(bin)] += count;
  return sizes;
}

std::uint64_t Histogram::count() const {
  std::uint64_t sum = 0;
  for (const auto& [bin, count] : bins_) sum += count;
  return sum;
}

std::optional<double> Histogram::mean() const {
  if (bins_.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [bin, count] : bins_) sum += static_cast<double>(bin) * static_cast<double>(count);
  return step_ * sum / static_cast<double>(count());
}

std::optional<double> Histogram::root_mean_square() const {
  if (bins_.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [bin, count] : bins_)
    sum += static_cast<double>(bin) * static_cast<double>(bin) * static_cast<double>(count);
  return step_ * std::sqrt(sum / static_cast<double>(count()));
}

double Histogram::value_at(std::uint64_t rank) const {
  std::uint64_t before = 0;
  for (const auto& [bin, count] : bins_) {
    before += count;
    if (rank < before) return step_ * static_cast<double>(bin);
  }
  return step_ * static_cast<double>(bins_.rbegin()->first);
}

std::optional<double> Histogram::percentile(double percent) const {
  if (bins_.empty()) return std::nullopt;
  const double position = static_cast<double>(count() - 1) * percent / 100.0;
  const auto below = static_cast<std::uint64_t>(position);
  const double share = position - static_cast<double>(below);
  return (1.0 - share) * value_at(below) + share * value_at(below + 1);
}

}  // namespace verge::study
