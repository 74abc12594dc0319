// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "verge/core/atomic_file.hpp"
#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// A capture (pcap or pcapng) of one Velodyne sensor's packets: data to UDP port 2368, positions to 8308.
/// Each revolution is a scan; its points are in the sensor's frame with times, rings and intensities.
///
/// Fails with kUsage where two sensors send and options.sensor_ip does not choose one (both are listed), the
/// model is unknown, or the calibration is of another one; kUnusable where it is not a capture or holds no
/// data packet (the error says what it saw: other ports, position packets alone, cut packets). A damaged or
/// cut record ends the recording: the scans before it come first, then one kDamaged; so does a datagram of
/// which a fragment is missing, at the end. A second sensor that speaks up only after 20 000 records is left
/// out, counted and noted.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_pcap(Input input, const RecordingOptions& options);

/// Writes captures: Ethernet, IPv4, UDP with its checksum, microseconds; the same packets give the same
/// bytes.
class PcapWriter {
 public:
  /// From where to where the packets go.
  struct Route {
    std::uint32_t source_ip = 0xC0A801C9;       ///< 192.168.1.201, as the sensors come.
    std::uint32_t destination_ip = 0xFFFFFFFF;  ///< Broadcast.
    std::uint16_t port = 2368;                  ///< Of both.
  };

  /// Writes the file header. Fails with kCannotWrite.
  [[nodiscard]] static Expected<PcapWriter> create(AtomicFile file);

  /// One datagram (at most 65 507 bytes), captured at that time. Fails with kCannotWrite.
  [[nodiscard]] Expected<void> write(Bytes payload, std::int64_t time_ns, const Route& route);
  [[nodiscard]] Expected<void> write(Bytes payload, std::int64_t time_ns) {
    return write(payload, time_ns, Route{});
  }

  /// Call once, at the end.
  [[nodiscard]] Expected<void> commit() { return file_.commit(); }

  /// The bytes of the file header and of one record, as write() appends them.
  [[nodiscard]] static std::string file_header();
  [[nodiscard]] static std::string record(Bytes payload, std::int64_t time_ns, const Route& route);

 private:
  explicit PcapWriter(AtomicFile file) : file_(std::move(file)) {}
  AtomicFile file_;
};

}  // namespace verge::io
