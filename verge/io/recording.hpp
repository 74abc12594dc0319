// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/log.hpp"
#include "verge/io/file/decoded.hpp"

namespace verge::io {

/// Something that was counted while reading.
struct Counter {
  std::string name;
  std::uint64_t count = 0;
};

/// What a recording cannot say of itself, or says of several things at once.
struct RecordingOptions {
  std::optional<std::string> topic{};      ///< Of a bag with several topics of scans.
  std::optional<std::string> sensor_ip{};  ///< Source address, of a capture with several sensors.
  std::optional<std::string>
      model{};  ///< Of the sensor, where the packets do not say it or are not believed.
  std::optional<std::filesystem::path>
      calibration{};  ///< File of the sensor's angles; none: the model's own.
  Log log{};
};

/// A file that holds many scans, one after the other. Memory does not grow with its length.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  virtual ~Recording() = default;

  /// The points of the next scan; none at the end; an Error for a damaged part. After an Error the next call
  /// goes on with what follows the damage, or says that this was the end.
  [[nodiscard]] virtual Expected<std::optional<Decoded>> next() = 0;

  /// What has been read so far: of each kind what was received, then what became of it; the latter add up to
  /// the former.
  [[nodiscard]] virtual std::vector<Counter> counters() const = 0;
};

}  // namespace verge::io
