// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/recording_samples.hpp"

#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/file/mcap.hpp"
#include "verge/io/file/rosbag1.hpp"
#include "verge/io/file/rosbag2.hpp"
#include "verge/io/file/test_bags.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace verge::faults {
namespace {

namespace ibeo = sensor::ibeo;
using Stream = std::vector<std::byte>;

constexpr std::size_t kPoints = 3;

/// Puts messages one behind the other; marks where scans end.
class StreamOf {
 public:
  StreamOf& scan(const Stream& message) {
    other(message);
    ends_.push_back(bytes_.size());
    return *this;
  }
  StreamOf& other(const Stream& message) {
    bytes_.append(reinterpret_cast<const char*>(message.data()), message.size());
    return *this;
  }
  [[nodiscard]] RecordingSample named(std::string name, decltype(RecordingSample::open) open) const {
    return {std::move(name), bytes_, open, ends_};
  }

 private:
  std::string bytes_;
  std::vector<std::size_t> ends_;
};

RecordingSample lux() {
  using testing::lux_message;
  return StreamOf()
      .scan(testing::lux_scan_message(kPoints))
      .other(lux_message(ibeo::kHealthType, ibeo::encode_health({.error_1 = 2})))
      .scan(testing::lux_scan_message(kPoints))
      .other(lux_message(ibeo::kObjectsType, ibeo::encode_objects(testing::lux_objects({2, -1}))))
      .other(lux_message(ibeo::kVehicleStateType, ibeo::encode_vehicle_state({.velocity_cm_s = 100})))
      .scan(testing::lux_scan_message(kPoints))
      .named("lux", io::open_ibeo);
}

RecordingSample idc() {
  ibeo::IdcWriter writer;
  StreamOf out;
  for (std::uint64_t i = 0; i < 3; ++i) {
    out.scan(writer.add({.type = ibeo::kScanType, .ntp = testing::kNtp + (i << 28U)},
                        ibeo::encode_scan(testing::lux_scan(kPoints))));
  }
  return out.other(writer.close()).named("idc", io::open_ibeo);
}

RecordingSample alasca() {
  const Stream scan = testing::alasca_scan_message(kPoints);
  return StreamOf()
      .scan(scan)
      .other(ibeo::encode_alasca_message({.type = 1}, Stream(20)))
      .scan(scan)
      .scan(scan)
      .named("alasca", io::open_alasca);
}

}  // namespace

std::vector<RecordingSample> recording_samples() {
  const auto messages = testing::cloud_messages(3);
  const auto ros1 = testing::cloud_messages(3, io::Wire::kRos1);
  return {lux(),
          idc(),
          alasca(),
          {"bag", testing::rosbag1_of(ros1), io::open_rosbag1},
          {"bag_lz4", testing::rosbag1_of(ros1, {.compression = "lz4"}), io::open_rosbag1},
          {"db3", testing::db3_of(messages, {.page_bytes = 512}), io::open_db3},
          {"mcap", testing::mcap_of(messages), io::open_mcap},
          {"mcap_plain", testing::mcap_of(messages, {.messages_per_chunk = 0, .checksums = false}),
           io::open_mcap}};
}

}  // namespace verge::faults
