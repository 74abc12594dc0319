// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/error.hpp"

#include <fmt/core.h>

namespace verge {
namespace {

constexpr std::size_t kMaxLine = 280;

/// Shortens the middle of a long text: both a path's folder and its file name stay readable.
std::string shorten(std::string text, std::size_t max) {
  if (text.size() <= max) return text;
  constexpr std::string_view kDots = "...";
  const std::size_t head = (max - kDots.size()) / 2;
  const std::size_t tail = max - kDots.size() - head;
  return text.substr(0, head).append(kDots).append(text, text.size() - tail, tail);
}

std::string comparison(const Error& error) {
  if (error.got.empty() && error.need.empty()) return {};
  if (error.need.empty()) return fmt::format(" (got {})", error.got);
  if (error.got.empty()) return fmt::format(" (need {})", error.need);
  return fmt::format(" (got {}, need {})", error.got, error.need);
}

}  // namespace

std::string escape_control_bytes(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || c == '\\') {
      out += fmt::format("\\x{:02X}", byte);
    } else {
      out += c;
    }
  }
  return out;
}

std::string to_string(const Error& error) {
  const std::string tail = shorten(escape_control_bytes(error.what + comparison(error)), kMaxLine * 2 / 3);
  std::string place = escape_control_bytes(error.file);
  if (!error.where.empty()) place += (place.empty() ? "" : ":") + error.where;
  if (place.empty()) return tail;
  return shorten(std::move(place), kMaxLine - tail.size() - 2) + ": " + tail;
}

}  // namespace verge
