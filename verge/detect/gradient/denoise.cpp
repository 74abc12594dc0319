// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/denoise.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace verge::detect::gradient {
namespace {

constexpr double kPerMetre = 0.2;  // how far a boundary may lie aside of where it led, a metre on: it bends

/// Distance on level ground between two rings of those elevations, at ground range rho: (rho^2 + h^2) / h per
/// radian.
double ring_spacing(double rho, double height, double elevation_a, double elevation_b) {
  constexpr double kLowest = 0.1;  // metres
  const double h = std::max(height, kLowest);
  return (rho * rho + h * h) / h * std::abs(elevation_a - elevation_b);
}

/// Unit vector from a to b; none where they coincide.
std::optional<Vec2> direction(Vec2 a, Vec2 b) {
  const double length = distance(a, b);
  if (!(length > 1e-6)) return std::nullopt;
  return (1.0 / length) * (b - a);
}

Vec2 foot_of(const Candidate& c) { return c.foot.xy(); }

/// Direction of the last few points of a chain; none while they are too close together to tell.
std::optional<Vec2> heading_of(const Chain& chain) {
  constexpr std::size_t kLast = 4;
  constexpr double kLeast = 0.4;  // metres
  const std::size_t first = chain.points.size() > kLast ? chain.points.size() - kLast : 0;
  const Vec2 a = foot_of(chain.points[first]);
  const Vec2 b = foot_of(chain.points.back());
  return distance(a, b) > kLeast ? direction(a, b) : std::nullopt;
}

/// Distance from the chain's end where the candidate continues it; none where it does not.
std::optional<double> continues(const Chain& chain, const Candidate& next, double height,
                                const GradientConfig& config) {
  const Candidate& last = chain.points.back();
  if (chain.obstacle != next.obstacle || next.ring <= last.ring) return std::nullopt;
  if (next.ring - last.ring > static_cast<std::size_t>(config.link_skip) + 1) return std::nullopt;
  const Vec2 step = foot_of(next) - foot_of(last);
  const double spacing = ring_spacing(norm(foot_of(next)), height, last.elevation_rad, next.elevation_rad);
  const double widest = std::min(config.link_max_m, config.link_factor * spacing);
  if (norm(step) > std::max(config.link_min_m, widest)) return std::nullopt;
  if (const auto heading = heading_of(chain)) {
    constexpr double kBack = -0.1;  // metres: noise may take a step back
    const double along = dot(*heading, step);
    const double aside = std::abs(cross(*heading, step));
    if (along < kBack || aside > config.link_lateral_m + kPerMetre * std::max(along, 0.0))
      return std::nullopt;
  }
  return norm(step);
}

/// How many scan lines cross a bridge between the place where it is nearest to the sensor and the first point
/// of a chain, and show no boundary there. Those that would only touch it lie at the elevation of that place.
double scan_lines_missing(const Chain& chain, double nearest_m, double height_m) {
  const Candidate& first = chain.points[0];
  const Candidate& second = chain.points[1];
  const double step =
      (second.elevation_rad - first.elevation_rad) / static_cast<double>(second.ring - first.ring);
  const double touching = -std::atan2(height_m, nearest_m);
  if (!(step > 0.0)) return 0.0;
  return std::clamp((first.elevation_rad - touching) / step, 0.0, static_cast<double>(first.ring));
}

/// Whether a rear chain runs on from a front chain, and how far apart their inner ends are. What lies between
/// them must be what scan lines do not cross, be it 15 m: not the mouth of a side road.
std::optional<double> runs_on(const Chain& front, const Chain& rear, double height_m,
                              const GradientConfig& config) {
  constexpr double kTouching = 0.3;  // metres: too close for a direction of its own
  constexpr std::size_t kLook = 3;   // points from the end that show its direction
  const Vec2 a = foot_of(front.points.front());
  const Vec2 b = foot_of(rear.points.front());
  const double apart = distance(a, b);
  if (front.obstacle != rear.obstacle) return std::nullopt;
  if (apart <= kTouching) return apart;
  const auto bridge = direction(b, a);
  const double nearest = std::abs(cross(*bridge, a));
  const double missing =
      std::max(scan_lines_missing(front, nearest, height_m), scan_lines_missing(rear, nearest, height_m));
  if (missing > static_cast<double>(config.link_skip)) return std::nullopt;
  const auto ahead = direction(a, foot_of(front.points[std::min(kLook, front.points.size() - 1)]));
  const auto behind = direction(foot_of(rear.points[std::min(kLook, rear.points.size() - 1)]), b);
  if (!ahead || !behind) return std::nullopt;
  const double worst = std::min({dot(*ahead, *bridge), dot(*behind, *bridge), dot(*ahead, *behind)});
  // In a bend the bridge turns as much after the rear chain as the front chain does after it; a bridge that
  // turns there and back leads from one boundary to another beside it.
  const double there_and_back = 0.5 * std::abs(cross(*behind, *bridge) - cross(*bridge, *ahead));
  const bool beside = there_and_back * apart > config.link_lateral_m + kPerMetre * apart;
  return worst >= config.join_cosine && !beside ? std::optional(apart) : std::nullopt;
}

/// A front and a rear chain, by index, that are one boundary.
struct Join {
  double apart_m;
  std::size_t front, rear;
};

/// The nearest pairs first, each chain once: no matter which of the two is looked at first, so that what is
/// ahead and what is behind are alike.
std::vector<Join> nearest_joins(const std::vector<const Chain*>& front, const std::vector<const Chain*>& rear,
                                double height_m, const GradientConfig& config) {
  std::vector<Join> possible;
  for (std::size_t f = 0; f < front.size(); ++f) {
    for (std::size_t r = 0; r < rear.size(); ++r) {
      if (const auto apart = runs_on(*front[f], *rear[r], height_m, config))
        possible.push_back({*apart, f, r});
    }
  }
  std::stable_sort(possible.begin(), possible.end(),
                   [](const Join& a, const Join& b) { return a.apart_m < b.apart_m; });
  std::vector<Join> joins;
  for (const Join& next : possible) {
    const bool taken = std::any_of(joins.begin(), joins.end(), [&](const Join& j) {
      return j.front == next.front || j.rear == next.rear;
    });
    if (!taken) joins.push_back(next);
  }
  return joins;
}

Strand strand_of(const Chain* rear, const Chain* front, bool right) {
  Strand strand;
  strand.right = right;
  strand.obstacle = (rear != nullptr ? rear : front)->obstacle;
  if (rear != nullptr) strand.points.assign(rear->points.rbegin(), rear->points.rend());
  const std::size_t bridge = strand.points.size();
  if (front != nullptr) strand.points.insert(strand.points.end(), front->points.begin(), front->points.end());
  strand.bridged.assign(strand.points.size() - 1, false);
  if (rear != nullptr && front != nullptr) strand.bridged[bridge - 1] = true;
  return strand;
}

bool is_wall(const Strand& strand, const GradientConfig& config) {
  return distance(foot_of(strand.points.front()), foot_of(strand.points.back())) >= config.wall_length_m;
}

}  // namespace

