// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

namespace verge {

using Bytes = std::span<const std::byte>;

/// The little-endian value of type T at `offset`. The caller has checked that offset + sizeof(T) <=
/// bytes.size().
template <class T>
[[nodiscard]] T load_le(Bytes bytes, std::size_t offset) {
  static_assert(std::endian::native == std::endian::little, "big-endian hosts need a byte swap here");
  T value;
  std::memcpy(&value, bytes.subspan(offset, sizeof(T)).data(), sizeof(T));
  return value;
}

/// The big-endian value of type T at `offset`. The caller has checked that offset + sizeof(T) <=
/// bytes.size().
template <class T>
[[nodiscard]] T load_be(Bytes bytes, std::size_t offset) {
  std::byte swapped[sizeof(T)];
  const Bytes raw = bytes.subspan(offset, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) swapped[i] = raw[sizeof(T) - 1 - i];
  T value;
  std::memcpy(&value, swapped, sizeof(T));
  return value;
}

}  // namespace verge
