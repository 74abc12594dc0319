// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/framed_recording.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/core.h>

namespace verge::io {

using sensor::ibeo::Frame;
using sensor::ibeo::FrameLayout;
using sensor::ibeo::FramerCounts;
using sensor::ibeo::FramerEvent;
using sensor::ibeo::Skipped;
using sensor::ibeo::SkipReason;

namespace {

constexpr std::uint64_t kPiece = 64ULL << 10U;

}  // namespace

FramedRecording::FramedRecording(Input input, const FrameLayout& layout)
    : input_(std::move(input)), layout_(layout), framer_(layout) {}

Expected<std::optional<Decoded>> FramedRecording::next() {
  while (true) {
    while (const auto event = framer_.next()) {
      if (const auto* skipped = std::get_if<Skipped>(&*event)) return Unexpected(error_of(*skipped));
      auto decoded = decode(std::get<Frame>(*event));
      if (!decoded || *decoded) return decoded;
    }
    if (ended_) break;
    const auto more = feed();
    if (!more) return Unexpected(more.error());
  }
  if (!std::exchange(checked_, true)) {
    if (auto trouble = check_end()) return Unexpected(*std::move(trouble));
  }
  return std::nullopt;
}

/// The next piece of the file to the framer. A file that cannot be read further has ended.
Expected<void> FramedRecording::feed() {
  const std::uint64_t length = std::min(kPiece, input_.size() - at_);
  const auto piece = length > 0 ? input_.read(at_, length) : Expected<Bytes>(Bytes{});
  if (piece) {
    framer_.feed(*piece);
    at_ += length;
  }
  ended_ = !piece || at_ == input_.size();
  if (ended_) framer_.finish();
  if (!piece) return Unexpected(piece.error());
  return {};
}

Error FramedRecording::error_of(const Skipped& skipped) const {
  const auto error = [&](std::string what, std::string need = {}) {
    return input_.error_at(ErrorCode::kDamaged, skipped.offset, std::move(what),
                           fmt::format("{} B skipped", skipped.bytes), std::move(need));
  };
  switch (skipped.reason) {
    case SkipReason::kNoMessage:
      return error("bytes belong to no message");
    case SkipReason::kCut:
      return error("message is cut short");
    case SkipReason::kTooLarge:
      break;
  }
  return error("message is too large", fmt::format("<= {} B", layout_.body_max_bytes));
}

Error FramedRecording::rejected(Error error) {
  ++rejected_[error.what];
  error.file = input_.name();
  return error;
}

void FramedRecording::add(const sensor::ibeo::PointCounts& points) {
  points_.received += points.received;
  points_.used += points.used;
  points_.no_return += points.no_return;
  points_.bad_layer += points.bad_layer;
  points_.bad_echo += points.bad_echo;
  points_.invalid += points.invalid;
}

std::vector<Counter> FramedRecording::counters() const {
  const FramerCounts& bytes = framer_.counts();
  std::vector<Counter> all{{"bytes received", bytes.bytes_received - framer_.pending()},
                           {"bytes used", bytes.bytes_used},
                           {"bytes that belong to no message", bytes.bytes_no_message},
                           {"bytes of messages cut short", bytes.bytes_cut},
                           {"bytes of messages too large", bytes.bytes_too_large},
                           {"messages received", bytes.messages}};
  for (const auto& [kind, count] : used_) all.push_back({fmt::format("messages used: {}", kind), count});
  all.push_back({"messages of other types", ignored_});
  for (const auto& [why, count] : rejected_)
    all.push_back({fmt::format("messages rejected: {}", why), count});
  all.insert(all.end(), {{"points received", points_.received},
                         {"points used", points_.used},
                         {"points without a return", points_.no_return},
                         {"points of an unknown layer", points_.bad_layer},
                         {"points of an unknown echo", points_.bad_echo},
                         {"points called invalid", points_.invalid}});
  return all;
}

}  // namespace verge::io
