// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/model/json_text.hpp"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace verge::model {
namespace {

using nlohmann::json;

/// Goes through a text without keeping anything, to learn where it stops being JSON.
class FaultFinder final : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(json::number_integer_t) override { return true; }
  bool number_unsigned(json::number_unsigned_t) override { return true; }
  bool number_float(json::number_float_t, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(std::string&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
    fault = {std::max<std::size_t>(position, 1), sentence_of(error.what())};
    return false;
  }

  std::optional<SyntaxFault> fault;

 private:
  /// The library's message without its name and its own count of columns:
  /// "[json.exception.parse_error.101] parse error at line 1, column 6: WHAT".
  static std::string sentence_of(std::string_view message) {
    if (const std::size_t tag = message.find("] "); tag != std::string_view::npos)
      message.remove_prefix(tag + 2);
    constexpr std::string_view kPlace = "parse error at ";
    if (message.starts_with(kPlace)) message.remove_prefix(std::min(message.find(": ") + 2, message.size()));
    return std::string(message);
  }
};

/// Walks over a text that is known to be JSON, so that every step is where it must be.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    skip_space();
  }

  [[nodiscard]] std::size_t at() const { return at_; }

  void enter(std::size_t index) {
    next();  // [
    for (std::size_t i = 0; i < index; ++i) {
      skip_value();
      next();  // ,
    }
  }

  void enter(std::string_view name) {
    std::size_t found = at_;
    next();  // {
    while (text_[at_] != '}') {
      const bool same = json::parse(skip_string()).get<std::string>() == name;
      next();  // :
      if (same) found = at_;
      skip_value();
      if (text_[at_] == ',') next();
    }
    at_ = found;
  }

 private:
  void skip_space() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  void next() {
    ++at_;
    skip_space();
  }
  std::string_view skip_string() {
    const std::size_t begin = at_++;
    while (text_[at_] != '"') at_ += text_[at_] == '\\' ? 2U : 1U;
    const std::string_view string = text_.substr(begin, at_ + 1 - begin);
    next();
    return string;
  }
  void skip_value() {
    std::size_t depth = 0;
    do {
      const char c = text_[at_];
      if (c == '"') {
        skip_string();
        continue;
      }
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
      next();
    } while (depth > 0 || !ends_value());
  }
  [[nodiscard]] bool ends_value() const {
    return at_ >= text_.size() || std::string_view(",]}").find(text_[at_]) != std::string_view::npos;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<SyntaxFault> find_syntax_fault(std::string_view text) {
  FaultFinder finder;
  json::sax_parse(text, &finder);
  return finder.fault;
}

std::size_t column_of(std::string_view text, std::span<const JsonStep> path) {
  Walker walker(text);
  for (const JsonStep& step : path) {
    std::visit([&](const auto& into) { walker.enter(into); }, step);
  }
  return walker.at() + 1;
}

std::string line_and_column(std::string_view text, std::size_t column, std::size_t first_line) {
  const std::string_view before = text.substr(0, column - 1);
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::size_t begin = lines == 0 ? 0 : before.rfind('\n') + 1;
  return fmt::format("{}:{}", first_line + lines, column - begin);
}

std::string valid_utf8(std::string_view text) {
  const std::string quoted = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(quoted).get<std::string>();
}

}  // namespace verge::model
