// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "tests/fuzz/fuzz.hpp"
#include "verge/sensor/velodyne/packet.hpp"
#include "verge/sensor/velodyne/position.hpp"

namespace verge::fuzz {

namespace velodyne = sensor::velodyne;

std::vector<std::string> seeds() {
  const std::string sentence = "$GPRMC,214106,A,3707.8178,N,12139.2690,W,010.3,188.2,230715,013.8,E,D*05\r\n";
  return {sentence, sentence + sentence, "$GNRMC,235960.5,V,,,,,,,311299,,*00", "$GPRMC,*",
          std::string(206, '\0') + sentence};
}

/// The input as text, and as a packet.
void check(Bytes input) {
  const std::string text(reinterpret_cast<const char*>(input.data()), input.size());
  const velodyne::NmeaReading reading = velodyne::read_nmea(text);
  constexpr std::int64_t k1980 = 315'532'800'000'000'000;
  constexpr std::int64_t k2080 = 3'471'379'200'000'000'000;
  if (reading.fault == velodyne::NmeaFault::kNone)
    require(reading.utc_ns >= k1980 && reading.utc_ns <= k2080);
  std::array<std::byte, velodyne::kPositionBytes> packet{};
  std::copy_n(input.begin(), std::min(input.size(), packet.size()), packet.begin());
  require(velodyne::parse_position(packet).sentence.size() <= 306);
}

}  // namespace verge::fuzz
