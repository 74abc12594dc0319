// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/text.hpp"

#include <algorithm>
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
  return fmt::format("'{}...'", text.substr(0, kMost));
}

}  // namespace verge::io
