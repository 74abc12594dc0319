// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bag_format.hpp"
#include "verge/io/file/point_cloud2.hpp"
#include "verge/io/file/ros_messages.hpp"
#include "verge/scan/organise.hpp"

namespace verge::fuzz {
namespace {

constexpr std::uint64_t kMostPoints = 1U << 20U;

/// What can be decoded is a scan, and what is written of a scan is read and written again byte for byte.
void check_cloud(io::Wire wire, Bytes message) {
  const auto cloud = io::read_point_cloud2(wire, message);
  if (!cloud || cloud->points() > kMostPoints) return;
  auto decoded = io::decode_point_cloud2(*cloud);
  if (!decoded) return;
  require(decoded->cloud.x.size() == cloud->points());
  Scan scan = organise(std::move(decoded->cloud)).scan;
  if (scan.size() == 0 || scan.ring_count() > (1U << 16U)) return;
  const std::string written = io::write_point_cloud2(scan);
  const auto back = io::read_point_cloud2(io::Wire::kCdr, bytes_of(written));
  require(back.has_value() && back->points() == scan.size());
  auto again = io::decode_point_cloud2(*back);
  require(again.has_value());
  const Cloud sent = flatten(scan);  // messages keep the input's order
  require(again->cloud.x == sent.x && again->cloud.y == sent.y && again->cloud.z == sent.z);
}

/// Two rows of three points without a ring, and bytes behind each row.
testing::CloudParts padded_grid() {
  testing::CloudParts parts;
  parts.height = 2;
  parts.width = 3;
  parts.fields = {{"x", 0}, {"y", 4}, {"z", 8}};
  parts.point_step = 12;
  parts.row_step = 3 * parts.point_step + 8;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column)
      parts.data += testing::le(5.0F + static_cast<float>(row)) + testing::le(static_cast<float>(column)) +
                    testing::le(-1.5F);
    parts.data.append(8, '\0');
  }
  return parts;
}

}  // namespace

/// The first byte says the wire, the rest is the message.
std::vector<std::string> seeds() {
  std::vector<std::string> out;
  for (const io::Wire wire : {io::Wire::kRos1, io::Wire::kCdr}) {
    const std::string first(1, static_cast<char>(wire));
    for (const auto& message : seed_messages(wire)) out.push_back(first + message.data);
    for (const auto& message : velodyne_messages(wire)) out.push_back(first + message.data);
  }
  testing::CloudParts parts = testing::simple_cloud(4);
  parts.big_endian = true;
  out.push_back("\1" + testing::cloud_message(parts, io::Wire::kCdr, true));
  out.push_back("\1" + testing::cloud_message(padded_grid(), io::Wire::kCdr));
  return out;
}

void check(Bytes input) {
  if (input.empty()) return;
  const io::Wire wire = (input[0] & std::byte{1}) == std::byte{0} ? io::Wire::kRos1 : io::Wire::kCdr;
  const Bytes message = input.subspan(1);
  check_cloud(wire, message);
  const auto transforms = io::read_transforms(wire, message);
  require(!transforms || 64 * transforms->size() <= message.size() + 64);
  const auto packets = io::read_velodyne_scan(wire, message);
  require(!packets || 1214 * packets->packets.size() <= message.size());
  static_cast<void>(io::read_odometry(wire, message));
}

}  // namespace verge::fuzz
