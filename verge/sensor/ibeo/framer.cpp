// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/framer.hpp"

#include <algorithm>
#include <cassert>

namespace verge::sensor::ibeo {
namespace {

/// Where the magic, or as much of it as fits, first stands at or behind `from`; bytes.size() if nowhere.
std::size_t find_magic(Bytes bytes, const FrameLayout& layout, std::size_t from) {
  for (std::size_t at = from; at < bytes.size(); ++at) {
    const auto* found = std::find(bytes.data() + at, bytes.data() + bytes.size(), layout.magic[0]);
    at = static_cast<std::size_t>(found - bytes.data());
    const std::size_t length = std::min(layout.magic.size(), bytes.size() - at);
    if (std::equal(found, found + length, layout.magic.begin())) return at;
  }
  return bytes.size();
}

}  // namespace

Framer::Framer(const FrameLayout& layout, Confirm confirm) : layout_(layout), confirm_(confirm) {}

void Framer::feed(Bytes piece) {
  assert(!finished_);
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(cursor_));
  cursor_ = 0;
  buffer_.insert(buffer_.end(), piece.begin(), piece.end());
  counts_.bytes_received += piece.size();
}

void Framer::finish() { finished_ = true; }

std::optional<FramerEvent> Framer::next() {
  while (true) {
    const Verdict verdict = judge();
    if (verdict.kind == Kind::kWait) {
      if (!finished_ || run_.bytes == 0) return std::nullopt;
      return take_run();
    }
    if (verdict.kind == Kind::kFrame) {
      if (auto run = take_run()) return run;
      return take_frame(verdict.bytes);
    }
    if (auto run = skip(verdict.bytes)) return run;
  }
}

/// What to do with the bytes at the cursor.
Framer::Verdict Framer::judge() {
  const Bytes bytes = left();
  if (bytes.empty()) return {};
  const std::size_t magic = find_magic(bytes, layout_, 0);
  if (magic > 0) return {Kind::kSkip, magic};
  return judge_message();
}

/// The bytes at the cursor begin with the magic, or with as much of it as is there.
Framer::Verdict Framer::judge_message() {
  const Bytes bytes = left();
  const auto too_few = [&] { return finished_ ? reject(SkipReason::kCut) : Verdict{}; };
  if (bytes.size() < layout_.header_bytes) return too_few();
  const auto body = load_be<std::uint32_t>(bytes, layout_.size_offset);
  if (body > layout_.body_max_bytes) return reject(SkipReason::kTooLarge);
  const std::size_t end = layout_.header_bytes + body;
  if (bytes.size() < end) return too_few();
  if (confirm_ == Confirm::kByNext) {
    if (!finished_ && bytes.size() < end + layout_.magic.size()) return {};
    if (is_cut_short(end)) return reject(SkipReason::kCut);
  }
  return {Kind::kFrame, end};
}

/// Whether the message at the cursor, which would end at `end`, lost bytes: no magic follows it but one
/// begins inside, or whole messages inside fill it up to the end.
bool Framer::is_cut_short(std::size_t end) const {
  const Bytes near = left().first(std::min(left().size(), end + layout_.magic.size()));
  const std::size_t inside = find_magic(near, layout_, 1);
  if (inside >= end || inside + layout_.magic.size() > near.size()) return false;
  const bool followed = near.size() == end || find_magic(near, layout_, end) == end;
  return !followed || messages_fill(inside, end);
}

/// Whether whole messages stand one behind the other from `at` to `end`.
bool Framer::messages_fill(std::size_t at, std::size_t end) const {
  const Bytes bytes = left();
  while (at < end && end - at >= layout_.header_bytes) {
    if (find_magic(bytes.subspan(at, layout_.magic.size()), layout_, 0) != 0) return false;
    at += layout_.header_bytes + load_be<std::uint32_t>(bytes, at + layout_.size_offset);
  }
  return at == end;
}

Framer::Verdict Framer::reject(SkipReason reason) {
  reason_ = reason;
  return {Kind::kSkip, 1};
}

/// Skips; the run before it where that was for another reason.
std::optional<Skipped> Framer::skip(std::size_t bytes) {
  std::optional<Skipped> done;
  if (run_.bytes > 0 && run_.reason != reason_) done = take_run();
  if (run_.bytes == 0) run_ = {stream_at_, 0, reason_};
  run_.bytes += bytes;
  cursor_ += bytes;
  stream_at_ += bytes;
  return done;
}

std::optional<Skipped> Framer::take_run() {
  if (run_.bytes == 0) return std::nullopt;
  const Skipped run = run_;
  run_ = {};
  (run.reason == SkipReason::kNoMessage ? counts_.bytes_no_message
   : run.reason == SkipReason::kCut     ? counts_.bytes_cut
                                        : counts_.bytes_too_large) += run.bytes;
  return run;
}

Frame Framer::take_frame(std::size_t bytes) {
  const Bytes whole = left().first(bytes);
  const Frame frame{stream_at_, whole.first(layout_.header_bytes), whole.subspan(layout_.header_bytes)};
  cursor_ += bytes;
  stream_at_ += bytes;
  reason_ = SkipReason::kNoMessage;
  counts_.bytes_used += bytes;
  ++counts_.messages;
  return frame;
}

}  // namespace verge::sensor::ibeo
