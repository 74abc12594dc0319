// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/objects2221.hpp"

#include <cassert>
#include <utility>

#include "verge/core/byte_writer.hpp"
#include "verge/sensor/ibeo/damaged.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr std::size_t kListHeaderBytes = 10;
constexpr std::size_t kObjectBytes = 58;
constexpr std::size_t kContourPointBytes = 4;
constexpr std::size_t kContourCountOffset = 56;

template <class T>
Pair<T> load_pair(Bytes bytes, std::size_t offset) {
  return {load_le<T>(bytes, offset), load_le<T>(bytes, offset + sizeof(T))};
}

template <class T>
void write(ByteWriter& out, const Pair<T>& pair) {
  out.le(pair.x).le(pair.y);
}

LuxObject decode_object(Bytes bytes) {
  LuxObject object;
  object.id = load_le<std::uint16_t>(bytes, 0);
  object.age = load_le<std::uint16_t>(bytes, 2);
  object.prediction_age = load_le<std::uint16_t>(bytes, 4);
  object.relative_time = load_le<std::uint16_t>(bytes, 6);
  object.reference_point = load_pair<std::int16_t>(bytes, 8);
  object.reference_point_sigma = load_pair<std::uint16_t>(bytes, 12);
  object.closest_point = load_pair<std::int16_t>(bytes, 16);
  object.bounding_box_centre = load_pair<std::int16_t>(bytes, 20);
  object.bounding_box_width = load_le<std::uint16_t>(bytes, 24);
  object.bounding_box_length = load_le<std::uint16_t>(bytes, 26);
  object.box_centre = load_pair<std::int16_t>(bytes, 28);
  object.box_size = load_pair<std::uint16_t>(bytes, 32);
  object.box_orientation_ticks = load_le<std::int16_t>(bytes, 36);
  object.absolute_velocity = load_pair<std::int16_t>(bytes, 38);
  object.velocity_sigma = load_pair<std::uint16_t>(bytes, 42);
  object.relative_velocity = load_pair<std::int16_t>(bytes, 46);
  object.kind = ObjectClass{load_le<std::uint16_t>(bytes, 50)};
  object.class_age = load_le<std::uint16_t>(bytes, 52);
  object.class_certainty = load_le<std::uint16_t>(bytes, 54);
  return object;
}

void encode_object(ByteWriter& out, const LuxObject& object) {
  out.le(object.id).le(object.age).le(object.prediction_age).le(object.relative_time);
  write(out, object.reference_point);
  write(out, object.reference_point_sigma);
  write(out, object.closest_point);
  write(out, object.bounding_box_centre);
  out.le(object.bounding_box_width).le(object.bounding_box_length);
  write(out, object.box_centre);
  write(out, object.box_size);
  out.le(object.box_orientation_ticks);
  write(out, object.absolute_velocity);
  write(out, object.velocity_sigma);
  write(out, object.relative_velocity);
  out.le(static_cast<std::uint16_t>(object.kind)).le(object.class_age).le(object.class_certainty);
  assert(object.contour.size() < kContourUnknown);
  const auto count = static_cast<std::uint16_t>(object.contour.size());
  out.le(object.contour_unknown ? kContourUnknown : count);
  for (const auto& point : object.contour) write(out, point);
}

/// The objects, where a count of 0xFFFF stands for `unknown` points.
Expected<LuxObjects> decode_with(Bytes body, std::uint64_t at, std::size_t unknown) {
  LuxObjects list{load_le<std::uint64_t>(body, 0), {}};
  const auto count = load_le<std::uint16_t>(body, 8);
  std::size_t offset = kListHeaderBytes;
  for (std::size_t i = 0; i < count; ++i) {
    if (body.size() - offset < kObjectBytes) return damaged(at + offset, "list of objects ends in an object");
    LuxObject object = decode_object(body.subspan(offset, kObjectBytes));
    const auto said = load_le<std::uint16_t>(body, offset + kContourCountOffset);
    object.contour_unknown = said == kContourUnknown;
    const std::size_t points = object.contour_unknown ? unknown : said;
    offset += kObjectBytes;
    if ((body.size() - offset) / kContourPointBytes < points) {
      return damaged(at + offset - 2, "contour of an object is longer than the list",
                     fmt::format("{}", points),
                     fmt::format("<= {}", (body.size() - offset) / kContourPointBytes));
    }
    for (std::size_t k = 0; k < points; ++k, offset += kContourPointBytes) {
      object.contour.push_back(load_pair<std::int16_t>(body, offset));
    }
    list.objects.push_back(std::move(object));
  }
  if (offset != body.size()) {
    return damaged(at + offset, "list of objects is shorter than its message", fmt::format("{} B", offset),
                   fmt::format("{} B", body.size()));
  }
  return list;
}

}  // namespace

Expected<LuxObjects> decode_objects(Bytes body, std::uint64_t at) {
  if (body.size() < kListHeaderBytes) {
    return damaged(at, "list of objects is shorter than its header", fmt::format("{} B", body.size()),
                   ">= 10 B");
  }
  const std::size_t most = (body.size() - kListHeaderBytes) / kObjectBytes;
  if (load_le<std::uint16_t>(body, 8) > most) {
    return damaged(at + 8, "list of objects has more than its size allows",
                   fmt::format("{}", load_le<std::uint16_t>(body, 8)), fmt::format("<= {}", most));
  }
  auto without = decode_with(body, at, 0);
  if (without) return without;
  auto with_one = decode_with(body, at, 1);
  return with_one ? std::move(with_one) : std::move(without);
}

std::vector<std::byte> encode_objects(const LuxObjects& objects) {
  assert(objects.objects.size() <= 65535);
  ByteWriter out;
  out.le(objects.scan_start_ntp).le(static_cast<std::uint16_t>(objects.objects.size()));
  for (const LuxObject& object : objects.objects) encode_object(out, object);
  return std::move(out).take();
}

}  // namespace verge::sensor::ibeo
