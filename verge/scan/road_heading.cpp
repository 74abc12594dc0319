// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/road_heading.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "verge/core/statistics.hpp"
#include "verge/scan/scan.hpp"

namespace verge {
namespace {

constexpr double kNear = 1.5;        // metres: nearer returns are of the vehicle itself
constexpr double kFar = 25.0;        // metres: beyond, returns on a ring are too far apart
constexpr double kWindow = 0.25;     // metres of arc on each side of a return
constexpr double kLeastStep = 0.05;  // metres of height within the window
constexpr double kHighest = 2.0;     // metres above the road: what is higher says nothing about the road
constexpr double kLowest = -0.5;     // metres
constexpr std::size_t kLeastSteps = 20;
constexpr double kHeadingStep = std::numbers::pi / 180.0;
constexpr double kExact = 1e-5;     // radians
constexpr double kBin = 0.3;        // metres of lateral position
constexpr double kRival = 0.8;      // of the highest sample: what may turn out the highest peak
constexpr double kStandsOut = 1.3;  // the peak over the median of all headings

/// Points of one ring on one side of the vehicle, in the level frame, in order along the ring.
using Arc = std::vector<Vec3>;

/// Returns of ring r that may show a step, cut at straight ahead and straight behind, so that left and right,
/// front and back are alike.
std::vector<Arc> arcs_of(const Scan& scan, std::size_t r, const LevelFrame& frame) {
  Arc left;
  Arc right;
  const auto [begin, end] = scan.ring(r);
  for (std::size_t i = begin; i < end; ++i) {
    if (!(scan.range[i] > 0.0F)) continue;
    const Vec3 p = frame.to_level(scan.point(i));
    const double rho = norm(p.xy());
    if (rho < kNear || rho > kFar || p.z < kLowest || p.z > kHighest) continue;
    (p.y > 0.0 ? left : right).push_back(p);
  }
  return {std::move(left), std::move(right)};
}

/// Steps rise from about the road's height, which is less certain with distance (crown, cross-fall, slope).
bool starts_at_road(double low, double rho) {
  constexpr double kCertain = 0.15;
  constexpr double kPerMetre = 0.02;
  return std::abs(low) < kCertain + kPerMetre * rho;
}

void append_steps(const Arc& arc, std::vector<Vec2>& steps) {
  std::vector<double> s(arc.size(), 0.0);
  for (std::size_t i = 1; i < arc.size(); ++i) s[i] = s[i - 1] + distance(arc[i - 1].xy(), arc[i].xy());
  std::size_t lo = 0;
  std::size_t hi = 0;
  for (std::size_t i = 0; i < arc.size(); ++i) {
    while (s[lo] < s[i] - kWindow) ++lo;
    while (hi + 1 < arc.size() && s[hi + 1] <= s[i] + kWindow) ++hi;
    if (hi < lo + 2) continue;
    const double low = std::min(arc[lo].z, arc[hi].z);
    const bool step = std::abs(arc[hi].z - arc[lo].z) > kLeastStep;
    if (step && starts_at_road(low, norm(arc[i].xy()))) steps.push_back(arc[i].xy());
  }
}

/// How much the steps' lateral positions pile up when the road runs along `heading`: sum of squares of a
/// histogram. Each step is shared by three bins as a quadratic B-spline does, so that the score is smooth in
/// the heading, and mirrored steps give the mirrored histogram.
double pile_up(const std::vector<Vec2>& steps, double heading) {
  const Vec2 across{-std::sin(heading), std::cos(heading)};
  constexpr int kHalf = static_cast<int>(kFar / kBin) + 2;
  std::vector<double> histogram(2 * kHalf + 1, 0.0);
  for (const Vec2 p : steps) {
    const double at = dot(across, p) / kBin + kHalf;
    const double nearest = std::round(at);
    const double off = at - nearest;
    const auto middle = static_cast<std::size_t>(nearest);
    histogram[middle - 1] += 0.5 * (0.5 - off) * (0.5 - off);
    histogram[middle] += 0.75 - off * off;
    histogram[middle + 1] += 0.5 * (0.5 + off) * (0.5 + off);
  }
  double sum = 0.0;
  for (const double h : histogram) sum += h * h;
  return sum;
}

/// A heading and how much the steps pile up along it.
struct Peak {
  double heading_rad = 0.0;
  double score = 0.0;
};

/// The top of the one peak between low and high, by narrowing from both sides.
Peak top_between(const std::vector<Vec2>& steps, double low, double high) {
  while (high - low > kExact) {
    const double third = (high - low) / 3.0;
    const bool rises = pile_up(steps, low + third) < pile_up(steps, high - third);
    (rises ? low : high) += rises ? third : -third;
  }
  const double middle = 0.5 * (low + high);
  return {middle, pile_up(steps, middle)};
}

/// The highest peak. Of near-equal ones the tops decide, not the samples: which top a sample lies nearest to
/// is chance.
double highest_peak(const std::vector<Vec2>& steps, const std::vector<double>& score, double first) {
  const double rival = kRival * *std::max_element(score.begin(), score.end());
  Peak best;
  for (std::size_t i = 0; i < score.size(); ++i) {
    const bool rises = i == 0 || score[i] >= score[i - 1];
    const bool falls = i + 1 == score.size() || score[i] >= score[i + 1];
    if (!rises || !falls || score[i] < rival) continue;
    const double sample = first + static_cast<double>(i) * kHeadingStep;
    const Peak peak = top_between(steps, sample - kHeadingStep, sample + kHeadingStep);
    if (peak.score > best.score) best = peak;
  }
  return best.heading_rad;
}

bool stands_out(const std::vector<double>& score) {
  return *std::max_element(score.begin(), score.end()) > kStandsOut * median(score).value_or(0.0);
}

}  // namespace

std::optional<double> find_road_heading(const Scan& scan, const Mount& level, const MountConfig& config) {
  const LevelFrame frame(level);
  std::vector<Vec2> steps;
  for (std::size_t r = 0; r < scan.ring_count(); ++r) {
    for (const Arc& arc : arcs_of(scan, r, frame)) append_steps(arc, steps);
  }
  if (steps.size() < kLeastSteps) return std::nullopt;

  const int n = static_cast<int>(config.heading_max_rad / kHeadingStep);
  std::vector<double> score;
  for (int k = -n; k <= n; ++k) score.push_back(pile_up(steps, k * kHeadingStep));
  if (!stands_out(score)) return std::nullopt;
  return highest_peak(steps, score, -n * kHeadingStep);
}

}  // namespace verge
