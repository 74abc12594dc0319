// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// What our decoders make of packets on standard input, each by itself, for velodyne_decoder.py on standard
// output.
//
//   velodyne_columns MODEL [CALIBRATION]   data packets of 1206 bytes: one Shot a point
//   velodyne_columns position              position packets of 512 bytes: one Fix a packet
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "verge/sensor/velodyne/calibration.hpp"
#include "verge/sensor/velodyne/packet.hpp"
#include "verge/sensor/velodyne/position.hpp"
#include "verge/sensor/velodyne/projector.hpp"

namespace {

namespace velodyne = verge::sensor::velodyne;

struct Shot {
  std::uint32_t packet, ring, distance, intensity, echo;
  float x, y, z;
  double azimuth, time_us;  // hundredths of a degree; of the hour
};

struct Fix {
  double gyro_rad_s[3], temperature_c[3], acceleration_x_mps2[3], acceleration_y_mps2[3];
  std::int64_t utc_ns;
  std::uint32_t stamp_us, pps, fault, locked;
};

template <class Record>
void write(const Record& record) {
  static_cast<void>(std::fwrite(&record, sizeof record, 1, stdout));
}

/// Data packets of a model to points, whatever their range.
class Points {
 public:
  Points(const velodyne::Facts& facts, const velodyne::Calibration& calibration)
      : facts_(facts), projector_(facts, calibration, 0.0, std::numeric_limits<float>::max()) {}

  /// False where points and measurements do not go together.
  [[nodiscard]] bool write_packet(const velodyne::DataBytes& bytes, std::uint32_t number) {
    const velodyne::PacketPlan plan = velodyne::plan_packet(bytes, facts_, 0.0);
    const velodyne::RawPacket packet = velodyne::parse_packet(bytes);
    const std::size_t apart = facts_.banks_share_step ? 2 : 1;
    for (std::size_t b = 0; b < velodyne::kBlocksPerPacket; ++b) {
      if (!plan.blocks[b].usable) continue;
      const std::size_t other = plan.blocks[b].echo == 0 ? b + apart : b - apart;
      const bool paired = plan.dual && plan.blocks[other].usable;
      projector_.add(bytes, b, plan.blocks[b], 0.0, paired ? &other : nullptr, batch_, counters_);
      if (!write_block(packet, plan, b, paired ? &other : nullptr, number)) return false;
    }
    return true;
  }

 private:
  bool write_block(const velodyne::RawPacket& packet, const velodyne::PacketPlan& plan, std::size_t b,
                   const std::size_t* other, std::uint32_t number) {
    const velodyne::PlannedBlock& block = plan.blocks[b];
    std::size_t i = 0;
    for (std::size_t slot = 0; slot < velodyne::kSlotsPerBlock; ++slot) {
      const std::uint16_t distance = packet.blocks[b].distance[slot];
      const bool again =
          other != nullptr && block.echo == 1 && packet.blocks[*other].distance[slot] == distance;
      if (distance == 0 || again) continue;
      const std::int32_t slot_ns = facts_.slot_time_ns[slot];
      write(Shot{number, static_cast<std::uint32_t>(batch_.ring[i]), distance,
                 static_cast<std::uint32_t>(batch_.intensity[i]), batch_.echo[i], batch_.x[i], batch_.y[i],
                 batch_.z[i], block.azimuth + block.turn_per_ns * slot_ns,
                 packet.stamp_us + 1e-3 * (block.step * facts_.step_ns + slot_ns)});
      ++i;
    }
    const bool all = i == batch_.size;
    batch_.size = 0;
    return all;
  }

  const velodyne::Facts& facts_;
  velodyne::Projector projector_;
  velodyne::PointBatch batch_;
  velodyne::PointCounters counters_;
};

std::optional<velodyne::Calibration> calibration_of(const velodyne::Facts& facts, const char* file) {
  if (file == nullptr) return facts.calibration;
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  const std::string content = text.str();
  const auto read = velodyne::read_calibration(std::as_bytes(std::span(content.data(), content.size())), file,
                                               facts.lasers);
  if (!read) {
    static_cast<void>(std::fprintf(stderr, "%s\n", to_string(read.error()).c_str()));
    return std::nullopt;
  }
  return *read;
}

int write_points(velodyne::Model model, const char* calibration_file) {
  const velodyne::Facts& facts = velodyne::facts_of(model);
  const auto calibration = calibration_of(facts, calibration_file);
  if (!calibration) return 1;
  Points points(facts, *calibration);
  velodyne::DataBytes bytes{};
  for (std::uint32_t number = 0; std::fread(bytes.data(), bytes.size(), 1, stdin) == 1; ++number) {
    if (!points.write_packet(bytes, number)) return 1;
  }
  return std::ferror(stdout) == 0 ? 0 : 1;
}

int write_fixes() {
  std::array<std::byte, velodyne::kPositionBytes> bytes{};
  while (std::fread(bytes.data(), bytes.size(), 1, stdin) == 1) {
    const velodyne::PositionPacket packet = velodyne::parse_position(bytes);
    Fix fix{};
    for (std::size_t unit = 0; unit < packet.inertial.size(); ++unit) {
      fix.gyro_rad_s[unit] = packet.inertial[unit].gyro_rad_s;
      fix.temperature_c[unit] = packet.inertial[unit].temperature_c;
      fix.acceleration_x_mps2[unit] = packet.inertial[unit].acceleration_x_mps2;
      fix.acceleration_y_mps2[unit] = packet.inertial[unit].acceleration_y_mps2;
    }
    fix.utc_ns = packet.nmea.utc_ns;
    fix.stamp_us = packet.stamp_us;
    fix.pps = static_cast<std::uint32_t>(packet.pps);
    fix.fault = static_cast<std::uint32_t>(packet.nmea.fault);
    fix.locked = packet.nmea.locked ? 1 : 0;
    write(fix);
  }
  return std::ferror(stdout) == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  if (what == "position") return write_fixes();
  const auto model = velodyne::model_named(what);
  return model ? write_points(*model, argc > 2 ? argv[2] : nullptr) : 2;
}
