// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/message_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace verge::fuzz {

namespace ibeo = sensor::ibeo;

std::vector<std::string> seeds() {
  using namespace verge::testing;
  std::vector<std::string> seeds;
  for (const std::size_t points : {0U, 1U, 4U, 30U}) seeds.push_back(seed_of({lux_scan_message(points)}));
  for (const std::vector<int>& contours : {std::vector<int>{}, {0}, {-1}, {3, -1, 2}}) {
    seeds.push_back(seed_of({lux_message(ibeo::kObjectsType, ibeo::encode_objects(lux_objects(contours)))}));
  }
  const auto health =
      lux_message(ibeo::kHealthType, ibeo::encode_health({.error_1 = 0x0102, .warning_1 = 0x10}));
  const auto vehicle =
      lux_message(ibeo::kVehicleStateType, ibeo::encode_vehicle_state({.velocity_cm_s = 100}));
  const auto scan = lux_scan_message(5);
  const std::vector<std::byte> cut(scan.begin(), scan.begin() + 50);
  seeds.push_back(seed_of({health, scan, vehicle, scan}));
  seeds.push_back(seed_of({cut, scan, cut, health}));
  seeds.push_back(seed_of({scan, patched(scan, 8, std::uint32_t{0xFFFFFF7F}), scan}));
  seeds.push_back(seed_of({scan, patched(scan, 24 + 28, std::uint16_t{65535}), scan}));
  seeds.push_back(seed_of({scan, patched(scan, 24 + 22, std::uint16_t{0}), lux_message(0x2403, scan)}));
  return seeds;
}

void check(Bytes input) {
  check_framing(input, ibeo::kLuxFrames);
  check_recording(input, [](io::Input file) { return io::open_ibeo(std::move(file), {}); });
}

}  // namespace verge::fuzz
