// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/counter_sums.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "verge/io/file/pcap.hpp"
#include "verge/io/file/test_captures.hpp"

namespace verge::fuzz {
namespace {

using testing::frame_of;
using testing::ipv4;
using testing::udp;

std::string fragments() {
  const std::string datagram = udp(testing::sensor_packets(1)[0].payload);
  return testing::pcap_header() +
         testing::pcap_record(frame_of(ipv4(datagram.substr(0, 480), {}, 0x2000)), 0) +
         testing::pcap_record(frame_of(ipv4(datagram.substr(480), {}, 60)), 0);
}

/// A capture, whatever it is, ends after a bounded number of answers, each of its records counted once.
bool read_to_its_end(Bytes input) {
  auto recording = io::open_pcap(io::Input::of(input, "fuzz.pcap"), {});
  if (!recording) return false;
  std::size_t errors = 0;
  while (true) {
    const auto next = (*recording)->next();
    if (next && !*next) break;
    if (!next) require(++errors < 8);
  }
  require(faults::add_up((*recording)->counters()));
  return true;
}

}  // namespace

std::vector<std::string> seeds() {
  const auto packets = testing::sensor_packets(3);
  std::vector<std::string> out;
  for (const std::uint32_t link : {1U, 113U, 276U, 101U, 0U})
    out.push_back(testing::capture_of(packets, {.link_type = link}));
  for (const bool big : {false, true}) {
    out.push_back(testing::capture_of(packets, {.big_endian = big, .nanoseconds = true}));
    std::string blocks = testing::ng_section(big) + testing::ng_interface({}, big);
    for (const auto& packet : packets)
      blocks += testing::ng_packet(frame_of(ipv4(udp(packet.payload))), packet.time_ns, big);
    out.push_back(blocks);
  }
  out.push_back(fragments());
  out.push_back(testing::capture_of(packets, {}, {.options = std::string(8, '\x01')}));
  out.push_back(testing::capture_of(packets, {}, {.port = 8308}));
  return out;
}

void check(Bytes input) {
  static_cast<void>(bounded(input, [&] { return read_to_its_end(input); }));
}

}  // namespace verge::fuzz
