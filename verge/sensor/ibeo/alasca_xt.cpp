// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/alasca_xt.hpp"

#include "verge/core/angle.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr unsigned kEchoMost = 3;

/// Which count a point goes to.
std::uint64_t PointCounts::*fate_of(const AlascaPoint& point, const AlascaModel& model) {
  if (point.layer >= model.layer_elevation_rad.size()) return &PointCounts::bad_layer;
  if (point.echo > kEchoMost) return &PointCounts::bad_echo;
  if (point.status == AlascaStatus::kInvalid) return &PointCounts::invalid;
  if (point.x_code == 0 && point.y_code == 0 && point.z_code == 0) return &PointCounts::no_return;
  return &PointCounts::used;
}

void add_point(Cloud& cloud, const AlascaPoint& point) {
  cloud.x.push_back(static_cast<float>(metres_of_code(point.x_code)));
  cloud.y.push_back(static_cast<float>(metres_of_code(point.y_code)));
  cloud.z.push_back(static_cast<float>(metres_of_code(point.z_code)));
  cloud.ring.push_back(point.layer);
  cloud.echo.push_back(point.echo);
  cloud.flags.push_back(static_cast<std::uint32_t>(point.status));
  cloud.pulse_width.push_back(point.pulse_width);
}

}  // namespace

AlascaModel alasca_xt() {
  AlascaModel model{.name = "alasca_xt",
                    .layer_elevation_rad = {},
                    .rate_hz = 20.0,
                    .range_min_m = 0.3,
                    .range_max_m = 200.0,
                    .step_rad = deg_to_rad(0.25),
                    .side_rad = deg_to_rad(60.0)};
  constexpr double kFieldDeg = 3.2;
  for (int layer = 0; layer < 4; ++layer) {
    model.layer_elevation_rad.push_back(deg_to_rad(kFieldDeg * (layer / 3.0 - 0.5)));
  }
  return model;
}

MessageCloud cloud_of(const AlascaScan& scan, const AlascaModel& model) {
  MessageCloud out;
  out.counts.received = scan.points.size();
  for (const AlascaPoint& point : scan.points) {
    std::uint64_t PointCounts::*const fate = fate_of(point, model);
    ++(out.counts.*fate);
    if (fate == &PointCounts::used) add_point(out.cloud, point);
  }
  return out;
}

}  // namespace verge::sensor::ibeo
