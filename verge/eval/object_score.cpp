// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/object_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "verge/eval/box_overlap.hpp"
#include "verge/eval/share.hpp"
#include "verge/model/footprint.hpp"

namespace verge::eval {
namespace {

bool is_within(const Object& object, double range_m) { return norm(object.center.xy()) < range_m; }

/// Whether it is to be found: within the range, and seen.
bool is_due(const Object& truth, double range_m) {
  return is_within(truth, range_m) && truth.confidence > 0.0;
}

/// Whether it is too small for its footprint to be judged.
bool is_small(const Object& truth) { return std::max(truth.size.length_m, truth.size.width_m) < 1.0; }

/// 1 is the best: by the distance of centers of what is small, else by overlap.
double nearness(const Object& predicted, const Object& truth) {
  return is_small(truth) ? 1.0 - distance(predicted.center.xy(), truth.center.xy())
                         : intersection_over_union(predicted, truth);
}

struct Pair {
  std::size_t predicted = 0;
  std::size_t truth = 0;
  double nearness = 0.0;
};

/// One to one, the nearest first.
std::vector<Pair> pairs_of(std::span<const Object> predicted, std::span<const Object> truth, double least) {
  std::vector<Pair> candidates;
  for (std::size_t p = 0; p < predicted.size(); ++p) {
    for (std::size_t t = 0; t < truth.size(); ++t) {
      const double near = nearness(predicted[p], truth[t]);
      if (near >= least) candidates.push_back({p, t, near});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Pair& a, const Pair& b) { return a.nearness > b.nearness; });
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

bool is_car(const Object& object) { return object.type == ObjectClass::kCar; }

bool is_two_faced(const Object& object) {
  return object.shape == ObjectShape::kJ || object.shape == ObjectShape::kL;
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

void add_truth(const Object& truth, ObjectScore& score) {
  ++score.truth;
  ++score.class_truth.at(static_cast<std::size_t>(truth.type));
  if (!is_car(truth)) return;
  ++score.cars.truth;
  if (is_two_faced(truth)) ++score.two_faced_cars.truth;
}

/// A pair whose footprints can be judged.
void add_boxes(const Object& predicted, const Object& truth, ObjectScore& score) {
  const double heading_rad = std::fabs(std::remainder(predicted.yaw_rad - truth.yaw_rad, std::numbers::pi));
  const double overlap = intersection_over_union(predicted, truth);
  const auto add = [&](auto& to) {
    to.heading_error_rad.push_back(heading_rad);
    to.overlap.push_back(overlap);
  };
  add(score);
  score.corner_error_m.push_back(corner_error_m(predicted, truth));
  if (is_car(truth)) add(score.cars);
  if (is_car(truth) && is_two_faced(truth)) add(score.two_faced_cars);
}

}  // namespace

BoxScore& BoxScore::operator+=(const BoxScore& more) {
  truth += more.truth;
  append(heading_error_rad, more.heading_error_rad);
  append(overlap, more.overlap);
  return *this;
}

std::optional<double> BoxScore::share_above(double least) const {
  const auto found = std::ranges::count_if(overlap, [=](double share) { return share >= least; });
  return share_of(static_cast<std::size_t>(found), truth);
}

ObjectScore& ObjectScore::operator+=(const ObjectScore& more) {
  predicted += more.predicted;
  truth += more.truth;
  matched += more.matched;
  over_segmented += more.over_segmented;
  under_segmented += more.under_segmented;
  append(heading_error_rad, more.heading_error_rad);
  append(corner_error_m, more.corner_error_m);
  append(overlap, more.overlap);
  cars += more.cars;
  two_faced_cars += more.two_faced_cars;
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
  ObjectScore score;
  std::vector<Object> due;
  for (const Object& object : truth.objects) {
    if (!is_due(object, range_m)) continue;
    due.push_back(object);
    add_truth(object, score);
  }
  std::vector<bool> counts;
  for (const Object& object : prediction.objects) counts.push_back(is_within(object, range_m));
  for (const Pair& pair : pairs_of(prediction.objects, truth.objects, least_overlap)) {
    const Object& p = prediction.objects[pair.predicted];
    const Object& t = truth.objects[pair.truth];
    counts[pair.predicted] = is_due(t, range_m);
    if (!counts[pair.predicted]) continue;
    ++score.matched;
    score.class_matched.at(static_cast<std::size_t>(t.type)) += p.type == t.type ? 1U : 0U;
    if (!is_small(t)) add_boxes(p, t, score);
  }
  std::vector<Object> predicted;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i]) predicted.push_back(prediction.objects[i]);
  }
  score.predicted = predicted.size();
  for (const Object& object : predicted) ++score.class_predicted.at(static_cast<std::size_t>(object.type));
  score.over_segmented = hold_several(due, predicted);
  score.under_segmented = hold_several(predicted, due);
  return score;
}

}  // namespace verge::eval
