// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_score.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "verge/eval/nearest.hpp"

namespace verge::eval {
namespace {

constexpr double kStep_m = 0.1;
constexpr double kKerb_m = 0.05;
constexpr double kHiddenBeside_m = 0.3;
constexpr double kAnnotatedBeside_m = 2.0;

struct Predicted {
  std::vector<Vec2> samples;
  std::vector<Segment> segments;
};

Predicted predicted_by(const Scene* scene, double range_m) {
  Predicted predicted;
  if (scene == nullptr) return predicted;
  for (const Boundary& boundary : scene->boundaries) {
    std::vector<Vec2> line;
    for (const Vec3& p : boundary.points) line.push_back(p.xy());
    const auto samples = samples_within(line, kStep_m, range_m);
    predicted.samples.insert(predicted.samples.end(), samples.begin(), samples.end());
    for (std::size_t i = 1; i < line.size(); ++i) predicted.segments.push_back({line[i - 1], line[i]});
  }
  return predicted;
}

bool is_within(Vec2 p, double range_m) { return std::hypot(p.x, p.y) < range_m; }

/// Which places have a point of the ground within 1 m, on a raster of 0.25 m.
class SeenGround {
 public:
  SeenGround(std::span<const Vec2> ground, double reach_m)
      : offset_(reach_m + kMargin_m),
        size_(static_cast<std::int64_t>(2.0 * offset_ / kCell_m)),
        marks_(static_cast<std::size_t>(size_ * size_)) {
    for (const Vec2 p : ground) {
      const std::int64_t column = cell(p.x);
      const std::int64_t row = cell(p.y);
      const bool inside =
          column >= kRadius && column < size_ - kRadius && row >= kRadius && row < size_ - kRadius;
      if (inside) marks_[index(column, row)] = true;
    }
  }

  /// `p` lies within the reach.
  [[nodiscard]] bool near(Vec2 p) const {
    const std::int64_t column = cell(p.x);
    const std::int64_t row = cell(p.y);
    for (std::int64_t dx = -kRadius; dx <= kRadius; ++dx) {
      for (std::int64_t dy = -kRadius; dy <= kRadius; ++dy) {
        if (dx * dx + dy * dy <= kRadius * kRadius && marks_[index(column + dx, row + dy)]) return true;
      }
    }
    return false;
  }

 private:
  static constexpr double kCell_m = 0.25;
  static constexpr double kMargin_m = 4.0;  // of cells around the reach, so that no neighbour is outside
  static constexpr std::int64_t kRadius = 4;

  [[nodiscard]] std::int64_t cell(double coordinate) const {
    const double at = std::floor((coordinate + offset_) / kCell_m);
    return static_cast<std::int64_t>(std::clamp(at, -1.0, static_cast<double>(size_)));
  }
  [[nodiscard]] std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(column * size_ + row);
  }

