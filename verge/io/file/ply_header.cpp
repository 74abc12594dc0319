// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ply_header.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace verge::io {
namespace {

constexpr std::uint64_t kLongestHeader = 64ULL << 10U;
constexpr std::size_t kMostLines = 1024;

std::optional<Scalar> scalar_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> kTypes{{{"char", Scalar::kI8},
                                                                        {"int8", Scalar::kI8},
                                                                        {"uchar", Scalar::kU8},
                                                                        {"uint8", Scalar::kU8},
                                                                        {"short", Scalar::kI16},
                                                                        {"int16", Scalar::kI16},
                                                                        {"ushort", Scalar::kU16},
                                                                        {"uint16", Scalar::kU16},
                                                                        {"int", Scalar::kI32},
                                                                        {"int32", Scalar::kI32},
                                                                        {"uint", Scalar::kU32},
                                                                        {"uint32", Scalar::kU32},
                                                                        {"float", Scalar::kF32},
                                                                        {"float32", Scalar::kF32},
                                                                        {"double", Scalar::kF64},
                                                                        {"float64", Scalar::kF64}}};
  for (const auto& [text, scalar] : kTypes) {
    if (text == name) return scalar;
  }
  return std::nullopt;
}

class HeaderParser {
 public:
  explicit HeaderParser(const Input& input) : input_(input) {}

  [[nodiscard]] Expected<PlyHeader> read(std::string_view text);

 private:
  [[nodiscard]] Error fail(const Token& at, std::string what, std::string got = {},
                           std::string need = {}) const {
    return error_at(input_, ErrorCode::kUnusable, at, std::move(what), std::move(got), std::move(need));
  }
  /// The next word of the line, which has to be there.
  [[nodiscard]] Expected<Token> word(WordReader& words, std::string_view meaning) const;
  [[nodiscard]] Expected<Scalar> type(WordReader& words, bool integer) const;
  [[nodiscard]] Expected<void> read_line(std::string_view line, std::size_t number);
  [[nodiscard]] Expected<void> read_format(WordReader& words);
  [[nodiscard]] Expected<void> read_element(WordReader& words);
  [[nodiscard]] Expected<void> read_property(const Token& key, WordReader& words);
  void read_stamp(std::string_view line);
  [[nodiscard]] Expected<void> check();

  const Input& input_;
  PlyHeader header_;
  bool has_format_ = false;
  Token end_;
};

Expected<Token> HeaderParser::word(WordReader& words, std::string_view meaning) const {
  const auto next = words.next();
  if (!next) return Unexpected(fail(words.end(), fmt::format("{} is missing", meaning)));
  return *next;
}

Expected<Scalar> HeaderParser::type(WordReader& words, bool integer) const {
  const auto name = word(words, "type of the property");
  if (!name) return Unexpected(name.error());
  const auto scalar = scalar_of(name->text);
  if (!scalar || (integer && !is_integer(*scalar))) {
    return Unexpected(
        fail(*name, "property has an unknown type", quoted(name->text),
             integer ? "an integer type" : "char, uchar, short, ushort, int, uint, float or double"));
  }
  return *scalar;
}

Expected<void> HeaderParser::read_format(WordReader& words) {
  constexpr std::array<std::pair<std::string_view, PlyData>, 3> kKinds{
      {{"ascii", PlyData::kAscii},
       {"binary_little_endian", PlyData::kLittleEndian},
       {"binary_big_endian", PlyData::kBigEndian}}};
  const auto kind = word(words, "format's kind");
  if (!kind) return Unexpected(kind.error());
  const auto known =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& k) { return k.first == kind->text; });
  if (known == kKinds.end()) {
    return Unexpected(fail(*kind, "format is of no known kind", quoted(kind->text),
                           "ascii, binary_little_endian or binary_big_endian"));
  }
  const auto version = word(words, "format's version");
  if (!version) return Unexpected(version.error());
  if (version->text != "1.0")
    return Unexpected(fail(*version, "format's version", quoted(version->text), "1.0"));
  header_.data = known->second;
  has_format_ = true;
  return {};
}

Expected<void> HeaderParser::read_element(WordReader& words) {
  const auto name = word(words, "name of the element");
  if (!name) return Unexpected(name.error());
  const auto count = word(words, "count of the element");
  if (!count) return Unexpected(count.error());
  const auto number = parse_number<std::uint64_t>(count->text);
  if (!number)
    return Unexpected(fail(*count, "count of the element", quoted(count->text), "an integer from 0"));
  for (const PlyElement& element : header_.elements) {
    if (element.name == name->text)
      return Unexpected(fail(*name, "element stands twice", quoted(name->text)));
  }
  header_.elements.push_back({std::string(name->text), *number, {{}, count->line, count->column}, {}});
  return {};
}

