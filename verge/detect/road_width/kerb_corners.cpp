// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/kerb_corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace verge::detect::road_width {
namespace {

constexpr double kLongest_m = 30.0;  // of an opening
constexpr double kBefore_m = 2.5;    // of straight kerb that is looked at with it

/// Index of the outermost point of the line that is not beyond `reach_m` to that side.
std::size_t outermost(const LayerLine& line, std::size_t edge, double reach_m, bool left) {
  std::size_t i = edge;
  while (i != line.middle && std::fabs(line.points[i].x) > reach_m) left ? ++i : --i;
  return i;
}

/// The point of the line where it comes to `lateral_m` on that side; its end where it does not.
std::size_t crossing(const LayerLine& line, std::size_t edge, double lateral_m, bool left) {
  std::size_t i = line.middle;
  while (i != edge && std::fabs(line.points[i].x) < lateral_m) left ? --i : ++i;
  return i;
}

/// The innermost point of what stands on the road within a line's end: lines run under cars, and over their
/// fronts. None where nothing does.
std::optional<std::size_t> standing(const LayerLine& line, double end_m, double height_m, bool left) {
  constexpr std::size_t kLeast = 3;
  const double road_m = line.level[line.middle].z;
  std::optional<std::size_t> innermost;
  std::size_t count = 0;
  for (std::size_t i = left ? 0 : line.middle; i < (left ? line.middle : line.points.size()); ++i) {
    const double lateral_m = std::fabs(line.points[i].x);
    if (lateral_m >= end_m || line.level[i].z - road_m < height_m) continue;
    ++count;
    if (!innermost || lateral_m < std::fabs(line.points[*innermost].x)) innermost = i;
  }
  return count >= kLeast ? innermost : std::nullopt;
}

/// One end of a line.
struct End {
  SightKind kind = SightKind::kKerb;
  Vec3 place{};  // in the level frame
  Vec3 along{};  // what says how far along the way: of an open line, where it crosses the kerb's line
};

End end_of(const Road& road, double reach_m, double kerb_m, double height_m, bool left) {
  const RoadEnd& end = left ? road.road.left : road.road.right;
  const std::size_t index = outermost(road.line, end.edge, reach_m, left);
  const double end_m = std::fabs(road.line.points[index].x);
  if (const auto thing = standing(road.line, end_m, height_m, left))
    return {SightKind::kThing, road.line.level[*thing], road.line.level[*thing]};
  if (end.kind == LineEnd::kOpen || index != end.edge)
    return {SightKind::kOpen, road.line.level[index],
            road.line.level[crossing(road.line, index, kerb_m, left)]};
  const Vec3 kerb = left ? road.left : road.right;
  return {SightKind::kKerb, kerb, kerb};
}

}  // namespace

double KerbCorners::widened_m(const StraightKerb& kerb) const {
  constexpr double kSigmas = 3.0;
  return std::max(config_.beyond_m, kSigmas * kerb.sigma_m);
}

void KerbCorners::add_sights(const std::vector<Road>& roads, const Whereabouts& here) {
  const double reach = reach_m(roads, config_);
  const Vec2 place = here.T_world_level.translation.xy();
  for (const Road& road : roads) {
    if (!road.road.middle_is_road) continue;
    std::array<End, 2> ends;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& kerb = watches_.at(side).kerb;
      ends.at(side) =
          end_of(road, reach, kerb ? -kerb->outward_m(place) : reach, config_.standing_m, side == 0);
    }
    const auto world_of = [&](Vec3 p) { return (here.T_world_level * p).xy(); };
    for (std::size_t side = 0; side < 2; ++side) {
      const End& end = ends.at(side);
      const End& opposite = ends.at(1 - side);
      const double ahead_m = dot(world_of(end.along) - place, here.course);
      watches_.at(side).profile.see({.along_m = here.way_m + ahead_m,
                                     .ahead_m = ahead_m,
                                     .kind = end.kind,
                                     .from = place,
                                     .end = world_of(end.place),
                                     .opposite = world_of(opposite.place),
                                     .opposite_kind = opposite.kind});
    }
  }
}

void KerbCorners::fit_kerb(Watch& watch, bool left, const Whereabouts& here, double to_m) const {
  const double from_m = std::max(here.way_m - config_.straight_m, watch.clear_from_m);
  if (auto kerb = watch.profile.straight(from_m, to_m, here.course, left)) watch.kerb = kerb;
}

std::optional<KerbReturn> KerbCorners::turn_at(const std::vector<KerbPoint>& points, double first_m,
                                               const StraightKerb& kerb) const {
  constexpr double kLeastSigma_m = 0.03;  // of a point; kerbs are not exactly straight or round
  constexpr double kBehind_m = 4.0;       // beyond lies the other corner of a narrow side road
  const auto begin = std::find_if(points.begin(), points.end(),
                                  [&](const KerbPoint& p) { return p.along_m >= first_m - kBefore_m; });
  const auto end =
      std::find_if(begin, points.end(), [&](const KerbPoint& p) { return p.along_m > first_m + kBehind_m; });
  return fit_kerb_return({begin, end}, first_m, std::max(kerb.sigma_m, kLeastSigma_m),
                         {config_.wide_return_m, config_.widest_return_m});
}

