// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/box_score.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "verge/detect/line_fit/layer_points.hpp"

namespace verge::study {
namespace {

constexpr double kRange_m = 50.0;

bool is_in(const Object& box, Vec3 p) {
  const Vec3 from_center = p - box.center;
  const Vec2 heading{std::cos(box.yaw_rad), std::sin(box.yaw_rad)};
  return std::fabs(dot(heading, from_center.xy())) <= 0.5 * box.size.length_m &&
         std::fabs(cross(heading, from_center.xy())) <= 0.5 * box.size.width_m &&
         std::fabs(from_center.z) <= 0.5 * box.size.height_m;
}

bool is_boxed(ObjectClass type) {
  return type != ObjectClass::kPole && type != ObjectClass::kRoadside && type != ObjectClass::kUnknown;
}

bool is_paired(const Object& object, const Scene& truth) {
  Scene alone;
  alone.objects = {object};
  return eval::score_objects(alone, truth, kRange_m).matched > 0;
}

}  // namespace

std::vector<std::size_t> returns_in(const std::vector<Object>& boxes, const Scan& scan) {
  assert(scan.mount);
  std::vector<std::size_t> returns(boxes.size());
  const LevelFrame frame(*scan.mount);
  for (const auto& hit : detect::line_fit::layer_points(scan, frame, *scan.mount, {})) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      returns[i] += is_in(boxes[i], scan.point(hit.index)) ? 1U : 0U;
  }
  return returns;
}

Scene boxed_truth(std::vector<Object> boxes, const Scan& scan) {
  constexpr std::size_t kSeen = 3;
  const auto returns = returns_in(boxes, scan);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].confidence = returns[i] >= kSeen ? 1.0 : 0.0;
  Scene truth;
  truth.frame = scan.frame;
  truth.objects = std::move(boxes);
  return truth;
}

eval::ObjectScore score_boxes(const Scene& prediction, const Scene& truth) {
  Scene compared;
  for (const Object& object : prediction.objects) {
    if (is_boxed(object.type) || is_paired(object, truth)) compared.objects.push_back(object);
  }
  return eval::score_objects(compared, truth, kRange_m);
}

}  // namespace verge::study
