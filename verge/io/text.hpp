// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "verge/core/bytes.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// The bytes as text.
[[nodiscard]] std::string_view as_text(Bytes bytes);

/// A stretch of a line and where it stands: for numbers and for errors.
struct Token {
  std::string_view text;
  std::size_t line = 1;    ///< From 1.
  std::size_t column = 1;  ///< From 1, in bytes.
};

/// Lines of a text, one after the other, that end in LF, CR LF, or CR where the text has no LF at all.
class LineReader {
 public:
  /// The first line has the number `first_line`.
  explicit LineReader(std::string_view text, std::size_t first_line = 1);

  /// The next line without its end; none behind the last.
  [[nodiscard]] std::optional<std::string_view> next();
  /// Number of the line that next() gave last.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Where the line behind it begins, in bytes from the beginning of the text.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  std::size_t number_;
  char end_ = '\n';
};

/// Words of a line, parted by spaces and tabs.
class WordReader {
 public:
  WordReader(std::string_view line, std::size_t line_number) : line_(line), number_(line_number) {}
  /// The next word; none at the end.
  [[nodiscard]] std::optional<Token> next();
  /// Where the next word would have to stand: the end of the line.
  [[nodiscard]] Token end() const { return {{}, number_, line_.size() + 1}; }

 private:
  std::string_view line_;
  std::size_t number_;
  std::size_t at_ = 0;
};

/// Longest text of a number.
inline constexpr std::size_t kLongestNumber = 64;

/// The number that `text` is as a whole, whatever the locale; none where it is none, or (integers) does not
/// fit T. A float beyond T's range is NaN: no coordinate, but a number as its writer meant it. "nan" and
/// "inf" are numbers too.
template <class T>
[[nodiscard]] std::optional<T> parse_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty() || text.size() > kLongestNumber) return std::nullopt;
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc{}) return value;
  if constexpr (std::is_floating_point_v<T>) {
    if (error == std::errc::result_out_of_range) return std::numeric_limits<T>::quiet_NaN();
  }
  return std::nullopt;
}

/// An error of text at a token.
[[nodiscard]] Error error_at(const Input& input, ErrorCode code, const Token& token, std::string what,
                             std::string got = {}, std::string need = {});

/// A piece of text for an error: no longer than fits a line.
[[nodiscard]] std::string quoted(std::string_view text);

/// Seconds with decimals or exponent ("1.036224e-01") as nanoseconds: exact with up to nine decimals and no
/// exponent. None: no time, or not within -2e8 to 9e9 s.
[[nodiscard]] std::optional<std::int64_t> parse_seconds(std::string_view text);

}  // namespace verge::io