std::vector<Chain> link_layers(Quadrant region, const std::vector<Candidate>& candidates, double height_m,
                               const GradientConfig& config) {
  std::vector<Chain> chains;
  for (const Candidate& next : candidates) {
    Chain* best = nullptr;
    double nearest = 0.0;
    for (Chain& chain : chains) {
      const auto apart = continues(chain, next, height_m, config);
      if (apart && (best == nullptr || *apart < nearest)) {
        best = &chain;
        nearest = *apart;
      }
    }
    if (best != nullptr) {
      best->points.push_back(next);
    } else {
      chains.push_back({region, next.obstacle, {next}});
    }
  }
  std::erase_if(
      chains, [&](const Chain& c) { return static_cast<std::int64_t>(c.points.size()) < config.layers_min; });
  return chains;
}

std::vector<Strand> join_front_and_rear(const std::vector<Chain>& chains, bool right, double height_m,
                                        const GradientConfig& config) {
  std::vector<const Chain*> front;
  std::vector<const Chain*> rear;
  for (const Chain& chain : chains) {
    if (is_right(chain.region) == right) (is_front(chain.region) ? front : rear).push_back(&chain);
  }
  std::vector<Strand> strands;
  for (const Join& join : nearest_joins(front, rear, height_m, config)) {
    strands.push_back(strand_of(rear[join.rear], front[join.front], right));
    front[join.front] = nullptr;
    rear[join.rear] = nullptr;
  }
  for (const Chain* chain : front) {
    if (chain != nullptr) strands.push_back(strand_of(nullptr, chain, right));
  }
  for (const Chain* chain : rear) {
    if (chain != nullptr) strands.push_back(strand_of(chain, nullptr, right));
  }
  std::erase_if(strands, [&](const Strand& s) { return s.obstacle && !is_wall(s, config); });
  return strands;
}

std::vector<Strand> denoise(const std::vector<ScanLine>& lines, double height_m,
                            const GradientConfig& config) {
  std::vector<Chain> chains;
  for (const Quadrant region : kQuadrants) {
    for (Chain& chain : link_layers(region, candidates_in(lines, region), height_m, config))
      chains.push_back(std::move(chain));
  }
  std::vector<Strand> strands = join_front_and_rear(chains, false, height_m, config);
  for (Strand& right : join_front_and_rear(chains, true, height_m, config))
    strands.push_back(std::move(right));
  return strands;
}

}  // namespace verge::detect::gradient
