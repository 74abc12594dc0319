// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tests/fuzz/fuzz.hpp"
#include "verge/sensor/velodyne/test_packets.hpp"

namespace verge::fuzz {

namespace velodyne = sensor::velodyne;

std::vector<std::string> seeds() {
  std::vector<std::string> out;
  for (const velodyne::Model model :
       {velodyne::Model::kHdl32e, velodyne::Model::kVlp16, velodyne::Model::kVlp32c,
        velodyne::Model::kHdl64eS1, velodyne::Model::kHdl64eS2}) {
    for (const auto& packet : velodyne::testing::stream({.model = model, .packets = 3})) {
      out.emplace_back(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());
    }
  }
  out.emplace_back(1205, '\0');
  out.emplace_back();
  return out;
}

/// One packet, whatever it is: fields written again are the same bytes, counters add up, points are finite.
void check(Bytes input) {
  if (input.size() == velodyne::kDataBytes) {
    const velodyne::DataBytes again = velodyne::to_bytes(velodyne::parse_packet(input));
    require(std::equal(again.begin(), again.end(), input.begin()));
  }
  velodyne::RevolutionDecoder decoder;
  decoder.add(input, 1'700'000'000'000'000'000);
  while (const auto revolution = decoder.finish()) {
    for (const float x : revolution->cloud.x) require(std::isfinite(x));
    require(revolution->cloud.x.size() <= 384);
  }
  require(velodyne::testing::adds_up(decoder.counters()));
}

}  // namespace verge::fuzz