Expected<void> HeaderParser::read_property(const Token& key, WordReader& words) {
  if (header_.elements.empty()) return Unexpected(fail(key, "property before the first element"));
  PlyProperty property;
  WordReader ahead = words;
  const auto first = ahead.next();
  const bool list = first && first->text == "list";
  if (list) {
    words = ahead;
    const auto count = type(words, true);
    if (!count) return Unexpected(count.error());
    property.list_count = *count;
  }
  const auto value = type(words, false);
  if (!value) return Unexpected(value.error());
  property.type = *value;
  const auto name = word(words, "name of the property");
  if (!name) return Unexpected(name.error());
  property.name = std::string(name->text);
  auto& properties = header_.elements.back().properties;
  if (std::any_of(properties.begin(), properties.end(),
                  [&](const PlyProperty& p) { return p.name == property.name; })) {
    return Unexpected(fail(*name, "property stands twice", quoted(name->text)));
  }
  properties.push_back(std::move(property));
  return {};
}

/// A comment may say anything: what is no stamp is none.
void HeaderParser::read_stamp(std::string_view line) {
  const std::size_t at = line.find(kPlyStamp);
  if (at != std::string_view::npos)
    header_.stamp_ns = parse_number<std::int64_t>(line.substr(at + kPlyStamp.size()));
}

Expected<void> HeaderParser::read_line(std::string_view line, std::size_t number) {
  WordReader words(line, number);
  const auto key = words.next();
  if (!key) return Unexpected(fail({{}, number, 1}, "empty line in the header"));
  if (key->text == "comment" || key->text == "obj_info") {
    read_stamp(line);
    return {};
  }
  if (!has_format_ && key->text != "format") {
    return Unexpected(fail(*key, "second line has to be the format", quoted(key->text), "'format'"));
  }
  if (key->text == "format") {
    return has_format_ ? Expected<void>(Unexpected(fail(*key, "format stands twice"))) : read_format(words);
  }
  if (key->text == "element") return read_element(words);
  if (key->text == "property") return read_property(*key, words);
  return Unexpected(fail(*key, "no entry of a PLY header", quoted(key->text)));
}

/// Whether there is a vertex element with x, y, z, and no property but x, y, z, ... in lists.
Expected<void> HeaderParser::check() {
  const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                   [](const PlyElement& element) { return element.name == "vertex"; });
  if (!has_format_) return Unexpected(fail(end_, "format is missing"));
  if (vertex == header_.elements.end()) return Unexpected(fail(end_, "no element vertex"));
  header_.vertex = static_cast<std::size_t>(vertex - header_.elements.begin());
  for (const std::string_view needed : {"x", "y", "z"}) {
    const bool there = std::any_of(vertex->properties.begin(), vertex->properties.end(),
                                   [&](const PlyProperty& p) { return p.name == needed && !p.list_count; });
    if (!there) return Unexpected(fail(vertex->count_at, fmt::format("vertex has no property {}", needed)));
  }
  return {};
}

Expected<PlyHeader> HeaderParser::read(std::string_view text) {
  LineReader lines(text);
  auto line = lines.next();
  if (!line || *line != "ply") return Unexpected(fail({{}, 1, 1}, "first line has to be 'ply'"));
  for (line = lines.next(); line && lines.number() <= kMostLines; line = lines.next()) {
    end_ = {{}, lines.number(), line->size() + 1};
    if (*line == "end_header") {
      header_.data_offset = std::min(lines.offset(), text.size());
      header_.data_line = lines.number() + 1;
      if (auto checked = check(); !checked) return Unexpected(checked.error());
      return header_;
    }
    if (auto read = read_line(*line, lines.number()); !read) return Unexpected(read.error());
  }
  return Unexpected(fail(end_, "no end_header", {}, "within 64 KiB and 1024 lines"));
}

}  // namespace

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.list_count.has_value(); });
}

std::uint64_t PlyElement::least_bytes() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += size_of(property.list_count.value_or(property.type));
  return bytes;
}

Expected<PlyHeader> read_ply_header(Input& input) {
  const auto bytes = input.head(kLongestHeader);
  if (!bytes) return Unexpected(bytes.error());
  return HeaderParser(input).read(as_text(*bytes));
}

}  // namespace verge::io
