// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/recorder.hpp"

namespace verge::detect::gradient {

Trace::Points& Recorder::points_named(const char* name) {
  for (Trace::Points& layer : trace_->points) {
    if (layer.name == name) return layer;
  }
  return trace_->points.emplace_back(Trace::Points{name, {}, {}});
}

Trace::Values& Recorder::values_named(const char* name) {
  for (Trace::Values& values : trace_->values) {
    if (values.name == name) return values;
  }
  return trace_->values.emplace_back(Trace::Values{name, {}});
}

void Recorder::add(Trace::Points& layer, Vec3 p_level, int group) {
  layer.points.push_back(frame_.to_sensor(p_level));
  layer.group.push_back(group);
}

void Recorder::low(const std::vector<LowRing>& rings) {
  if (trace_ == nullptr) return;
  Trace::Points& gate = points_named("low");
  for (const LowRing& ring : rings) {
    for (const Vec3 p : ring.points) add(gate, p, static_cast<int>(ring.ring));
  }
}

void Recorder::scan_lines(const std::vector<ScanLine>& lines) {
  if (trace_ == nullptr) return;
  for (const ScanLine& line : lines) {
    Trace::Points& gradient = points_named("gradient points");
    for (const std::size_t index : line.points.index)
      add(gradient, line.layer.points[index], static_cast<int>(line.layer.region));
    values_named("K").values.push_back(static_cast<double>(line.clusters.K));
  }
}

void Recorder::candidates(const std::vector<ScanLine>& lines) {
  if (trace_ == nullptr) return;
  Trace::Points& layer = points_named("candidates");
  for (const Quadrant region : kQuadrants) {
    for (const Candidate& c : candidates_in(lines, region)) add(layer, c.foot, static_cast<int>(region));
  }
}

void Recorder::strands(const std::vector<Strand>& strands) {
  if (trace_ == nullptr) return;
  Trace::Points& layer = points_named("clusters");
  for (std::size_t k = 0; k < strands.size(); ++k) {
    for (const Candidate& c : strands[k].points) add(layer, c.foot, static_cast<int>(k));
  }
}

void Recorder::fitted(const std::vector<Fitted>& fitted) {
  if (trace_ == nullptr) return;
  Trace::Points& keys = points_named("key points");
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    Trace::Line fit{"fit", {}};
    for (const Vec3 p : fitted[k].boundary.points) fit.points.push_back(frame_.to_sensor(p));
    trace_->lines.push_back(std::move(fit));
    const double z = fitted[k].boundary.points.empty() ? 0.0 : fitted[k].boundary.points.front().z;
    for (const Vec2 q : fitted[k].curve.key_points) add(keys, {q.x, q.y, z}, static_cast<int>(k));
  }
  for (const Fitted& f : fitted) spline(f);
}

void Recorder::spline(const Fitted& fitted) {
  const Curve& curve = fitted.curve;
  if (curve.model != Model::kSpline) return;
  Trace::Values control{"P", {}};  // x and y by turns, level frame
  for (const Vec2 p : curve.control_points) control.values.insert(control.values.end(), {p.x, p.y});
  trace_->values.push_back(std::move(control));
  trace_->values.push_back({"s", curve.s});
  trace_->values.push_back({"kappa", curve.kappa});
  trace_->values.push_back({"key s", curve.key_s});
  trace_->values.push_back({"u", curve.u});
  trace_->values.push_back({"U", curve.U});
}

}  // namespace verge::detect::gradient
