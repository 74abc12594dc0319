// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/packet_queue.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace verge::sensor::velodyne {
namespace {

constexpr std::size_t kTail = 6;  // stamp, mode, product: differs first between packets

bool equal(const DataBytes& a, Bytes b) {
  const std::size_t tail = kDataBytes - kTail;
  return std::memcmp(a.data() + tail, b.data() + tail, kTail) == 0 &&
         std::memcmp(a.data(), b.data(), tail) == 0;
}

DataBytes copy_of(Bytes payload) {
  DataBytes bytes;
  std::memcpy(bytes.data(), payload.data(), kDataBytes);
  return bytes;
}

}  // namespace

bool PacketQueue::seen(Bytes payload) const {
  return std::any_of(newest_.rbegin(), newest_.rend(),
                     [&](const DataBytes& packet) { return equal(packet, payload); });
}

bool PacketQueue::push(std::int64_t time_ns, Bytes payload) {
  newest_.push_back(copy_of(payload));
  if (newest_.size() > 2 * kHeld) newest_.pop_front();
  if (handed_out_ns_ && time_ns < *handed_out_ns_) return false;
  auto place = waiting_.end();
  while (place != waiting_.begin() && std::prev(place)->time_ns > time_ns) --place;
  waiting_.insert(place, {time_ns, newest_.back()});
  return true;
}

std::optional<PacketQueue::Packet> PacketQueue::pop() {
  if (waiting_.size() <= kHeld) return std::nullopt;
  return drain();
}

std::optional<PacketQueue::Packet> PacketQueue::drain() {
  if (waiting_.empty()) return std::nullopt;
  Packet oldest = waiting_.front();
  waiting_.pop_front();
  handed_out_ns_ = oldest.time_ns;
  return oldest;
}

void PacketQueue::restart() { handed_out_ns_.reset(); }

}  // namespace verge::sensor::velodyne
