// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "verge/io/file/test_captures.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

// Valid captures that the bad ones are made of, and where their pieces stand.

namespace verge::faults {

constexpr std::size_t kCaptureHeader = 24;
constexpr std::size_t kRecordHeader = 16;
constexpr std::size_t kHeaders = 14 + 20 + 8;  ///< Ethernet, IPv4 and UDP before a payload.
constexpr std::size_t kRecord = kRecordHeader + kHeaders + sensor::velodyne::kDataBytes;
constexpr std::size_t kPackets = 60;        ///< A third of a revolution.
constexpr std::size_t kPacketPoints = 384;  ///< All measurements of a packet return.
constexpr std::size_t kAllPoints = kPackets * kPacketPoints;

/// Where record `number` begins in a capture of data packets alone.
[[nodiscard]] constexpr std::size_t record_at(std::size_t number) {
  return kCaptureHeader + number * kRecord;
}

using Packets = std::vector<testing::SensorPacket>;

/// Packets of a sensor as sensor/velodyne makes them for its tests; sent at their capture's time.
[[nodiscard]] Packets packets_of(const sensor::velodyne::testing::StreamPlan& plan);
/// kPackets of an HDL-32E.
[[nodiscard]] Packets packets();

/// `packet` changed field by field.
void change(testing::SensorPacket& packet,
            const std::function<void(sensor::velodyne::RawPacket&)>& to_something_else);

/// One record of a capture: the payload in UDP in IPv4 in Ethernet.
[[nodiscard]] std::string record_of(const testing::SensorPacket& packet, const testing::UdpPlan& plan = {});
/// A capture of `frame_of_packet` of each packet.
[[nodiscard]] std::string capture_with(const Packets& all,
                                       const std::function<std::string(const std::string&)>& frame_of_payload,
                                       const testing::CapturePlan& plan = {});

}  // namespace verge::faults
