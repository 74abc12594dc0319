// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Valid captures cut at every byte, with every bit of the headers flipped, with every header word at its
// extremes: nothing crashes, memory stays bounded, errors say a place inside the file, and the counters add
// up.
#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/faults/capture_samples.hpp"
#include "tests/faults/counter_sums.hpp"
#include "tests/faults/memory_meter.hpp"
#include "verge/io/file/pcap.hpp"

namespace verge::faults {
namespace {

using testing::frame_of;
using testing::ipv4;
using testing::udp;
using testing::UdpPlan;

constexpr std::size_t kDataPackets = 2;

struct CaptureSample {
  std::string name;
  std::string bytes;
  std::vector<std::size_t> words;  ///< Where words of the headers stand that are not those of a frame.
  std::vector<bool> payload;       ///< Of each byte: whether it is of a packet, not of a header.

  /// Appends a record or block with a frame, whose payload begins `headers` bytes behind its begin.
  void append(const std::string& record, std::size_t word_count, std::size_t headers) {
    for (std::size_t word = 0; word < word_count; ++word) words.push_back(bytes.size() + 4 * word);
    payload.resize(bytes.size() + std::min(headers, record.size()), false);
    bytes += record;
    payload.resize(bytes.size(), true);
  }
};

std::string position_frame() {
  const UdpPlan plan{.port = 8308};
  return frame_of(ipv4(udp(std::string(512, '\0'), plan), plan));
}

/// Two data packets and a position packet of each format.
CaptureSample pcap_sample() {
  CaptureSample sample{"Pcap", testing::pcap_header(), {0, 4, 8, 12, 16, 20}, {}};
  const auto append = [&](const std::string& frame, std::int64_t time_ns) {
    sample.append(testing::pcap_record(frame, time_ns), 4, kRecordHeader + kHeaders);
  };
  for (const testing::SensorPacket& packet : packets_of({.packets = kDataPackets}))
    append(frame_of(ipv4(udp(packet.payload))), packet.time_ns);
  append(position_frame(), 1'700'000'000'000'000'000);
  return sample;
}

CaptureSample pcapng_sample() {
  CaptureSample sample{"Pcapng", "", {}, {}};
  const auto append = [&](const std::string& block) {
    constexpr std::size_t kBlockHeader = 28;
    sample.append(block, 7, kBlockHeader + kHeaders);
    sample.words.push_back(sample.bytes.size() - 4);
  };
  append(testing::ng_section());
  append(
      testing::ng_interface(testing::u16(9, false) + testing::u16(1, false) + std::string("\x06\0\0\0", 4)));
  for (const testing::SensorPacket& packet : packets_of({.packets = kDataPackets}))
    append(testing::ng_packet(frame_of(ipv4(udp(packet.payload))), packet.time_ns));
  append(testing::ng_packet(position_frame(), 1'700'000'000'000'000'000));
  return sample;
}

void expect_inside(const Error& error, std::size_t size, const std::string& what) {
  std::size_t offset = 0;
  const auto [end, fault] =
      std::from_chars(error.where.data(), error.where.data() + error.where.size(), offset);
  EXPECT_TRUE(fault == std::errc{} && *end == '\0' && offset <= size) << what << ": " << to_string(error);
}

/// Reads what somebody did to a capture, and says how many points came out.
std::size_t read_handled(const std::string& bytes, const std::string& what) {
  const MemoryMeter meter;
  auto recording =
      io::open_pcap(io::Input::of(std::as_bytes(std::span(bytes.data(), bytes.size())), "a.pcap"), {});
  if (!recording) {
    expect_inside(recording.error(), bytes.size(), what);
    return 0;
  }
  std::size_t points = 0;
  std::size_t errors = 0;
  while (true) {
    const auto scan = (*recording)->next();
    if (scan && !*scan) break;
    if (scan) points += (*scan)->cloud.x.size();
    if (!scan) expect_inside(scan.error(), bytes.size(), what);
    if (!scan && ++errors > 3) break;
  }
  EXPECT_LE(errors, 3U) << what;
  EXPECT_TRUE(add_up((*recording)->counters())) << what;
  EXPECT_LE(meter.peak(), (16U << 20U) + 64 * bytes.size()) << what;
  return points;
}

class CaptureCorruption : public ::testing::TestWithParam<CaptureSample> {};

TEST_P(CaptureCorruption, TheSampleIsValid) {
  EXPECT_EQ(read_handled(GetParam().bytes, "whole"), kDataPackets * kPacketPoints);
}

TEST_P(CaptureCorruption, CutAtEveryByteItGivesThePacketsBefore) {
  const std::string& bytes = GetParam().bytes;
  std::size_t before = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::size_t points = read_handled(bytes.substr(0, size), "cut at " + std::to_string(size));
    EXPECT_EQ(points % kPacketPoints, 0U) << size;
    EXPECT_GE(points, before) << size;
    before = points;
  }
  EXPECT_EQ(before, kDataPackets * kPacketPoints);
}

// Of a packet's bytes each has one of its bits flipped: they lie in a format of their own, which the fuzz
// target hdl_packet and section V of the catalogue are about.
TEST_P(CaptureCorruption, EveryBitOfTheHeadersFlipped) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    const bool payload = GetParam().payload[at];
    const unsigned only = at % 8;
    for (unsigned bit = payload ? only : 0; bit <= (payload ? only : 7); ++bit) {
      std::string flipped = bytes;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ (1U << bit));
      read_handled(flipped, "bit " + std::to_string(bit) + " of byte " + std::to_string(at));
    }
  }
}

TEST_P(CaptureCorruption, EveryHeaderWordAtItsExtremes) {
  for (const std::size_t at : GetParam().words) {
    for (const std::uint32_t extreme :
         {0U, 1U, 4U, 8U, 12U, 0x7FU, 0x80U, 0xFFFFU, 0x10000U, 0x3FFFFU, 0x40000U, 0x40001U, 0xFFFFFFU,
          0x1000000U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFCU, 0xFFFFFFFEU, 0xFFFFFFFFU}) {
      for (const bool big : {false, true}) {
        std::string bytes = GetParam().bytes;
        bytes.replace(at, 4, testing::u32(extreme, big));
        read_handled(bytes, "word " + std::to_string(at) + " is " + std::to_string(extreme));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Captures, CaptureCorruption, ::testing::Values(pcap_sample(), pcapng_sample()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace verge::faults
