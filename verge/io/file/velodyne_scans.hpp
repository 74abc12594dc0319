// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/recording.hpp"
#include "verge/sensor/velodyne/revolutions.hpp"

namespace verge::io {

inline constexpr std::string_view kVelodyneModels = "hdl32e, vlp16, vlp32c, hdl64e, hdl64e-s1, -s2 or -s3";

/// The model with that name. Fails with kUsage; `name` stands in the error.
[[nodiscard]] Expected<sensor::velodyne::Model> velodyne_model(const std::string& model,
                                                               const std::string& name);

/// Of what model the packets at a recording's begin are. One damaged packet, were it the first, must not
/// decide for all others.
class ModelVote {
 public:
  /// A payload; other than data packets, and those of no model of ours, do not count.
  void add(Bytes payload);
  /// The model of the most packets, of equally many the first in the list of models; none without packets.
  [[nodiscard]] std::optional<sensor::velodyne::Model> winner() const;

 private:
  std::map<sensor::velodyne::Model, std::uint64_t> packets_;
};

/// Packets of one Velodyne sensor to scans, whatever kind of recording they stand in.
class VelodyneScans {
 public:
  /// For the options' model, else the one that was `seen`, else that of the first packet; with the options'
  /// calibration, which has to be of that model. Fails with kUsage where there is no such model, or a
  /// calibration without one, and as the calibration's file does; `name` stands in the error.
  [[nodiscard]] static Expected<VelodyneScans> create(
      const RecordingOptions& options, const std::string& name,
      std::optional<sensor::velodyne::Model> seen = std::nullopt);

  /// A payload of 1206 bytes (others are counted) and when it was received, ns since the Unix epoch.
  void add(Bytes payload, std::int64_t received_ns) { decoder_.add(payload, received_ns); }
  /// A complete revolution, oldest first.
  [[nodiscard]] std::optional<Decoded> take();
  /// At the end: what is left, until there is none.
  [[nodiscard]] std::optional<Decoded> finish();
  /// Packets received and what became of them, then the same of blocks and of measurements.
  [[nodiscard]] std::vector<Counter> counters() const;
  [[nodiscard]] const sensor::velodyne::Counters& packets() const { return decoder_.counters(); }

  /// What is wrong with the packets as a whole: none could be decoded (kUnusable), or some are of another
  /// model than the rest and left out (kDamaged). Without file and place, which the recording knows.
  [[nodiscard]] std::optional<Error> fault() const;
  /// What was counted, cost little or nothing, and is still worth a look; see add_oddity().
  [[nodiscard]] std::vector<std::string> oddities() const;

 private:
  explicit VelodyneScans(sensor::velodyne::DecoderConfig config)
      : own_angles_(config.calibration.has_value()), decoder_(std::move(config)) {}
  [[nodiscard]] std::optional<Decoded> decoded(std::optional<sensor::velodyne::Revolution> revolution) const;

  bool own_angles_;
  sensor::velodyne::RevolutionDecoder decoder_;
};

/// Appends "COUNT WHAT" where there is something to count.
void add_oddity(std::vector<std::string>& all, std::uint64_t count, std::string_view what);
/// One warning that names them all; none where there are none.
void warn_of(const std::vector<std::string>& oddities, const std::string& file, const Log& log);

}  // namespace verge::io
