// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/degradation.hpp"

#include <cassert>

namespace verge::eval {

DegradationCurve& DegradationCurve::operator+=(const DegradationCurve& more) {
  assert(condition_ == more.condition_ && unit_ == more.unit_);
  for (const auto& [value, counts] : more.at_) add(value, counts);
  return *this;
}

std::vector<DegradationCurve::Point> DegradationCurve::points() const {
  std::vector<Point> points;
  for (const auto& [value, counts] : at_) {
    const auto first = at_.begin()->second.f1();
    const auto f1 = counts.f1();
    points.push_back({value, counts, first && f1 ? std::optional(*first - *f1) : std::nullopt});
  }
  return points;
}

}  // namespace verge::eval
