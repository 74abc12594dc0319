// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::io {

/// How a ROS message stands in bytes.
enum class Wire : std::uint8_t {
  kRos1,  ///< ROS 1: little-endian, one value right behind the other.
  kCdr,  ///< ROS 2: CDR of DDS (OMG DDSI-RTPS 10.2, version 1 of the encoding): a header of 4 bytes names the
         ///< byte order; every number is aligned to its own size, counted from behind that header.
};

/// Reads a message value by value. What does not fit makes a fault that stays: from then on every value is 0
/// or empty, so that a reader of a message asks once, at its end.
class MessageReader {
 public:
  MessageReader(Wire wire, Bytes message);

  template <class T>
  [[nodiscard]] T number() {
    static_assert(std::is_arithmetic_v<T>);
    if (!align(sizeof(T)) || !has(sizeof(T))) return T{};
    const T value = big_endian_ ? load_be<T>(message_, at_) : load_le<T>(message_, at_);
    at_ += sizeof(T);
    return value;
  }
  /// Seconds and nanoseconds (signed seconds in ROS 2) as ns since the Unix epoch.
  [[nodiscard]] std::int64_t time_ns();
  [[nodiscard]] std::string_view text();
  /// Length of a list whose elements take `least_bytes` (>= 1) or more each: a fault where they cannot be in
  /// what is left.
  [[nodiscard]] std::uint32_t count(std::size_t least_bytes);
  [[nodiscard]] Bytes bytes(std::size_t size);

  [[nodiscard]] Wire wire() const { return wire_; }
  [[nodiscard]] std::size_t offset() const { return at_; }
  /// What went wrong first; `where` is the offset in the message, `file` is empty.
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  void fail(std::size_t offset, std::string what, std::string got = {}, std::string need = {});

 private:
  [[nodiscard]] bool align(std::size_t size);
  [[nodiscard]] bool has(std::size_t size);

  Wire wire_;
  Bytes message_;
  bool big_endian_ = false;
  std::size_t at_ = 0;
  std::optional<Error> fault_;
};

/// Writes a message as little-endian CDR.
class CdrWriter {
 public:
  CdrWriter();

  template <class T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    align(sizeof(T));
    append(&value, sizeof(T));
  }
  void text(std::string_view value);
  void bytes(std::string_view value);
  [[nodiscard]] std::string take() && { return std::move(out_); }

 private:
  void align(std::size_t size);
  void append(const void* data, std::size_t size);

  std::string out_;
};

}  // namespace verge::io