std::optional<FoundCorner> KerbCorners::corner_of(const Opening& opening,
                                                  const std::vector<KerbPoint>& points,
                                                  const StraightKerb& kerb, const Whereabouts& here) const {
  constexpr double kTurning_m = 1.0;
  constexpr double kSure = 0.95;
  constexpr double kRound = 0.7;
  constexpr double kSigmas = 2.0;
  constexpr double kSharp_m = 0.16;  // sigma with which one need not wait
  const auto turn = turn_at(points, opening.first_m, kerb);
  if (!turn) return std::nullopt;
  const double ahead_m = turn->begin_m - here.way_m;
  if (ahead_m < 0.0) return std::nullopt;
  const bool is_last_chance = ahead_m < 1.5 * here.step_m + 0.5;
  if (turn->sigma_m > kSharp_m && !is_last_chance) return std::nullopt;
  const double seen_m = opening.last_m - opening.first_m;
  // A round corner turns for a while before it is seen beyond the kerb: where it surely has begun.
  const double surely_m = opening.last_m - (turn->begin_m + kSigmas * turn->sigma_m);
  const double length_m = is_last_chance ? std::max(seen_m, surely_m) : seen_m;
  const bool is_long = length_m >= config_.opening_m && opening.depth_m >= config_.bay_m;
  const bool is_wide = seen_m >= kTurning_m && turn->wide >= kSure && turn->share >= kRound &&
                       opening.depth_m >= config_.turned_m;
  if (!is_long && !is_wide) return std::nullopt;
  return FoundCorner{.at_m = turn->begin_m, .sigma_m = turn->sigma_m, .radius_m = turn->radius_m};
}

void KerbCorners::look_for_corner(Watch& watch, const Watch& other, bool left, const Whereabouts& here,
                                  CornerTracks& tracks) const {
  constexpr double kBehind_m = 1.5;
  constexpr double kTurning_m = 2.0;  // before it is seen beyond the kerb, it may have been turning so long
  const double seen_from_m = std::max(watch.clear_from_m, watch.profile.begin_m());
  fit_kerb(watch, left, here, std::max(here.way_m, seen_from_m + config_.straight_m / 2.0));
  if (!watch.kerb) return;
  const auto look = [&] {
    return watch.profile.against(*watch.kerb, other.kerb ? &*other.kerb : nullptr,
                                 std::max(here.way_m - kBehind_m, watch.clear_from_m));
  };
  auto points = look();
  auto opening = last_opening(points, widened_m(*watch.kerb));
  const double newest_m = points.empty() ? here.way_m : points.back().along_m;
  fit_kerb(watch, left, here, opening ? opening->first_m - kTurning_m : newest_m);
  points = look();
  opening = last_opening(points, widened_m(*watch.kerb));
  if (!opening) return;
  auto corner = corner_of(*opening, points, *watch.kerb, here);
  if (!corner) return;
  const Vec2 ahead = here.T_world_level.translation.xy() + (corner->at_m - here.way_m) * here.course;
  corner->side = left ? CornerSide::kLeft : CornerSide::kRight;
  corner->place = fit::point_at(watch.kerb->line, fit::station(watch.kerb->line, ahead));
  tracks.add(*corner);
  watch.in_corner = corner;
}

void KerbCorners::look_for_exit(Watch& watch, const Watch& other, const Whereabouts& here,
                                CornerTracks& tracks) const {
  const double from_m = watch.in_corner->at_m;
  const double beyond_m = widened_m(*watch.kerb);
  const auto points =
      watch.profile.against(*watch.kerb, other.kerb ? &*other.kerb : nullptr, from_m - kBefore_m);
  const auto exit_m = end_of_opening(points, from_m + config_.opening_m / 2.0, beyond_m);
  if (exit_m) {
    const auto turn = turn_at(points, from_m, *watch.kerb);  // by now all of it has been seen
    const double radius_m = turn ? turn->radius_m : watch.in_corner->radius_m;
    const double to_go_m = std::sqrt(2.0 * radius_m * beyond_m);  // of the other corner's circle
    tracks.leave(watch.in_corner->side, *exit_m + to_go_m, radius_m);
  } else if (here.way_m - from_m < kLongest_m) {
    return;
  }
  watch.in_corner.reset();
  watch.clear_from_m = exit_m.value_or(here.way_m);
}

void KerbCorners::see(const std::vector<Road>& roads, const Whereabouts& here, CornerTracks& tracks) {
  add_sights(roads, here);
  for (std::size_t side = 0; side < 2; ++side) {
    Watch& watch = watches_.at(side);
    const Watch& other = watches_.at(1 - side);
    const bool left = side == 0;
    watch.profile.forget_before(here.way_m - kLongest_m);
    if (watch.in_corner) {
      look_for_exit(watch, other, here, tracks);
    } else {
      look_for_corner(watch, other, left, here, tracks);
    }
  }
}

}  // namespace verge::detect::road_width
