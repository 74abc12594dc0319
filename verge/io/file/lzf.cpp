// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/lzf.hpp"

#include <cstring>

namespace verge::io {
namespace {

constexpr unsigned kFirstCopy = 32;
constexpr unsigned kLongCopy = 7;

/// Byte by byte where source and target overlap: that is how LZF repeats a pattern.
void copy_back(std::byte* target, std::size_t distance, std::size_t length) {
  const std::byte* const source = target - distance;
  if (distance >= length) {
    std::memcpy(target, source, length);
    return;
  }
  for (std::size_t i = 0; i < length; ++i) target[i] = source[i];
}

}  // namespace

std::optional<LzfFault> unpack_lzf(Bytes packed, std::span<std::byte> out) {
  std::size_t in = 0;
  std::size_t done = 0;
  while (in < packed.size()) {
    const LzfFault here = in;
    const auto control = static_cast<unsigned>(packed[in++]);
    if (control < kFirstCopy) {
      const std::size_t length = control + 1;
      if (packed.size() - in < length || out.size() - done < length) return here;
      std::memcpy(out.data() + done, packed.data() + in, length);
      in += length;
      done += length;
      continue;
    }
    std::size_t length = control >> 5U;
    const std::size_t more = length == kLongCopy ? 2 : 1;
    if (packed.size() - in < more) return here;
    if (length == kLongCopy) length += static_cast<std::size_t>(packed[in++]);
    length += 2;
    const std::size_t distance = ((control & 31U) << 8U | static_cast<unsigned>(packed[in++])) + 1U;
    if (distance > done || out.size() - done < length) return here;
    copy_back(out.data() + done, distance, length);
    done += length;
  }
  if (done != out.size()) return packed.size();
  return std::nullopt;
}

}  // namespace verge::io
