// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/junction_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

const Junction* nearest_to(const Scene& scene, Vec2 place) {
  const auto nearest = std::min_element(scene.junctions.begin(), scene.junctions.end(),
                                        [&](const Junction& a, const Junction& b) {
                                          return distance(a.center, place) < distance(b.center, place);
                                        });
  return nearest == scene.junctions.end() ? nullptr : &*nearest;
}

const Junction* surest(const Scene& scene) {
  const auto found =
      std::max_element(scene.junctions.begin(), scene.junctions.end(),
                       [](const Junction& a, const Junction& b) { return a.confidence < b.confidence; });
  return found == scene.junctions.end() ? nullptr : &*found;
}

std::size_t type_of(const Junction* junction) {
  return junction == nullptr ? JunctionScore::kNone : static_cast<std::size_t>(junction->type);
}

struct BranchPair {
  std::size_t a = 0;
  std::size_t b = 0;
  double error_rad = 0.0;
};

/// Errors of the branches of two junctions, matched one to one, the nearest first.
std::vector<double> branch_errors(const Junction& a, const Junction& b) {
  std::vector<BranchPair> pairs;
  for (std::size_t i = 0; i < a.branches_rad.size(); ++i) {
    for (std::size_t j = 0; j < b.branches_rad.size(); ++j) {
      pairs.push_back(
          {i, j, std::fabs(std::remainder(a.branches_rad[i] - b.branches_rad[j], 2.0 * std::numbers::pi))});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const BranchPair& x, const BranchPair& y) { return x.error_rad < y.error_rad; });
  std::vector<bool> taken_a(a.branches_rad.size());
  std::vector<bool> taken_b(b.branches_rad.size());
  std::vector<double> errors;
  for (const BranchPair& pair : pairs) {
    if (taken_a[pair.a] || taken_b[pair.b]) continue;
    taken_a[pair.a] = taken_b[pair.b] = true;
    errors.push_back(pair.error_rad);
  }
  return errors;
}

void add_counts(std::vector<std::size_t>& to, const std::vector<std::size_t>& from) {
  to.resize(std::max(to.size(), from.size()));
  for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
}

}  // namespace

JunctionScore& JunctionScore::operator+=(const JunctionScore& more) {
  for (std::size_t i = 0; i <= kTypes; ++i) {
    for (std::size_t j = 0; j <= kTypes; ++j) confusion.at(i).at(j) += more.confusion.at(i).at(j);
  }
  with_both += more.with_both;
  right_branch_count += more.right_branch_count;
  branch_error_rad.insert(branch_error_rad.end(), more.branch_error_rad.begin(), more.branch_error_rad.end());
  center_error_m.insert(center_error_m.end(), more.center_error_m.begin(), more.center_error_m.end());
  add_counts(seen, more.seen);
  add_counts(right, more.right);
  return *this;
}

std::optional<double> JunctionScore::type_accuracy() const {
  std::size_t all = 0;
  std::size_t same = 0;
  for (std::size_t i = 0; i <= kTypes; ++i) {
    for (const std::size_t count : confusion.at(i)) all += count;
    same += confusion.at(i).at(i);
  }
  return share_of(same, all);
}

std::optional<double> JunctionScore::macro_f1() const {
  double sum = 0.0;
  std::size_t types = 0;
  for (std::size_t i = 0; i <= kTypes; ++i) {
    std::size_t either = 0;  // 2 TP + FP + FN
    for (std::size_t j = 0; j <= kTypes; ++j) either += confusion.at(i).at(j) + confusion.at(j).at(i);
    const auto f1 = share_of(2 * confusion.at(i).at(i), either);
    if (!f1) continue;
    sum += *f1;
    ++types;
  }
  if (types == 0) return std::nullopt;
  return sum / static_cast<double>(types);
}

std::optional<double> JunctionScore::branch_count_accuracy() const {
  return share_of(right_branch_count, with_both);
}

std::optional<double> JunctionScore::detection_distance_m(double least) const {
  std::optional<double> reach_m;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto accuracy = share_of(right[i], seen[i]);
    if (!accuracy) continue;
    if (*accuracy < least) return reach_m.value_or(0.0);
    reach_m = static_cast<double>(i + 1) * kJunctionBin_m;
  }
  return reach_m;
}

JunctionScore score_junction(const Scene& prediction, const Scene& truth) {
  JunctionScore score;
  const Junction* known = nearest_to(truth, {});
  const Junction* found = known == nullptr ? surest(prediction) : nearest_to(prediction, known->center);
  score.confusion.at(type_of(known)).at(type_of(found)) = 1;
  if (known == nullptr) return score;
  const auto bin = static_cast<std::size_t>(norm(known->center) / kJunctionBin_m);
  score.seen.resize(bin + 1);
  score.right.resize(bin + 1);
  score.seen[bin] = 1;
  if (found == nullptr) return score;
  score.right[bin] = found->type == known->type ? 1 : 0;
  score.with_both = 1;
  score.right_branch_count = found->branches_rad.size() == known->branches_rad.size() ? 1 : 0;
  score.branch_error_rad = branch_errors(*found, *known);
  score.center_error_m = {distance(found->center, known->center)};
  return score;
}

}  // namespace verge::eval
