// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/message_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "tests/faults/counter_sums.hpp"

namespace verge::fuzz {
namespace {

using sensor::ibeo::Frame;
using sensor::ibeo::FrameLayout;
using sensor::ibeo::Framer;
using sensor::ibeo::Skipped;

/// An event of a framer, without its bytes: where it begins and how long it is, and whether it is skipped and
/// why.
struct Event {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  int kind = 0;

  friend bool operator==(const Event&, const Event&) = default;
};

Event event_of(const sensor::ibeo::FramerEvent& event) {
  if (const auto* frame = std::get_if<Frame>(&event)) {
    return {frame->offset, frame->header.size() + frame->body.size(), -1};
  }
  const auto& skipped = std::get<Skipped>(event);
  return {skipped.offset, skipped.bytes, static_cast<int>(skipped.reason)};
}

/// The events of a stream whose pieces are as long as `next_length` says.
template <class NextLength>
std::vector<Event> events_of(Bytes stream, const FrameLayout& layout, NextLength next_length) {
  Framer framer(layout);
  std::vector<Event> events;
  const auto drain = [&] {
    while (const auto event = framer.next()) events.push_back(event_of(*event));
  };
  while (!stream.empty()) {
    const std::size_t length = std::min<std::size_t>(stream.size(), next_length());
    framer.feed(stream.first(length));
    stream = stream.subspan(length);
    drain();
  }
  framer.finish();
  drain();
  const auto& counts = framer.counts();
  require(framer.pending() == 0);
  require(counts.bytes_received ==
          counts.bytes_used + counts.bytes_no_message + counts.bytes_cut + counts.bytes_too_large);
  return events;
}

/// Every byte is in one event, and they are in order.
void check_cover(const std::vector<Event>& events, std::size_t size) {
  std::uint64_t at = 0;
  for (const Event& event : events) {
    require(event.offset == at && event.bytes > 0);
    at += event.bytes;
  }
  require(at == size);
}

void check_points(const Cloud& cloud, std::size_t size) {
  require(cloud.x.size() <= size / 10);
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    require(std::isfinite(cloud.x[i]) && std::isfinite(cloud.y[i]) && std::isfinite(cloud.z[i]));
    require(cloud.ring[i] >= 0 && cloud.ring[i] < 4);
  }
  for (const double time : cloud.time_s) require(std::isfinite(time) && time >= 0.0);
}

}  // namespace

std::string seed_of(const std::vector<std::vector<std::byte>>& parts) {
  std::string seed;
  for (const auto& part : parts) seed.append(reinterpret_cast<const char*>(part.data()), part.size());
  return seed;
}

void check_framing(Bytes stream, const FrameLayout& layout) {
  const auto whole = events_of(stream, layout, [&] { return stream.size(); });
  check_cover(whole, stream.size());
  std::size_t at = 0;
  const auto as_the_bytes_say = [&] {
    return 1 + std::to_integer<std::size_t>(stream[at++ % stream.size()]);
  };
  require(events_of(stream, layout, as_the_bytes_say) == whole);
  require(events_of(stream, layout, [] { return 1U; }) == whole);
}

namespace {

void read_to_its_end(Bytes input, const OpenRecording& open) {
  const std::size_t size = input.size();
  const auto recording = open(io::Input::of(input, "fuzz"));
  if (!recording) {
    require(!recording.error().what.empty());
    return;
  }
  // Every call but the last takes a header's bytes at least, or says what is wrong with the end.
  for (std::size_t calls = 0; calls <= size + 2; ++calls) {
    const auto scan = (*recording)->next();
    if (scan && !*scan) {
      require(faults::add_up((*recording)->counters()));
      return;
    }
    if (scan) check_points((*scan)->cloud, size);
    if (!scan) require(!scan.error().what.empty() && !scan.error().where.empty());
  }
  require(false);
}

}  // namespace

void check_recording(Bytes input, const OpenRecording& open) {
  require(bounded(input, [&] {
    read_to_its_end(input, open);
    return true;
  }));
}

}  // namespace verge::fuzz
