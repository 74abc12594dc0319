// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
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

/// The calibration in a file. Fails as the file does, and as read_calibration().
[[nodiscard]] Expected<sensor::velodyne::Calibration> read_calibration_file(const std::filesystem::path& path,
                                                                            std::size_t lasers);

/// Packets of one Velodyne sensor to scans, whatever kind of recording they stand in.
class VelodyneScans {
 public:
  /// With the options' model (or that of the first packet) and calibration, which has to be of a model: the
  /// options', or the one that was `seen`. Fails with kUsage where there is no such model, or a calibration
  /// without one, and as the calibration's file does; `name` stands in the error.
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

 private:
  explicit VelodyneScans(sensor::velodyne::DecoderConfig config)
      : own_angles_(config.calibration.has_value()), decoder_(std::move(config)) {}
  [[nodiscard]] std::optional<Decoded> decoded(std::optional<sensor::velodyne::Revolution> revolution) const;

  bool own_angles_;
  sensor::velodyne::RevolutionDecoder decoder_;
};

}  // namespace verge::io
