// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/object_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "verge/eval/box_overlap.hpp"
#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

std::vector<Object> within(const Scene& scene, double range_m) {
  std::vector<Object> objects;
  for (const Object& object : scene.objects) {
    if (norm(object.center.xy()) < range_m) objects.push_back(object);
  }
  return objects;
}

struct Pair {
  std::size_t predicted = 0;
  std::size_t truth = 0;
  double overlap = 0.0;
};

/// One to one, the greatest overlap first.
std::vector<Pair> pairs_of(std::span<const Object> predicted, std::span<const Object> truth,
                           double least_overlap) {
  std::vector<Pair> candidates;
  for (std::size_t p = 0; p < predicted.size(); ++p) {
    for (std::size_t t = 0; t < truth.size(); ++t) {
      const double overlap = intersection_over_union(predicted[p], truth[t]);
      if (overlap >= least_overlap) candidates.push_back({p, t, overlap});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
  std::vector<bool> taken_predicted(predicted.size());
  std::vector<bool> taken_truth(truth.size());
  std::vector<Pair> pairs;
  for (const Pair& pair : candidates) {
    if (taken_predicted[pair.predicted] || taken_truth[pair.truth]) continue;
    taken_predicted[pair.predicted] = taken_truth[pair.truth] = true;
    pairs.push_back(pair);
  }
  return pairs;
}

/// How many of `wholes` hold at least half of two of `parts` or more.
std::size_t hold_several(std::span<const Object> wholes, std::span<const Object> parts) {
  return static_cast<std::size_t>(std::count_if(wholes.begin(), wholes.end(), [&](const Object& whole) {
    return std::count_if(parts.begin(), parts.end(), [&](const Object& part) {
             const double area = part.size.length_m * part.size.width_m;
             return area > 0.0 && shared_area(whole, part) >= 0.5 * area;
           }) > 1;
  }));
}

/// Mean distance of corners, whichever end of the one is taken for the front.
double corner_error_m(const Object& a, const Object& b) {
  const auto of_a = footprint(a);
  const auto of_b = footprint(b);
  std::array<double, 2> sums{};
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    sums[0] += distance(of_a.at(i), of_b.at(i));
    sums[1] += distance(of_a.at(i), of_b.at((i + 2) % of_b.size()));
  }
  return std::min(sums[0], sums[1]) / static_cast<double>(of_a.size());
}

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

ObjectScore& ObjectScore::operator+=(const ObjectScore& more) {
  predicted += more.predicted;
  truth += more.truth;
  matched += more.matched;
  over_segmented += more.over_segmented;
  under_segmented += more.under_segmented;
  append(heading_error_rad, more.heading_error_rad);
  append(corner_error_m, more.corner_error_m);
  append(overlap, more.overlap);
  for (std::size_t i = 0; i < kClasses; ++i) {
    class_predicted.at(i) += more.class_predicted.at(i);
    class_truth.at(i) += more.class_truth.at(i);
    class_matched.at(i) += more.class_matched.at(i);
  }
  return *this;
}

std::optional<double> ObjectScore::precision() const { return share_of(matched, predicted); }
std::optional<double> ObjectScore::recall() const { return share_of(matched, truth); }
std::optional<double> ObjectScore::class_f1(ObjectClass type) const {
  const auto i = static_cast<std::size_t>(type);
  return share_of(2 * class_matched.at(i), class_predicted.at(i) + class_truth.at(i));
}

ObjectScore score_objects(const Scene& prediction, const Scene& truth, double range_m, double least_overlap) {
  const std::vector<Object> predicted = within(prediction, range_m);
  const std::vector<Object> known = within(truth, range_m);
  ObjectScore score;
  score.predicted = predicted.size();
  score.truth = known.size();
  for (const Object& object : predicted) ++score.class_predicted.at(static_cast<std::size_t>(object.type));
  for (const Object& object : known) ++score.class_truth.at(static_cast<std::size_t>(object.type));
  for (const Pair& pair : pairs_of(predicted, known, least_overlap)) {
    const Object& p = predicted[pair.predicted];
    const Object& t = known[pair.truth];
    ++score.matched;
    score.class_matched.at(static_cast<std::size_t>(t.type)) += p.type == t.type ? 1U : 0U;
    score.heading_error_rad.push_back(std::fabs(std::remainder(p.yaw_rad - t.yaw_rad, std::numbers::pi)));
    score.corner_error_m.push_back(corner_error_m(p, t));
    score.overlap.push_back(pair.overlap);
  }
  score.over_segmented = hold_several(known, predicted);
  score.under_segmented = hold_several(predicted, known);
  return score;
}

}  // namespace verge::eval
