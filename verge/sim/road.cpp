// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sim/road.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/core/field_io.hpp"

namespace verge::sim {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

template <class Part>
void check_all(const std::vector<Part>& parts) {
  for (const Part& part : parts) check_fields(part);
}

RoadConfig checked(RoadConfig config) {
  check_fields(config);
  check_all(config.pieces);
  check_all(config.widths);
  check_all(config.heights);
  check_all(config.gaps);
  check_all(config.bays);
  check_all(config.islands);
  check_all(config.rows);
  check_all(config.items);
  const auto by_station = [](const auto& a, const auto& b) { return a.at_m < b.at_m; };
  require(std::is_sorted(config.widths.begin(), config.widths.end(), by_station) &&
              std::is_sorted(config.heights.begin(), config.heights.end(), by_station),
          "widths and heights must stand in the order of their stations");
  for (const Island& island : config.islands) {
    require(island.width_m <= island.length_m, "an island must not be wider than long");
  }
  return config;
}

// 1 on [from, to], falling evenly to 0 over `ramp` on both sides.
double plateau(double from, double to, double ramp, double s) {
  const double beyond = std::max(from - s, s - to);
  return std::clamp(1.0 - beyond / ramp, 0.0, 1.0);
}

double bay_depth(const Bay& bay, double s) {
  const double from = bay.at_m + bay.taper_m;
  return bay.depth_m * plateau(from, from + bay.length_m, bay.taper_m, s);
}

// A value that changes evenly between nodes, from `first` at station 0, and stays after the last one.
template <class Node>
double between(const std::vector<Node>& nodes, double Node::*value, double first, double s) {
  double at = 0.0;
  double here = first;
  for (const Node& node : nodes) {
    const double span = node.at_m - at;
    if (s < node.at_m)
      return span > 0.0 ? here + (node.*value - here) * std::max(0.0, s - at) / span : node.*value;
    at = node.at_m;
    here = node.*value;
  }
  return here;
}

}  // namespace

double sign_of(RoadSide side) { return side == RoadSide::kLeft ? 1.0 : -1.0; }
RoadSide opposite(RoadSide side) { return side == RoadSide::kLeft ? RoadSide::kRight : RoadSide::kLeft; }

Road::Road(RoadConfig config, const Station& start)
    : config_(checked(std::move(config))), line_(config_.pieces, start, config_.closed) {
  for (double s = 0.0; s <= length_m(); s += 0.5) {
    const double curvature = line_.at(s).curvature_1pm;
    const RoadSide inner = curvature > 0.0 ? RoadSide::kLeft : RoadSide::kRight;
    require(std::fabs(curvature) * edge_offset(inner, s) < 0.98, "a curve is tighter than the road is wide");
  }
}

double Road::half_width(double station_m) const {
  return 0.5 * between(config_.widths, &WidthAt::width_m, config_.width_m, station_m);
}

double Road::edge_offset(RoadSide side, double station_m) const {
  double offset = half_width(station_m);
  for (const Bay& bay : config_.bays) {
    if (bay.side == side) offset += bay_depth(bay, station_m);
  }
  return offset;
}

EdgePoint Road::edge_point(RoadSide side, double station_m) const {
  constexpr double kStep_m = 1e-4;  // offsets change evenly between breaks, so that any step gives the slope
  const Station place = line_.at(station_m);
  const double sign = sign_of(side);
  const double offset = edge_offset(side, station_m);
  const double slope =
      (edge_offset(side, station_m + kStep_m) - edge_offset(side, station_m - kStep_m)) / (2.0 * kStep_m);
  const Vec2 ahead = along(place.heading_rad);
  const Vec2 left = left_of(place.heading_rad);
  const double stretch = 1.0 - place.curvature_1pm * sign * offset;
  const Vec2 normal = sign * stretch * left - slope * ahead;
  return {place.position + sign * offset * left, (1.0 / norm(normal)) * normal};
}

double Road::step_height(RoadSide side, double station_m) const {
  if (edge(side) == Edge::kWall) return config_.wall_m;
  if (edge(side) != Edge::kKerb) return 0.0;
  double height = config_.kerb_m;
  for (const Gap& gap : config_.gaps) {
    if (gap.side != side) continue;
    const double half = 0.5 * gap.width_m;
    const double lowered = plateau(gap.at_m - half, gap.at_m + half, gap.ramp_m, station_m);
    height = std::min(height, config_.kerb_m + lowered * (gap.height_m - config_.kerb_m));
  }
  return height;
}

std::vector<double> Road::breaks(RoadSide side) const {
  std::vector<double> stations = line_.joints();
  for (const WidthAt& width : config_.widths) stations.push_back(width.at_m);
  for (const Bay& bay : config_.bays) {
    if (bay.side != side) continue;
    const double from = bay.at_m + bay.taper_m;
    const double to = from + bay.length_m;
    stations.insert(stations.end(), {bay.at_m, from, to, to + bay.taper_m});
  }
  for (const Gap& gap : config_.gaps) {
    if (gap.side != side || edge(side) != Edge::kKerb) continue;
    const double from = gap.at_m - 0.5 * gap.width_m;
    const double to = from + gap.width_m;
    stations.insert(stations.end(), {from - gap.ramp_m, from, to, to + gap.ramp_m});
  }
  std::erase_if(stations, [this](double s) { return s < 0.0 || s > length_m(); });
  std::sort(stations.begin(), stations.end());
  stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
  return stations;
}

// Area under the even slopes from station 0; before it the road is level.
double Road::profile_area(double station_m) const {
  if (station_m < 0.0) return station_m * between(config_.heights, &HeightAt::height_m, 0.0, station_m);
  double area = 0.0;
  double at = 0.0;
  double height = 0.0;
  for (const HeightAt& node : config_.heights) {
    if (station_m < node.at_m) {
      const double here = between(config_.heights, &HeightAt::height_m, 0.0, station_m);
      return area + 0.5 * (height + here) * (station_m - at);
    }
    area += 0.5 * (height + node.height_m) * (node.at_m - at);
    at = node.at_m;
    height = node.height_m;
  }
  return area + height * (station_m - at);
}

double Road::profile(double station_m) const {
  if (config_.heights.empty()) return 0.0;
  const double window = config_.vertical_curve_m;
  if (window <= 0.0) return between(config_.heights, &HeightAt::height_m, 0.0, station_m);
  // The mean over a window turns each corner of the slopes into a parabola as long as the window.
  return (profile_area(station_m + 0.5 * window) - profile_area(station_m - 0.5 * window)) / window;
}

namespace {

Station start_of(const RoadConfig& config, const std::vector<Road>& roads) {
  if (config.branch_of == 0) return {{config.x_m, config.y_m}, deg_to_rad(config.heading_deg), 0.0};
  const auto parent = static_cast<std::size_t>(config.branch_of - 1);
  require(parent < roads.size(), "it must branch off a road before it in the list");
  require(!config.closed, "a branch cannot be closed");
  require(config.at_m <= roads[parent].length_m(), "it branches off beyond the other road's end");
  Station start = roads[parent].line().at(config.at_m);
  start.heading_rad += sign_of(config.side) * deg_to_rad(config.angle_deg);
  return start;
}

}  // namespace

std::vector<Road> make_roads(const std::vector<RoadConfig>& configs) {
  std::vector<Road> roads;
  for (const RoadConfig& config : configs) {
    try {
      roads.emplace_back(config, start_of(config, roads));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("road {}: {}", roads.size() + 1, error.what()));
    }
  }
  require(!roads.empty(), "a world needs a road");
  return roads;
}

}  // namespace verge::sim
