// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ros_wire.hpp"

#include <utility>

#include <fmt/core.h>

namespace verge::io {
namespace {

constexpr std::size_t kCdrHeader = 4;

/// What a message of this encoding is called (DDSI-RTPS 2.5, table 10.3).
std::string_view name_of_encoding(unsigned encoding) {
  if (encoding == 2 || encoding == 3) return "is PL_CDR";
  if (encoding >= 6 && encoding <= 11) return "is XCDR2";
  return "has an unknown encoding";
}

}  // namespace

MessageReader::MessageReader(Wire wire, Bytes message) : wire_(wire), message_(message) {
  if (wire == Wire::kRos1) return;
  if (!has(kCdrHeader)) return;
  const auto encoding = load_be<std::uint16_t>(message_, 0);
  if (encoding > 1) {  // 0: CDR big-endian, 1: CDR little-endian; ROS 2 writes no other
    fail(0, fmt::format("message {}, not plain CDR", name_of_encoding(encoding)),
         fmt::format("encoding {}", encoding), "0 or 1");
    return;
  }
  big_endian_ = encoding == 0;
  at_ = kCdrHeader;
}

void MessageReader::fail(std::size_t offset, std::string what, std::string got, std::string need) {
  if (fault_) return;
  fault_ = Error{ErrorCode::kDamaged, {}, fmt::format("{}", offset), std::move(what), std::move(got),
                 std::move(need)};
}

bool MessageReader::has(std::size_t size) {
  const std::size_t left = message_.size() - at_;
  if (!fault_ && size > left)
    fail(at_, "message ends too early", fmt::format("{} B", left), fmt::format(">= {} B", size));
  return !fault_;
}

bool MessageReader::align(std::size_t size) {
  if (fault_) return false;
  if (wire_ == Wire::kRos1) return true;
  const std::size_t gap = (size - (at_ - kCdrHeader) % size) % size;
  if (!has(gap)) return false;
  at_ += gap;
  return true;
}

std::int64_t MessageReader::time_ns() {
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  const std::int64_t seconds =
      wire_ == Wire::kRos1 ? std::int64_t{number<std::uint32_t>()} : std::int64_t{number<std::int32_t>()};
  return seconds * kNanoseconds + number<std::uint32_t>();
}

std::string_view MessageReader::text() {
  const Bytes raw = bytes(count(1));
  std::string_view value(reinterpret_cast<const char*>(raw.data()), raw.size());
  // CDR counts a zero byte at the end in, ROS 1 has none.
  if (wire_ == Wire::kCdr && value.ends_with('\0')) value.remove_suffix(1);
  return value;
}

std::uint32_t MessageReader::count(std::size_t least_bytes) {
  const auto n = number<std::uint32_t>();
  const std::size_t left = message_.size() - at_;
  if (!fault_ && n > left / least_bytes) {
    fail(at_ - sizeof(n), "list is longer than what is left of the message", fmt::format("{}", n),
         fmt::format("<= {}", left / least_bytes));
  }
  return fault_ ? 0 : n;
}

Bytes MessageReader::bytes(std::size_t size) {
  if (!has(size)) return {};
  const Bytes value = message_.subspan(at_, size);
  at_ += size;
  return value;
}

CdrWriter::CdrWriter() : out_("\0\1\0\0", kCdrHeader) {}

void CdrWriter::align(std::size_t size) {
  out_.append((size - (out_.size() - kCdrHeader) % size) % size, '\0');
}

void CdrWriter::append(const void* data, std::size_t size) {
  out_.append(static_cast<const char*>(data), size);  // hosts are little-endian (core/bytes.hpp)
}

void CdrWriter::text(std::string_view value) {
  number(static_cast<std::uint32_t>(value.size() + 1));
  out_.append(value);
  out_.push_back('\0');
}

void CdrWriter::bytes(std::string_view value) {
  number(static_cast<std::uint32_t>(value.size()));
  out_.append(value);
}

}  // namespace verge::io
