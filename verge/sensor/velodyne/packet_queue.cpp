// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/packet_queue.hpp"

#include <algorithm>
#include <cstring>

namespace verge::sensor::velodyne {
namespace {

std::uint64_t tail_of(Bytes payload) {
  return load_le<std::uint32_t>(payload, kDataBytes - 6) +
         (static_cast<std::uint64_t>(load_le<std::uint16_t>(payload, kDataBytes - 2)) << 32U);
}

}  // namespace

bool PacketQueue::seen(Bytes payload) const {
  const std::uint64_t tail = tail_of(payload);
  for (std::size_t slot = 0; slot < filled_; ++slot) {
    if (tails_[slot] != tail) continue;
    if (std::memcmp(slots_[slot].bytes.data(), payload.data(), kDataBytes) == 0) return true;
  }
  return false;
}

bool PacketQueue::push(std::int64_t time_ns, Bytes payload) {
  // What still waits is not overwritten.
  while (std::find(waiting_.begin(), waiting_.end(), next_) != waiting_.end()) next_ = (next_ + 1) % kSlots;
  const std::size_t slot = next_;
  next_ = (next_ + 1) % kSlots;
  filled_ = std::max(filled_, slot + 1);
  slots_[slot].time_ns = time_ns;
  std::memcpy(slots_[slot].bytes.data(), payload.data(), kDataBytes);
  tails_[slot] = tail_of(payload);
  if (handed_out_ns_ && time_ns < *handed_out_ns_) return false;
  auto place = waiting_.end();
  while (place != waiting_.begin() && slots_[*(place - 1)].time_ns > time_ns) --place;
  waiting_.insert(place, slot);
  return true;
}

const PacketQueue::Packet* PacketQueue::pop() { return waiting_.size() <= kHeld ? nullptr : drain(); }

const PacketQueue::Packet* PacketQueue::drain() {
  if (waiting_.empty()) return nullptr;
  const Packet& oldest = slots_[waiting_.front()];
  waiting_.erase(waiting_.begin());
  handed_out_ns_ = oldest.time_ns;
  return &oldest;
}

void PacketQueue::restart() { handed_out_ns_.reset(); }

}  // namespace verge::sensor::velodyne
