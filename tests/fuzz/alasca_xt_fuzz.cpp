// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/message_stream.hpp"
#include "verge/io/file/alasca_stream.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"

namespace verge::fuzz {

namespace ibeo = sensor::ibeo;

std::vector<std::string> seeds() {
  using namespace verge::testing;
  std::vector<std::string> seeds;
  for (const std::size_t points : {0U, 1U, 5U, 100U}) seeds.push_back(seed_of({alasca_scan_message(points)}));
  const auto scan = alasca_scan_message(5);
  const auto other = ibeo::encode_alasca_message({.type = 1}, std::vector<std::byte>(40));
  const std::vector<std::byte> cut(scan.begin(), scan.begin() + 50);
  seeds.push_back(seed_of({scan, other, scan}));
  seeds.push_back(seed_of({cut, scan, cut, other, cut}));
  seeds.push_back(seed_of({scan, patched(scan, 4, std::uint32_t{0x7195'0100}), scan}));
  seeds.push_back(seed_of({scan, patched(scan, 16 + 14, std::uint16_t{0xFFFF}), scan}));
  return seeds;
}

void check(Bytes input) {
  check_framing(input, ibeo::kAlascaFrames);
  check_recording(input, [](io::Input file) { return io::open_alasca(std::move(file), {}); });
}

}  // namespace verge::fuzz
