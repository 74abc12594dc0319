// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "verge/core/angle.hpp"

namespace verge::detect::line_fit {
namespace {

/// A picture from above: its columns go to the right, its rows backwards.
Trace::Raster raster_of(std::string name, const raster::Picture& picture, const raster::Grid& grid) {
  Trace::Raster raster{std::move(name),
                       static_cast<std::size_t>(picture.rows),
                       static_cast<std::size_t>(picture.cols),
                       {},
                       {"y", "m", grid.y_max_m, -grid.cell_m},
                       {"x", "m", grid.x_max_m, -grid.cell_m}};
  raster.values.assign(picture.grey.begin(), picture.grey.end());
  return raster;
}

/// Angles to the right, rho downwards.
Trace::Raster raster_of(const raster::Accumulator& accumulator, double cell_m) {
  const auto rows = static_cast<std::size_t>(accumulator.bins());
  const auto cols = static_cast<std::size_t>(accumulator.angles);
  const double first_deg = rad_to_deg(accumulator.theta_rad(0));
  Trace::Raster raster{"accumulator",
                       rows,
                       cols,
                       std::vector<float>(rows * cols),
                       {"theta", "deg", first_deg, rad_to_deg(accumulator.theta_rad(1)) - first_deg},
                       {"rho", "m", -accumulator.reach * cell_m, cell_m}};
  for (std::size_t angle = 0; angle < cols; ++angle) {
    const auto column = accumulator.column(static_cast<int>(angle));
    for (std::size_t bin = 0; bin < rows; ++bin)
      raster.values[bin * cols + angle] = static_cast<float>(column[bin]);
  }
  return raster;
}

/// The edge's path, a point every half metre.
std::vector<Vec2> path_of(const Edge& edge) {
  constexpr double kStep_m = 0.5;
  const auto steps = static_cast<std::size_t>(std::ceil(edge.length_m() / kStep_m));
  std::vector<Vec2> path;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = steps > 0 ? static_cast<double>(i) / static_cast<double>(steps) : 0.0;
    path.push_back(place_on(edge.curve, std::lerp(edge.from_m, edge.to_m, part)));
  }
  return path;
}

}  // namespace

void Recorder::line(std::string name, std::span<const Vec2> path) {
  Trace::Line line{std::move(name), {}};
  for (const Vec2 p : path) line.points.push_back(to_sensor(p));
  trace_->lines.push_back(std::move(line));
}

void Recorder::points(std::string name, std::span<const LayerPoint> points) {
  if (!is_on()) return;
  Trace::Points layer{std::move(name), {}, {}};
  for (const LayerPoint& p : points) {
    layer.points.push_back(frame_.to_sensor(p.place));
    layer.group.push_back(static_cast<int>(p.layer));
  }
  trace_->points.push_back(std::move(layer));
}

void Recorder::objects(std::span<const FoundObject> objects) {
  if (!is_on()) return;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const fit::LShape& shape = objects[i].shape;
    line(fmt::format("object {}", i),
         std::vector<Vec2>{shape.edges[0].end, shape.corner, shape.edges[1].end});
  }
}

void Recorder::groups(std::string name, std::span<const LayerPoint> points, const Groups& groups) {
  if (!is_on()) return;
  Trace::Points layer{std::move(name), {}, {}};
  for (std::size_t group = 0; group < groups.points.size(); ++group) {
    for (const std::size_t i : groups.points[group]) {
      layer.points.push_back(frame_.to_sensor(points[i].place));
      layer.group.push_back(static_cast<int>(group));
    }
  }
  trace_->points.push_back(std::move(layer));
  if (groups.centroids.empty()) return;
  Trace::Points centroids{"centroids", {}, {}};
  for (const Vec2 c : groups.centroids) centroids.points.push_back(to_sensor(c));
  trace_->points.push_back(std::move(centroids));
}

void Recorder::edge(std::string name, const Edge& edge) {
  if (is_on()) line(std::move(name), path_of(edge));
}

void Recorder::hough(const HoughSteps& steps) {
  if (!is_on() || steps.accumulator.angles < 2) return;
  trace_->rasters.push_back(raster_of("squares", steps.squares, steps.grid));
  trace_->rasters.push_back(raster_of("edges", steps.edges, steps.grid));
  trace_->rasters.push_back(raster_of(steps.accumulator, steps.grid.cell_m));
  Trace::Values peaks{"peaks", {}};
  for (const raster::HoughPeak& peak : steps.peaks) {
    peaks.values.insert(peaks.values.end(), {rad_to_deg(peak.theta_rad), peak.rho_px * steps.grid.cell_m,
                                             static_cast<double>(peak.count)});
  }
  trace_->values.push_back(std::move(peaks));
  for (std::size_t i = 0; i < steps.segments.size(); ++i)
    line(fmt::format("hough segment {}", i), std::vector<Vec2>{steps.segments[i].from, steps.segments[i].to});
}

}  // namespace verge::detect::line_fit
