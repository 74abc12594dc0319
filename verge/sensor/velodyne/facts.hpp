// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/sensor/beam_model.hpp"

namespace verge::sensor::velodyne {

/// Sensors whose packets we read. The three series of the HDL-64E differ in timing and status bytes.
enum class Model : std::uint8_t { kHdl32e, kVlp16, kVlp32c, kHdl64eS1, kHdl64eS2, kHdl64eS3 };

}  // namespace verge::sensor::velodyne

namespace verge {
template <>
inline constexpr std::array enum_names<sensor::velodyne::Model> =
    std::to_array<std::string_view>({"hdl32e", "vlp16", "vlp32c", "hdl64e-s1", "hdl64e-s2", "hdl64e-s3"});
}  // namespace verge

namespace verge::sensor::velodyne {

/// Distance correction of a laser at short range (HDL-64E S2 and S3): the correction goes linearly from these
/// at the near points to LaserCorrection::distance_m at 25.04 m.
struct NearCorrection {
  double side_m = 0.0;   ///< At 2.40 m to the side (Velodyne's x).
  double ahead_m = 0.0;  ///< At 1.93 m ahead (Velodyne's y).
};

/// Where one laser points, and what is added to its distances.
struct LaserCorrection {
  double elevation_rad = 0.0;  ///< Above the plane in which the head turns.
  double azimuth_rad = 0.0;    ///< Clockwise, from the head's azimuth to the laser's.
  double distance_m = 0.0;     ///< Added to every distance.
  double up_m = 0.0;           ///< Height of the beam's origin.
  double left_m = 0.0;         ///< Beam's origin to the left of its own direction.
  std::optional<NearCorrection> near{};
};

/// One correction a laser, by laser number.
using Calibration = std::vector<LaserCorrection>;

constexpr std::size_t kSlotsPerBlock = 32;  ///< Measurements in a block of a packet.
constexpr std::size_t kBlocksPerPacket = 12;
constexpr std::int32_t kTurn = 36'000;  ///< A revolution in hundredths of a degree, as on the wire.

/// What the one decoder needs to know of a model.
///
/// A packet's blocks are grouped in steps: blocks that were measured at the same time (the two banks of an
/// HDL-64E, the two echoes of a dual return). Slot s of a block is laser s % lasers_per_firing of its bank.
struct Facts {
  Model model = Model::kHdl32e;
  std::optional<std::uint8_t> product{};  ///< Last byte of a data packet; none where it is a status byte.
  std::size_t lasers = kSlotsPerBlock;
  std::size_t lasers_per_firing = kSlotsPerBlock;  ///< 16 where a block holds two firings.
  std::size_t banks = 1;          ///< 2: block flag EEFF holds lasers 0..31, DDFF lasers 32..63.
  bool banks_share_step = false;  ///< Both banks are measured at the same time.
  bool has_clock = true;          ///< The packet's stamp is microseconds of the hour.
  std::array<std::int32_t, kSlotsPerBlock> slot_time_ns{};  ///< After the start of the step.
  std::int32_t step_ns = 0;                                 ///< From one step to the next.
  double range_step_m = 0.002;                              ///< A count of the distance.
  double range_min_m = 0.9;                                 ///< Nearer returns come from the housing.
  double range_max_m = 100.0;                               ///< The sensor's reach.
  Calibration calibration{};  ///< Of the model; an HDL-64E's own differs (read_calibration()).
};

/// The facts of a model, with their sources in its own file and in docs/formats_velodyne.md.
[[nodiscard]] const Facts& facts_of(Model model);

/// The models' own files.
[[nodiscard]] Facts hdl32e_facts();
[[nodiscard]] Facts vlp16_facts();
[[nodiscard]] Facts vlp32c_facts();
[[nodiscard]] Facts hdl64e_facts(Model series);

/// The model with that name ("hdl32e", "hdl64e" for its series S2, ...); none where there is none.
[[nodiscard]] std::optional<Model> model_named(std::string_view name);

/// For each laser its ring: 0 is the lowest elevation.
[[nodiscard]] std::vector<std::int64_t> rings_of(const Calibration& calibration);

/// The same facts for the simulator: the shots of one firing, in the order in which they are sent, at 10
/// revolutions a second.
[[nodiscard]] BeamModel beam_model(const Facts& facts);

}  // namespace verge::sensor::velodyne
