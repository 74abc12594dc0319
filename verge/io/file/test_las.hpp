// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include "verge/io/file/las_header.hpp"

// LAS files for tests, good and bad.

namespace verge::testing {

/// A file of LAS 1.MINOR as a text of bytes, with numbers at their places. Point i stands at (i, -2, 0.5).
class LasFile {
 public:
  LasFile(int minor, std::uint8_t format, std::size_t points, const std::string& vlrs = {}) {
    const std::size_t header = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    record_ = io::las_record_bytes(format <= 10 ? format : 0);
    bytes_.assign(header + vlrs.size() + points * record_, '\0');
    bytes_.replace(header, vlrs.size(), vlrs);
    bytes_.replace(0, 4, "LASF");
    points_at_ = header + vlrs.size();
    put(24, std::uint8_t{1})
        .put(25, static_cast<std::uint8_t>(minor))
        .put(94, static_cast<std::uint16_t>(header));
    put(96, static_cast<std::uint32_t>(points_at_))
        .put(104, format)
        .put(105, static_cast<std::uint16_t>(record_));
    put(107, static_cast<std::uint32_t>(format <= 5 ? points : 0));
    if (minor == 4) put(247, static_cast<std::uint64_t>(points));
    for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.001);
    for (std::size_t i = 0; i < points; ++i)
      point(i, 0, static_cast<std::int32_t>(1000 * i)).point(i, 4, -2000).point(i, 8, 500);
  }

  template <class T>
  LasFile& put(std::size_t at, T value) {
    std::memcpy(bytes_.data() + at, &value, sizeof(T));
    return *this;
  }
  /// In a point's record.
  template <class T>
  LasFile& point(std::size_t i, std::size_t at, T value) {
    return put(points_at_ + i * record_ + at, value);
  }
  /// Moves a point, in steps of a millimetre.
  LasFile& place(std::size_t i, double x, double y, double z) {
    const auto steps = [](double metres) { return static_cast<std::int32_t>(std::lround(1000 * metres)); };
    return point(i, 0, steps(x)).point(i, 4, steps(y)).point(i, 8, steps(z));
  }
  LasFile& text(std::size_t at, const std::string& text) {
    bytes_.replace(at, text.size(), text);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::size_t points_at() const { return points_at_; }

 private:
  std::size_t record_ = 0;
  std::size_t points_at_ = 0;
  std::string bytes_;
};

/// A variable length record with `length` bytes behind its header, which promises `said`.
[[nodiscard]] inline std::string vlr(const std::string& user, std::uint16_t id, std::size_t length,
                                     std::uint16_t said) {
  std::string bytes(54 + length, '\0');
  bytes.replace(2, user.size(), user);
  std::memcpy(bytes.data() + 18, &id, 2);
  std::memcpy(bytes.data() + 20, &said, 2);
  return bytes;
}

}  // namespace verge::testing