  double offset_;
  std::int64_t size_;
  std::vector<bool> marks_;
};

std::vector<Vec2> places_of(const LabelledTruth& truth) {
  std::vector<Vec2> places;
  places.reserve(truth.points.size());
  for (const TruePoint& point : truth.points) places.push_back(point.place);
  return places;
}

/// The samples that labels say something about.
std::vector<Vec2> judgeable(std::vector<Vec2> samples, const LabelledTruth& truth, double range_m) {
  if (truth.ground) {
    const SeenGround seen(*truth.ground, range_m);
    std::erase_if(samples, [&](Vec2 p) { return !seen.near(p); });
  } else {
    const NearestPoint annotated(places_of(truth), kAnnotatedBeside_m);
    std::erase_if(samples, [&](Vec2 p) { return !std::isfinite(annotated.distance(p)); });
  }
  return samples;
}

/// A true point within the range: whether it is a kerb, and how far the prediction misses it.
struct Miss {
  bool kerb = false;
  double distance_m = 0.0;
};

std::vector<Miss> misses_of(const LabelledTruth& truth, const Predicted& predicted, double range_m,
                            double limit) {
  const NearestSegment lines(predicted.segments, limit);
  const NearestPoint samples(predicted.samples, limit);
  std::vector<Miss> misses;
  for (const TruePoint& point : truth.points) {
    if (!is_within(point.place, range_m)) continue;
    misses.push_back({truth.ground && point.step_m && *point.step_m >= kKerb_m,
                      std::min(lines.distance(point.place), samples.distance(point.place))});
  }
  return misses;
}

/// A predicted sample: how far it is from the truth, and whether the truth may run unseen there.
struct Guess {
  double distance_m = 0.0;
  bool hidden = false;
};

std::vector<Guess> guesses_of(const LabelledTruth& truth, const Predicted& predicted, double limit) {
  const NearestSegment lines(truth.segments, limit);
  const NearestPoint points(places_of(truth), limit);
  const NearestSegment hidden(truth.hidden, kHiddenBeside_m);
  std::vector<Guess> guesses;
  for (const Vec2 p : predicted.samples) {
    guesses.push_back({std::min(lines.distance(p), points.distance(p)), std::isfinite(hidden.distance(p))});
  }
  return guesses;
}

double f1_of(double precision, double recall) {
  constexpr double kTiny = 1e-9;
  return 2.0 * precision * recall / std::max(kTiny, precision + recall);
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

ToleranceScore score_at(double tolerance_m, std::span<const Miss> misses, std::span<const Guess> guesses) {
  ToleranceScore score{.tolerance_m = tolerance_m};
  for (const Miss& miss : misses) {
    if (miss.distance_m >= tolerance_m) continue;
    ++score.found;
    score.found_kerbs += miss.kerb ? 1U : 0U;
    score.squared_m2 += miss.distance_m * miss.distance_m;
  }
  for (const Guess& guess : guesses) {
    const bool right = guess.distance_m < tolerance_m;
    score.right += right ? 1U : 0U;
    score.judged += right || !guess.hidden ? 1U : 0U;
  }
  score.f1_sum = f1_of(share(score.right, score.judged), share(score.found, misses.size()));
  return score;
}

}  // namespace

std::vector<Vec2> samples_within(std::span<const Vec2> line, double step, double reach) {
  constexpr double kLongest_m = 1e9;
  std::vector<Vec2> samples;
  const auto keep = [&](Vec2 p) {
    if (is_within(p, reach)) samples.push_back(p);
  };
  const auto station = [&](std::int64_t k) { return static_cast<double>(k) * step; };
  if (line.size() == 1) keep(line.front());
  if (line.size() < 2) return samples;
  double start = 0.0;
  for (std::size_t i = 1; i < line.size() && start < kLongest_m; ++i) {
    const Vec2 a = line[i - 1];
    const Vec2 ab = line[i] - a;
    const double length = std::hypot(ab.x, ab.y);
    const double end = start + length;
    // Only the stations inside the reach (and one more at each end, for the last digits) are worked out.
    const auto inside = share_inside({a, line[i]}, reach);
    if (inside && end < kLongest_m) {
      const auto first = static_cast<std::int64_t>((start + inside->first * length) / step) - 1;
      const double last = start + inside->second * length + step;
      for (std::int64_t k = std::max<std::int64_t>(first, 0); station(k) < end && station(k) <= last; ++k) {
        const double along = station(k) - start;
        if (along >= 0.0) keep({ab.x / (end - start) * along + a.x, ab.y / (end - start) * along + a.y});
      }
    }
    start = end;
  }
  if (!(start < kLongest_m)) return samples;
  // The station at the end, or past it by less than half a step.
  const auto count = static_cast<std::int64_t>(std::ceil((start + step / 2.0) / step));
  for (std::int64_t k = std::max<std::int64_t>(count - 2, 0); k < count; ++k) {
    if (station(k) >= start) keep(line.back());
  }
  return samples;
}

LabelScore& LabelScore::operator+=(const LabelScore& more) {
  scans += more.scans;
  absent += more.absent;
  true_points += more.true_points;
  kerb_points += more.kerb_points;
  samples += more.samples;
  if (at.empty()) {
    at = more.at;
    return *this;
  }
  assert(more.at.empty() || more.at.size() == at.size());
  for (std::size_t i = 0; i < more.at.size(); ++i) {
    assert(at[i].tolerance_m == more.at[i].tolerance_m);
    at[i].found += more.at[i].found;
    at[i].found_kerbs += more.at[i].found_kerbs;
    at[i].judged += more.at[i].judged;
    at[i].right += more.at[i].right;
    at[i].squared_m2 += more.at[i].squared_m2;
    at[i].f1_sum += more.at[i].f1_sum;
  }
  return *this;
}

LabelScore score(const LabelledTruth& truth, const Scene* prediction, const LabelScoreConfig& config) {
  double limit = 0.0;
  for (const double tolerance_m : config.tolerance_m) limit = std::max(limit, tolerance_m);
  Predicted predicted = predicted_by(prediction, config.range_m);
  LabelScore score;
  score.scans = 1;
  score.absent = prediction == nullptr ? 1U : 0U;
  score.samples = predicted.samples.size();
  predicted.samples = judgeable(std::move(predicted.samples), truth, config.range_m);
  const std::vector<Miss> misses = misses_of(truth, predicted, config.range_m, limit);
  const std::vector<Guess> guesses = guesses_of(truth, predicted, limit);
  score.true_points = misses.size();
  score.kerb_points = static_cast<std::size_t>(
      std::count_if(misses.begin(), misses.end(), [](const Miss& miss) { return miss.kerb; }));
  for (const double tolerance_m : config.tolerance_m)
    score.at.push_back(score_at(tolerance_m, misses, guesses));
  return score;
}

LabelFigures figures_of(const LabelScore& score, const ToleranceScore& at) {
  LabelFigures figures;
  figures.precision = share(at.right, at.judged);
  figures.recall = share(at.found, score.true_points);
  figures.f1 = f1_of(figures.precision, figures.recall);
  figures.macro_f1 = at.f1_sum / static_cast<double>(std::max<std::size_t>(1, score.scans));
  if (score.kerb_points > 0) figures.kerb_recall = share(at.found_kerbs, score.kerb_points);
  figures.rmse_m = std::sqrt(at.squared_m2 / static_cast<double>(std::max<std::size_t>(1, at.found)));
  figures.judged = share(at.judged, score.samples);
  return figures;
}

}  // namespace verge::eval
