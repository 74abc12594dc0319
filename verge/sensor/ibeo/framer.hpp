// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "verge/core/bytes.hpp"

namespace verge::sensor::ibeo {

/// How the messages of a protocol are told from each other: a header that begins with a magic and says how
/// many bytes of body follow it. There is no checksum.
struct FrameLayout {
  std::array<std::byte, 4> magic{};
  std::size_t header_bytes = 0;      ///< With the magic.
  std::size_t size_offset = 0;       ///< Of the body's size in the header, uint32 big-endian.
  std::uint32_t body_max_bytes = 0;  ///< A header that promises more is none.
};

/// One message. The bytes are the framer's and last until the next feed().
struct Frame {
  std::uint64_t offset = 0;  ///< Of its header in the stream.
  Bytes header{};
  Bytes body{};
};

/// Why bytes were skipped.
enum class SkipReason : std::uint8_t {
  kNoMessage,  ///< They stand between messages.
  kCut,        ///< A header, and what follows it up to the next message: the stream ends, or the next message
               ///< begins, before its body is complete.
  kTooLarge,   ///< A header that promises more than body_max_bytes, and what follows it.
};

/// A run of bytes that belong to no message.
struct Skipped {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  SkipReason reason = SkipReason::kNoMessage;
};

using FramerEvent = std::variant<Skipped, Frame>;

/// bytes_received = bytes_used + the three skipped + what is still pending.
struct FramerCounts {
  std::uint64_t bytes_received = 0;
  std::uint64_t bytes_used = 0;
  std::uint64_t bytes_no_message = 0;
  std::uint64_t bytes_cut = 0;
  std::uint64_t bytes_too_large = 0;
  std::uint64_t messages = 0;
};

/// When a message whose bytes are all there is handed out.
enum class Confirm : std::uint8_t {
  kByNext,  ///< When the four bytes behind it are there too (or the stream has ended): recordings.
  kAtOnce,  ///< At once: a live sensor, where nobody wants to wait a scan for the next magic.
};

/// Cuts a stream of bytes into messages, however it comes in pieces: the events depend on the bytes alone.
///
/// The magic is searched at every byte. With Confirm::kByNext a message that is not followed by a magic, but
/// has one inside, was cut short (a recorder that reconnects appends to what it has): it is skipped up to
/// that magic, so that a cut loses the cut message alone. A message that is not followed by a magic and has
/// none inside stands: what follows it is skipped. Without a checksum, a body whose bytes were replaced by as
/// many others cannot be told from a good one.
///
/// Memory: one message of the greatest size, and one piece.
class Framer {
 public:
  explicit Framer(const FrameLayout& layout, Confirm confirm = Confirm::kByNext);

  /// The next piece of the stream, behind those before. Call next() until it has no more, then feed again.
  void feed(Bytes piece);
  /// The stream has ended; next() hands out what is left.
  void finish();
  /// The next message or run of skipped bytes; none when it takes more bytes to tell. Skipped runs come in
  /// their place between the messages.
  [[nodiscard]] std::optional<FramerEvent> next();

  [[nodiscard]] const FramerCounts& counts() const { return counts_; }
  /// Bytes received that are not in an event yet.
  [[nodiscard]] std::uint64_t pending() const { return (buffer_.size() - cursor_) + run_.bytes; }

 private:
  enum class Kind : std::uint8_t { kWait, kSkip, kFrame };
  struct Verdict {
    Kind kind = Kind::kWait;
    std::size_t bytes = 0;
  };

  [[nodiscard]] Bytes left() const { return Bytes(buffer_).subspan(cursor_); }
  [[nodiscard]] Verdict judge();
  [[nodiscard]] Verdict judge_message();
  [[nodiscard]] Verdict reject(SkipReason reason);
  [[nodiscard]] bool is_cut_short(std::size_t end) const;
  [[nodiscard]] bool messages_fill(std::size_t at, std::size_t end) const;
  [[nodiscard]] std::optional<Skipped> skip(std::size_t bytes);
  [[nodiscard]] std::optional<Skipped> take_run();
  [[nodiscard]] Frame take_frame(std::size_t bytes);

  FrameLayout layout_;
  Confirm confirm_;
  std::vector<std::byte> buffer_;
  std::size_t cursor_ = 0;       // in buffer_: what is before it has been handed out
  std::uint64_t stream_at_ = 0;  // of the cursor in the stream
  SkipReason reason_ = SkipReason::kNoMessage;
  Skipped run_{};
  bool finished_ = false;
  FramerCounts counts_;
};

}  // namespace verge::sensor::ibeo
