// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/error.hpp"

#include <algorithm>
#include <array>

#include <fmt/core.h>

namespace verge {
namespace {

constexpr std::size_t kMaxLine = 280;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Bytes of the UTF-8 character at the beginning of the text (Unicode 15, table 3-7: no longer form than
/// needed, no surrogate, nothing beyond U+10FFFF); 0 where there is none.
std::size_t character_bytes(std::string_view text) {
  /// First byte up to `last`, so many bytes, the second from `low` to `high`.
  struct Row {
    unsigned last, bytes, low, high;
  };
  constexpr std::array<Row, 9> kRows{{{0x7F, 1, 0, 0},
                                      {0xC1, 0, 0, 0},
                                      {0xDF, 2, 0x80, 0xBF},
                                      {0xE0, 3, 0xA0, 0xBF},
                                      {0xEC, 3, 0x80, 0xBF},
                                      {0xED, 3, 0x80, 0x9F},
                                      {0xEF, 3, 0x80, 0xBF},
                                      {0xF0, 4, 0x90, 0xBF},
                                      {0xF4, 4, 0x80, 0xBF}}};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto* row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& known) { return byte(0) <= known.last; });
  if (row == kRows.end() || row->bytes == 0 || row->bytes > text.size()) return 0;
  if (row->bytes == 1) return 1;
  const unsigned high = byte(0) == 0xF4 ? 0x8F : row->high;
  if (byte(1) < row->low || byte(1) > high) return 0;
  return std::all_of(text.begin() + 2, text.begin() + row->bytes, is_continuation) ? row->bytes : 0;
}

/// Whether a terminal would obey the character instead of showing it, or an escape could not be told from it.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7F || first == '\\';
  return first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;  // U+0080 to U+009F
}

/// Where an escaped text may be cut at or before `at`: not inside a character, and not inside "\xNN".
std::size_t cut_before(std::string_view text, std::size_t at) {
  while (at > 0 && at < text.size() && is_continuation(text[at])) --at;
  const std::size_t escape = text.rfind('\\', at == 0 ? 0 : at - 1);
  return escape != std::string_view::npos && escape < at && escape + 4 > at ? escape : at;
}

/// The same at or behind `at`.
std::size_t cut_behind(std::string_view text, std::size_t at) {
  while (at < text.size() && is_continuation(text[at])) ++at;
  const std::size_t before = cut_before(text, at);
  return before == at ? at : std::min(before + 4, text.size());
}

/// Shortens the middle of a long escaped text: both a path's folder and its file name stay readable.
std::string shorten(std::string text, std::size_t max) {
  if (text.size() <= max) return text;
  constexpr std::string_view kDots = "...";
  const std::size_t half = (max - kDots.size()) / 2;
  const std::size_t head = cut_before(text, half);
  const std::size_t tail = cut_behind(text, text.size() - (max - kDots.size() - half));
  return text.substr(0, head).append(kDots).append(text, tail);
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
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(bytes, 1));
    if (bytes > 0 && !is_control(character)) {
      out += character;
    } else {
      for (const char c : character) out += fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
    }
    text.remove_prefix(character.size());
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
