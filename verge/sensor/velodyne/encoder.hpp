// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "verge/scan/organise.hpp"
#include "verge/sensor/velodyne/head_azimuths.hpp"
#include "verge/sensor/velodyne/packet.hpp"
#include "verge/sensor/velodyne/packet_grid.hpp"

namespace verge::sensor::velodyne {

/// A data packet ready to be sent.
struct SentPacket {
  DataBytes bytes{};
  std::int64_t time_ns = 0;  ///< Of its first firing, since the Unix epoch: when it is recorded.
};

/// How the head turned while a cloud was seen.
struct Turning {
  std::int64_t begin_ns = 0;       ///< Time of the first step (Facts::step_ns), since the Unix epoch.
  double begin_azimuth_rad = 0.0;  ///< Of the head at that time, clockwise from ahead.
  double rate_hz = 10.0;           ///< Revolutions a second.
};

/// What became of the points of clouds that were encoded; the last three add up to the first.
struct EncodedPoints {
  std::uint64_t points = 0;
  std::uint64_t encoded = 0;
  std::uint64_t not_on_wire =
      0;  ///< No such ring or time, not finite, or nearer or farther than the wire can say.
  std::uint64_t displaced = 0;  ///< A nearer point, or two echoes, have its place.
};

/// Packets of a sensor out of clouds: the decoder's inverse, to the steps of the wire (range_step_m of range,
/// a hundredth of a degree of azimuth, whole intensities).
///
/// A cloud with echoes makes packets of dual return: of two points of a shot the one that comes first in the
/// cloud stands in the block of the last return, as decoding hands them out, the other in that of the
/// strongest; a single point stands in both. Without echoes the nearer point of a shot has its place.
class Encoder {
 public:
  /// With the calibration, else the model's own. Throws std::invalid_argument where it does not have the
  /// lasers of the model.
  explicit Encoder(Model model, const std::optional<Calibration>& calibration = std::nullopt);

  /// The points of one revolution that begins at `turning.begin_ns`, and must not begin before what was added
  /// before ended; `cloud.ring` (0 = lowest) and `cloud.time_s` (after `stamp_ns`) say which shot a point is
  /// of, and each step's azimuth is that of the head at its time. A cloud without them encodes nothing. Steps
  /// from the last revolution's last one to this one's first one follow each other without a gap if
  /// `begin_ns` lies whole steps later; all steps are sent, also those without returns.
  void add(const Cloud& cloud, std::int64_t stamp_ns, const Turning& turning, std::int64_t end_ns);

  /// The points of a cloud as the decoder hands it out, where nothing more is known: packets, their stamps
  /// and the azimuths of their steps are found from the points, so that a cloud that was decoded gives a
  /// cloud of the same bits again. Packets without any return are not sent. Points of a time before that of
  /// the newest packet have no place.
  void add(const Cloud& cloud, std::int64_t stamp_ns);

  /// The packets that are full.
  [[nodiscard]] std::vector<SentPacket> take();
  /// The last one too, its empty blocks filled by steps without returns.
  [[nodiscard]] std::vector<SentPacket> finish();

  [[nodiscard]] const EncodedPoints& counters() const { return counters_; }

 private:
  static constexpr std::size_t kMostSlots = 2 * kSlotsPerBlock;  // of both banks
  struct Return {
    std::uint16_t count = 0;  // 0: none
    std::uint8_t intensity = 0;
    bool farther = false;  // its echo says that something nearer was seen
  };
  /// What was measured in one step, slot by slot.
  struct Step {
    std::optional<double> azimuth;    // where it is known
    std::optional<std::size_t> bank;  // of its returns; where both share a step, of the last one
    std::array<std::array<Return, 2>, kMostSlots> returns{};  // slot by slot, of both echoes
    std::vector<HeadSample> samples;
  };
  /// A packet that is filled.
  struct OpenPacket {
    std::int64_t begin_ns = 0;
    bool dual = false;
    std::size_t used = 0;  // steps
    std::vector<Step> steps;
  };
  /// A point on its way to its slot.
  struct Shot {
    std::int64_t firing_ns = 0;  // time of its firing
    std::size_t laser = 0;
    Return measured;
    double azimuth = 0.0;
    std::int64_t packet_ns = 0;           // time of its packet
    std::int64_t step_ns = 0;             // time of its step
    std::optional<std::size_t> firing{};  // of its step; none: no place for it
    bool second = false;                  // stands behind others of its step: in the block of the other echo
  };

  [[nodiscard]] std::size_t steps_per_packet(bool dual) const;
  [[nodiscard]] std::optional<Shot> shot_of(const Cloud& cloud, std::size_t i, std::int64_t stamp_ns) const;
  [[nodiscard]] std::vector<Shot> shots_of(const Cloud& cloud, std::int64_t stamp_ns);
  void find_steps(std::vector<Shot>& shots, bool dual);
  void put(Step& step, const Shot& shot, bool dual);
  void open(std::int64_t begin_ns, bool dual);
  void append(Step step, std::int64_t time_ns, bool dual);
  void close();
  [[nodiscard]] std::vector<std::uint16_t> azimuths_of(const OpenPacket& packet);
  [[nodiscard]] Return missing_echo(const Return& other, bool is_second, const LaserCorrection& laser) const;
  [[nodiscard]] static std::size_t lower_step(const OpenPacket& packet);
  void fill_step(RawPacket& packet, std::size_t number, const Step& step, std::uint16_t azimuth,
                 std::size_t lower) const;

  const Facts& facts_;
  Calibration calibration_;
  std::vector<std::size_t> laser_of_ring_;
  std::optional<OpenPacket> open_;
  std::optional<PacketGrid> grid_;
  bool grid_dual_ = false;
  double step_turn_;           // hundredths of a degree, as far as it is known
  double last_azimuth_ = 0.0;  // of the last step sent
  std::vector<SentPacket> full_;
  EncodedPoints counters_;
};

}  // namespace verge::sensor::velodyne
