// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/frame_success.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "verge/eval/tolerance_score.hpp"

namespace verge::eval {
namespace {

bool keeps(const SceneMatch& match, double range_m, double within_m, double never_beyond_m) {
  constexpr double kShare = 0.9;
  const ToleranceCounts counts = count_within(match, range_m, within_m);
  return *counts.recall() >= kShare &&
         std::none_of(match.predicted.begin(), match.predicted.end(),
                      [&](const auto& s) { return s.range_m < range_m && s.distance_m > never_beyond_m; });
}

}  // namespace

std::optional<Deviation> deviation_of(const SceneMatch& match, double range_m) {
  if (count_within(match, range_m, 0.0).visible == 0) return std::nullopt;
  if (keeps(match, range_m, 0.2, 0.5)) return Deviation::kMinimum;
  return keeps(match, range_m, 0.5, 1.0) ? Deviation::kLarger : Deviation::kFailed;
}

void SuccessCounts::count(Deviation deviation) {
  ++(deviation == Deviation::kMinimum ? minimum : deviation == Deviation::kLarger ? larger : failed);
}

SuccessCounts& SuccessCounts::operator+=(const SuccessCounts& more) {
  minimum += more.minimum;
  larger += more.larger;
  failed += more.failed;
  return *this;
}

std::optional<ShareInterval> wilson_interval(std::size_t successes, std::size_t trials) {
  assert(successes <= trials);
  if (trials == 0) return std::nullopt;
  constexpr double kZ = 1.959964;
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double denominator = 1.0 + kZ * kZ / n;
  const double centre = (share + kZ * kZ / (2.0 * n)) / denominator;
  const double half = kZ / denominator * std::sqrt(share * (1.0 - share) / n + kZ * kZ / (4.0 * n * n));
  return ShareInterval{share, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace verge::eval
