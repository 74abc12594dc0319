// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace verge::io {

std::string_view as_text(Bytes bytes) {
  // Bytes and characters may stand for each other (C++20 [basic.lval]).
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

LineReader::LineReader(std::string_view text, std::size_t first_line) : text_(text), number_(first_line - 1) {
  if (text_.find('\n') == std::string_view::npos) end_ = '\r';
}

std::optional<std::string_view> LineReader::next() {
  if (offset_ >= text_.size()) return std::nullopt;
  const std::size_t found = text_.find(end_, offset_);
  const std::size_t end = std::min(found, text_.size());
  std::string_view line = text_.substr(offset_, end - offset_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  offset_ = end + 1;
  ++number_;
  return line;
}

std::optional<Token> WordReader::next() {
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  while (at_ < line_.size() && is_space(line_[at_])) ++at_;
  if (at_ == line_.size()) return std::nullopt;
  const std::size_t begin = at_;
  while (at_ < line_.size() && !is_space(line_[at_])) ++at_;
  return Token{line_.substr(begin, at_ - begin), number_, begin + 1};
}

Error error_at(const Input& input, ErrorCode code, const Token& token, std::string what, std::string got,
               std::string need) {
  return {code,           input.name(),   fmt::format("{}:{}", token.line, token.column), std::move(what),
          std::move(got), std::move(need)};
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  if (text.size() <= kMost) return fmt::format("'{}'", text);
  // Not inside a character of UTF-8, which has three continuing bytes at most.
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  std::size_t end = kMost;
  while (end > kMost - 3 && continues(end)) --end;
  return fmt::format("'{}...'", text.substr(0, end));
}

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

/// "12.345678901", without sign or exponent; none for any other text.
std::optional<std::int64_t> parse_decimal_seconds(std::string_view text) {
  constexpr std::size_t kDecimals = 9;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string digits(text.substr(std::min(point + 1, text.size())));
  const bool plain = text.find_first_not_of("0123456789.") == std::string_view::npos;
  if (!plain || point > kDecimals + 1 || digits.size() > kDecimals) return std::nullopt;
  digits.resize(kDecimals, '0');
  const auto whole = parse_number<std::int64_t>(text.substr(0, point));
  const auto fraction = parse_number<std::int64_t>(digits);
  if (!whole || !fraction) return std::nullopt;
  return *whole < kSecond * 9 ? std::optional(*whole * kSecond + *fraction) : std::nullopt;
}

}  // namespace

std::optional<std::int64_t> parse_seconds(std::string_view text) {
  WordReader words(text, 1);
  const auto word = words.next();
  if (!word || words.next()) return std::nullopt;
  if (const auto exact = parse_decimal_seconds(word->text)) return exact;
  const auto seconds = parse_number<double>(word->text);
  // Two of these have a difference in 64 bits of nanoseconds too.
  if (!seconds || !(*seconds > -2e8 && *seconds < 9e9)) return std::nullopt;
  const double floor = std::floor(*seconds);
  return static_cast<std::int64_t>(floor) * kSecond +
         std::llround((*seconds - floor) * static_cast<double>(kSecond));
}

}  // namespace verge::io
