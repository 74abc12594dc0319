// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <numbers>
#include <optional>

#include "verge/core/bytes.hpp"
#include "verge/scan/organise.hpp"
#include "verge/sensor/velodyne/clock.hpp"
#include "verge/sensor/velodyne/facts.hpp"
#include "verge/sensor/velodyne/packet_queue.hpp"
#include "verge/sensor/velodyne/position.hpp"
#include "verge/sensor/velodyne/projector.hpp"
#include "verge/sensor/velodyne/turn_tracker.hpp"

namespace verge::sensor::velodyne {

/// Which firing of a packet its stamp is the time of. Drivers and decoders say the first; the HDL-32E's
/// manual (appendix E) says the last, 542.592 us later.
enum class StampMark : std::uint8_t { kFirst, kLast };

struct DecoderConfig {
  double cut_azimuth_rad = std::numbers::pi;  ///< Where a revolution begins, clockwise from ahead: the rear.
  std::optional<double> range_min_m{};        ///< Nearer returns are left out; none: the model's.
  std::optional<double> range_max_m{};        ///< Farther returns are left out; none: the model's.
  StampMark stamp = StampMark::kFirst;
  std::optional<Model> model{};              ///< None: as the first packet says.
  std::optional<Calibration> calibration{};  ///< None: the model's own angles.
};

/// What one turn of the head saw.
struct Revolution {
  /// x forward, y left, z up; in order of firing; ring 0 = lowest; intensity 0..255; time_s from the first
  /// point; echo (0 = nearer) where the sensor sent two.
  Cloud cloud;
  std::optional<std::int64_t> stamp_ns;  ///< Of the first point; none without points.
  double completeness = 0.0;             ///< Share of the turn whose packets are there, 0..1.
  bool stalled = false;  ///< Ended after 1.25 s, not by its azimuth: the head stands, or turns below 0.8 Hz.
};

/// What became of everything that was added. packets = data + positions + all rejected_*, duplicates and
/// late; blocks = those used + rejected; positions = all nmea_*; stamps = those used + stamps_estimated;
/// PointCounters likewise.
struct Counters {
  std::uint64_t packets = 0;
  std::uint64_t data = 0;            ///< Data packets used.
  std::uint64_t positions = 0;       ///< Position packets.
  std::uint64_t rejected_size = 0;   ///< Neither 1206 nor 512 bytes.
  std::uint64_t rejected_model = 0;  ///< Of another model than the one told, or the first one.
  std::uint64_t duplicates = 0;
  std::uint64_t late = 0;  ///< Arrived after 16 newer ones.

  std::uint64_t blocks = 0;  ///< Of the data packets used.
  std::uint64_t blocks_used = 0;
  std::uint64_t rejected_flag = 0;
  std::uint64_t rejected_azimuth = 0;  ///< Beyond 35999.
  std::uint64_t rejected_turn = 0;     ///< Azimuth where no motor can have turned to.

  PointCounters points;

  std::uint64_t stamps = 0;            ///< Of the data packets used and those late.
  std::uint64_t stamps_estimated = 0;  ///< Stamp of no use; the packet's time is what was expected.

  std::uint64_t nmea_used = 0;         ///< Sentences whose time may decide the hour.
  std::uint64_t nmea_unlocked = 0;     ///< Of a receiver that only guesses.
  std::uint64_t nmea_absent = 0;       ///< Position packets without a sentence.
  std::uint64_t nmea_ignored = 0;      ///< Sentences without a usable time.
  std::uint64_t nmea_rolled_over = 0;  ///< Receiver's date is 1024 weeks old.

  // Flags, not part of a sum.
  std::uint64_t clock_jumps = 0;     ///< The sensor's clock was set.
  std::uint64_t hour_ambiguous = 0;  ///< Host clock half an hour off: the hour may be wrong.
  std::uint64_t hour_disputed = 0;   ///< GPS later said another hour.
  std::uint64_t stalled = 0;         ///< Revolutions that ended by time: the head stands.
};

/// Packets of one Velodyne sensor in, revolutions out: the one decoder of all models.
///
/// Packets that the network swapped (by up to 16 places) are put in order, those sent twice used once. The
/// same bytes in the same order give the same revolutions.
class RevolutionDecoder {
 public:
  /// Throws std::invalid_argument where the calibration does not have the lasers of the model told, or a
  /// number is not finite.
  explicit RevolutionDecoder(DecoderConfig config = {});

  /// One UDP payload (1206 B data or 512 B position; others are counted) as received at that host time, ns
  /// since the Unix epoch. The hour of the sensor's stamps comes from it, or from GPS where locked.
  void add(Bytes payload, std::int64_t received_ns);

  /// A finished revolution, oldest first.
  [[nodiscard]] std::optional<Revolution> take();

  /// At the end: call until there is none. What is left of the last turn comes last.
  [[nodiscard]] std::optional<Revolution> finish();

  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// The model that sends; none before its first packet.
  [[nodiscard]] std::optional<Model> model() const { return model_; }
  /// The newest position packet.
  [[nodiscard]] const std::optional<PositionPacket>& position() const { return position_; }

 private:
  void add_position(Bytes payload, std::int64_t received_ns);
  void add_data(Bytes payload, std::int64_t received_ns);
  [[nodiscard]] bool accept_model(Bytes payload);
  void set_model(Model model);
  [[nodiscard]] std::int64_t time_of(Bytes payload, std::int64_t received_ns);
  void drain();
  void decode(const PacketQueue::Packet& packet);
  void decode_step(const PacketQueue::Packet& packet, const PacketPlan& plan, std::size_t first,
                   std::size_t end);
  [[nodiscard]] bool follow(const PlannedBlock& block, std::int64_t time_ns);
  void begin_revolution(std::int64_t time_ns);
  void end_revolution(bool stalled);

  DecoderConfig config_;
  std::optional<Model> model_;
  const Facts* facts_ = nullptr;
  std::unique_ptr<Projector> projector_;
  StampClock clock_;
  PacketQueue queue_;
  TurnTracker tracker_;
  double turn_per_ns_ = 0.0;  // of the last block
  double mean_turn_per_ns_ = 0.0;
  PointBatch batch_;
  Revolution current_;
  std::int64_t current_begin_ns_ = 0;  // time_s counts from here
  bool current_begun_ = false;
  bool echoes_ = false;            // the cloud has an echo column
  std::size_t points_before_ = 0;  // of the revolution before: room for this one
  std::deque<Revolution> finished_;
  std::optional<PositionPacket> position_;
  Counters counters_;
};

}  // namespace verge::sensor::velodyne
