// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/bev_objects.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "verge/emit/bev_theme.hpp"
#include "verge/model/footprint.hpp"

namespace verge::emit {
namespace {

std::vector<Vec2> outline_of(const BevView& view, const Object& object) {
  std::vector<Vec3> corners;
  for (const Vec2 p : footprint(object)) corners.push_back({p.x, p.y, 0.0});
  return view.line(corners);
}

void draw_sign(Canvas& canvas, const BevView& view, const Object& object) {
  constexpr double kSmall_m = 1.0;  // the letters would hide it
  if (!object.shape || object.size.length_m < kSmall_m) return;
  const TextStyle style{view.px(20.0), kText, true, Align::kCentre, kGround};
  canvas.text(view.at(object.center.xy()) + Vec2{0.0, view.px(7.0)}, name_of(*object.shape), style);
}

}  // namespace

Colour class_colour(ObjectClass type) {
  switch (type) {
    case ObjectClass::kCar:
    case ObjectClass::kVan:
    case ObjectClass::kTruck:
      return rgb(0x5DE0A0);
    case ObjectClass::kPerson:
    case ObjectClass::kCyclist:
      return rgb(0xFF4D6D);
    case ObjectClass::kPole:
    case ObjectClass::kRoadside:
      return rgb(0xC9B458);
    case ObjectClass::kUnknown:
      break;
  }
  return rgb(0x9AA7B4);
}

void draw_objects(Canvas& canvas, const BevView& view, const Scene& scene, Legend& legend) {
  std::array<std::size_t, enum_names<ObjectClass>.size()> count{};
  for (const Object& object : scene.objects) {
    ++count.at(static_cast<std::size_t>(object.type));
    if (!view.shows(view.at(object.center.xy()))) continue;
    const Colour colour = class_colour(object.type);
    canvas.polygon(outline_of(view, object), colour.faded(0.25), {view.px(3.0), colour, {}});
    draw_sign(canvas, view, object);
  }
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (count.at(i) == 0) continue;
    const auto type = static_cast<ObjectClass>(i);
    legend.push_back(
        {LegendSign::kLine, class_colour(type), fmt::format("{} ({})", name_of(type), count.at(i))});
  }
}

void draw_true_objects(Canvas& canvas, const BevView& view, const Scene& truth, Legend& legend) {
  for (const Object& object : truth.objects) {
    if (!view.shows(view.at(object.center.xy()))) continue;
    const Colour colour = object.confidence > 0.0 ? kTruth : kTruth.faded(0.3);
    canvas.polygon(outline_of(view, object), kTruth.faded(0.0),
                   {view.px(1.5), colour, {view.px(6.0), view.px(6.0)}});
  }
  if (!truth.objects.empty()) legend.push_back({LegendSign::kDashedLine, kTruth, "true objects"});
}

}  // namespace verge::emit
