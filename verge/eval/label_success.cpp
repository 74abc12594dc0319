// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_success.hpp"

#include "verge/eval/label_score.hpp"

namespace verge::eval {
namespace {

/// Where labels are of whole scans, what is found too much can be told as well.
bool keeps(const LabelScore& score, bool whole, const ToleranceScore& within,
           const ToleranceScore& never_beyond) {
  constexpr double kShare = 0.9;
  return static_cast<double>(within.found) >= kShare * static_cast<double>(score.true_points) &&
         (!whole || never_beyond.right == never_beyond.judged);
}

}  // namespace

std::optional<Deviation> deviation_of(const LabelledTruth& truth, const Scene* prediction, double range_m) {
  const LabelScore score = eval::score(truth, prediction, {range_m, {0.2, 0.5, 1.0}});
  if (score.true_points == 0) return std::nullopt;
  const bool whole = truth.ground.has_value();
  if (keeps(score, whole, score.at[0], score.at[1])) return Deviation::kMinimum;
  return keeps(score, whole, score.at[1], score.at[2]) ? Deviation::kLarger : Deviation::kFailed;
}

}  // namespace verge::eval
