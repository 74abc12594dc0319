// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "verge/core/bytes.hpp"

namespace verge {

/// Puts numbers behind each other as bytes: the counterpart of load_le() and load_be().
class ByteWriter {
 public:
  /// Little-endian.
  template <class T>
  ByteWriter& le(T value) {
    static_assert(std::endian::native == std::endian::little, "big-endian hosts need a byte swap here");
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    return bytes(raw);
  }

  /// Big-endian.
  template <class T>
  ByteWriter& be(T value) {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    std::reverse(std::begin(raw), std::end(raw));
    return bytes(raw);
  }

  ByteWriter& bytes(Bytes more) {
    out_.insert(out_.end(), more.begin(), more.end());
    return *this;
  }

  ByteWriter& zeros(std::size_t count) {
    out_.resize(out_.size() + count);
    return *this;
  }

  [[nodiscard]] std::size_t size() const { return out_.size(); }
  [[nodiscard]] std::vector<std::byte> take() && { return std::move(out_); }

 private:
  std::vector<std::byte> out_;
};

}  // namespace verge
