// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Decodes a recording of an ibeo scanner and prints what is in it as numbers of this machine, for
// tests/oracle/ibeo_decoder.py to compare with its own.
//
//     ibeo_columns lux|alasca|messages FILE
//
// messages: of each message its fields in the order of docs/formats_ibeo.md, int64 each (uint64 as the same
// bits), and before them 'M' and their number (uint32); 'E' and nothing more for one that is damaged.
//
// lux, alasca: a scan is 'S', stamp (0 or 1, int64 ns), number of points and of times (uint32), then x, y, z
// (float32), ring (int64), echo (uint8), flags (uint32), pulse width (float32), time (float64), column by
// column. A part that is damaged: 'E'.
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/objects2221.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace {

using namespace verge;

template <class T>
void print(const T& value) {
  std::fwrite(&value, sizeof(T), 1, stdout);
}

template <class T>
void print(const std::vector<T>& column) {
  if (!column.empty()) std::fwrite(column.data(), sizeof(T), column.size(), stdout);
}

void print_scan(const io::Decoded& scan) {
  const Cloud& cloud = scan.cloud;
  print('S');
  print(static_cast<std::uint8_t>(scan.stamp_ns ? 1 : 0));
  print(scan.stamp_ns.value_or(0));
  print(static_cast<std::uint32_t>(cloud.x.size()));
  print(static_cast<std::uint32_t>(cloud.time_s.size()));
  print(cloud.x);
  print(cloud.y);
  print(cloud.z);
  print(cloud.ring);
  print(cloud.echo);
  print(cloud.flags);
  print(cloud.pulse_width);
  print(cloud.time_s);
}

using Fields = std::vector<std::int64_t>;

/// Appends the values.
template <class... T>
void add(Fields& fields, T... values) {
  (fields.push_back(static_cast<std::int64_t>(values)), ...);
}

template <class T>
void add(Fields& fields, const sensor::ibeo::Pair<T>& pair) {
  add(fields, pair.x, pair.y);
}

Fields fields_of(const sensor::ibeo::LuxObjects& list) {
  Fields out;
  add(out, list.scan_start_ntp, list.objects.size());
  for (const auto& o : list.objects) {
    add(out, o.id, o.age, o.prediction_age, o.relative_time);
    add(out, o.reference_point);
    add(out, o.reference_point_sigma);
    add(out, o.closest_point);
    add(out, o.bounding_box_centre);
    add(out, o.bounding_box_width, o.bounding_box_length);
    add(out, o.box_centre);
    add(out, o.box_size);
    add(out, o.box_orientation_ticks);
    add(out, o.absolute_velocity);
    add(out, o.velocity_sigma);
    add(out, o.relative_velocity);
    add(out, o.kind, o.class_age, o.class_certainty, o.contour.size());
    for (const auto& point : o.contour) add(out, point);
  }
  return out;
}

Fields fields_of(const sensor::ibeo::LuxHealth& h) {
  Fields out;
  add(out, h.error_1, h.error_2, h.warning_1, h.warning_2);
  for (const std::uint16_t value : h.reserved) add(out, value);
  return out;
}

Fields fields_of(const sensor::ibeo::VehicleState& v) {
  Fields out;
  add(out, v.ntp, v.scan_number, v.error_flags, v.velocity_cm_s, v.steering_wheel_mrad);
  add(out, v.front_wheel_1e4_rad, v.reserved_1, v.x_cm, v.y_cm, v.course_1e4_rad, v.time_difference_ms);
  add(out, v.x_difference_mm, v.y_difference_mm, v.heading_difference_1e4_rad, v.reserved_2);
  add(out, v.yaw_rate_1e4_rad_s, v.reserved_3);
  return out;
}

Fields fields_of(const sensor::ibeo::FrameIndex& index) {
  Fields out;
  add(out, index.major, index.minor, index.name.size());
  for (const char c : index.name) add(out, static_cast<unsigned char>(c));
  add(out, index.entries.size(), index.time_offset_ms, index.trigger_in_new_frame, index.triggers.size());
  for (const auto& trigger : index.triggers) add(out, trigger.type, trigger.device);
  for (const auto& entry : index.entries) add(out, entry.file_offset, entry.time_offset_ms, entry.device);
  return out;
}

template <class T>
void print_message(const Expected<T>& decoded) {
  if (!decoded) return print('E');
  const Fields fields = fields_of(*decoded);
  print('M');
  print(static_cast<std::uint32_t>(fields.size()));
  print(fields);
}

void print_message(const sensor::ibeo::Frame& frame) {
  using namespace sensor::ibeo;
  switch (decode_header(frame.header).type) {
    case kObjectsType:
      return print_message(decode_objects(frame.body));
    case kHealthType:
      return print_message(decode_health(frame.body));
    case kVehicleStateType:
      return print_message(decode_vehicle_state(frame.body));
    case kIdcIndexType:
      return print_message(decode_frame_index(frame.body, frame.offset + kHeaderBytes));
    default:
      break;
  }
}

/// Every byte is in a message that nobody cut: a run that is skipped is a difference too.
int print_messages(io::Input input) {
  const auto bytes = input.head(input.size());
  if (!bytes) return 1;
  sensor::ibeo::Framer framer(sensor::ibeo::kLuxFrames);
  framer.feed(*bytes);
  framer.finish();
  while (const auto event = framer.next()) {
    const auto* frame = std::get_if<sensor::ibeo::Frame>(&*event);
    if (frame == nullptr) return 1;
    print_message(*frame);
  }
  return 0;
}

int fail(const Error& error) {
  std::fprintf(stderr, "%s\n", to_string(error).c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  auto input = io::Input::open(argv[2], {});
  if (!input) return fail(input.error());
  if (std::string_view(argv[1]) == "messages") return print_messages(std::move(*input));
  const bool lux = std::string_view(argv[1]) == "lux";
  auto recording = lux ? io::open_ibeo(std::move(*input)) : io::open_alasca(std::move(*input));
  if (!recording) return fail(recording.error());
  while (true) {
    const auto scan = (*recording)->next();
    if (scan && !*scan) return 0;
    if (scan) {
      print_scan(**scan);
    } else {
      print('E');
    }
  }
}
