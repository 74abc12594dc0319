// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcd_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace verge::io {
namespace {

constexpr std::uint64_t kFirstLook = 64ULL << 10U;
constexpr std::uint64_t kLongestHeader = 4ULL << 20U;  // comments may be long
constexpr std::size_t kMostFields = 256;
constexpr std::uint64_t kMostCount = 4096;
constexpr std::array<std::string_view, 11> kKeys{"VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
                                                 "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// One line of the header: its key and what follows.
struct Entry {
  Token key;
  std::vector<Token> values;
  Token end;  ///< Behind the last value.
};

class HeaderParser {
 public:
  explicit HeaderParser(const Input& input) : input_(input) {}

  /// Reads lines up to DATA. False: the text ends before.
  [[nodiscard]] Expected<bool> read_entries(std::string_view text, bool is_whole);
  [[nodiscard]] Expected<PcdHeader> header();

 private:
  [[nodiscard]] Error fail(const Token& at, std::string what, std::string got = {},
                           std::string need = {}) const {
    return error_at(input_, ErrorCode::kUnusable, at, std::move(what), std::move(got), std::move(need));
  }
  [[nodiscard]] Expected<void> add_entry(std::string_view line, std::size_t number);
  [[nodiscard]] const Entry* find(std::string_view key) const;
  [[nodiscard]] Expected<const Entry*> list(std::string_view key, std::size_t values) const;
  [[nodiscard]] Expected<std::optional<std::uint64_t>> number(std::string_view key) const;
  [[nodiscard]] Expected<void> fill_fields();
  [[nodiscard]] Expected<void> fill_field(std::size_t index, const Entry& sizes, const Entry& types,
                                          const Entry* counts);
  [[nodiscard]] Expected<void> check_names(const Entry& names) const;
  [[nodiscard]] Expected<void> fill_points();
  [[nodiscard]] Expected<void> fill_data();
  [[nodiscard]] Expected<void> fill_viewpoint();
  [[nodiscard]] Expected<void> check_size() const;

  const Input& input_;
  std::map<std::string, Entry, std::less<>> entries_;
  Token end_;
  PcdHeader header_;
};

std::optional<Scalar> scalar_of(std::string_view type, std::uint64_t size) {
  if (type == "F") {
    if (size == 4) return Scalar::kF32;
    if (size == 8) return Scalar::kF64;
    return std::nullopt;
  }
  constexpr std::array<std::pair<std::uint64_t, Scalar>, 4> kSigned{
      {{1, Scalar::kI8}, {2, Scalar::kI16}, {4, Scalar::kI32}, {8, Scalar::kI64}}};
  constexpr std::array<std::pair<std::uint64_t, Scalar>, 4> kUnsigned{
      {{1, Scalar::kU8}, {2, Scalar::kU16}, {4, Scalar::kU32}, {8, Scalar::kU64}}};
  for (const auto& [bytes, scalar] : type == "I" ? kSigned : kUnsigned) {
    if (bytes == size) return scalar;
  }
  return std::nullopt;
}

Expected<void> HeaderParser::add_entry(std::string_view line, std::size_t number) {
  WordReader words(line, number);
  const auto key = words.next();
  if (!key || key->text.front() == '#') return {};
  if (std::find(kKeys.begin(), kKeys.end(), key->text) == kKeys.end()) {
    return Unexpected(fail(*key, "no entry of a PCD header", quoted(key->text)));
  }
  const std::string name = key->text == "COLUMNS" ? "FIELDS" : std::string(key->text);
  Entry entry{*key, {}, words.end()};
  while (const auto word = words.next()) {
    if (entry.values.size() == kMostFields) {
      return Unexpected(fail(*word, "too many values in one entry", "> 256", "<= 256"));
    }
    entry.values.push_back(*word);
  }
  if (entry.values.empty()) return Unexpected(fail(entry.end, fmt::format("{} has no value", name)));
  const Token at = *key;
  if (!entries_.emplace(name, std::move(entry)).second) {
    return Unexpected(fail(at, fmt::format("{} stands twice", name)));
  }
  return {};
}

Expected<bool> HeaderParser::read_entries(std::string_view text, bool is_whole) {
  LineReader lines(text);
  while (const auto line = lines.next()) {
    end_ = {{}, lines.number(), line->size() + 1};
    const bool is_complete = lines.offset() <= text.size();
    if (!is_complete && !is_whole) return false;
    if (auto added = add_entry(*line, lines.number()); !added) return Unexpected(added.error());
    if (!entries_.contains("DATA")) continue;
    header_.data_offset = std::min(lines.offset(), text.size());
    header_.data_line = lines.number() + 1;
    return true;
  }
  return false;
}

const Entry* HeaderParser::find(std::string_view key) const {
  const auto found = entries_.find(key);
  return found == entries_.end() ? nullptr : &found->second;
}

/// The entry `key`, which has to have `values` values.
Expected<const Entry*> HeaderParser::list(std::string_view key, std::size_t values) const {
  const Entry* entry = find(key);
  if (entry == nullptr) return Unexpected(fail(end_, fmt::format("{} is missing", key)));
  if (entry->values.size() != values) {
    return Unexpected(fail(entry->key, fmt::format("{} does not fit FIELDS", key),
                           fmt::format("{} values", entry->values.size()), fmt::format("{}", values)));
  }
  return entry;
}

/// The one number of an entry; none where the entry is missing.
Expected<std::optional<std::uint64_t>> HeaderParser::number(std::string_view key) const {
  const Entry* entry = find(key);
  if (entry == nullptr) return std::nullopt;
  const auto value = parse_number<std::uint64_t>(entry->values.front().text);
  if (!value || entry->values.size() != 1) {
    return Unexpected(fail(entry->values.front(), fmt::format("{} is no number of points", key),
                           quoted(entry->values.front().text), "an integer from 0"));
  }
  return *value;
}

Expected<void> HeaderParser::check_names(const Entry& names) const {
  std::set<std::string_view> seen;
  for (const Token& name : names.values) {
    // '_' is padding and may come again.
    if (name.text != "_" && !seen.insert(name.text).second) {
      return Unexpected(fail(name, "field stands twice", quoted(name.text)));
    }
  }
  for (const std::string_view needed : {"x", "y", "z"}) {
    if (!seen.contains(needed)) return Unexpected(fail(names.key, fmt::format("no field {}", needed)));
  }
  return {};
}

Expected<void> HeaderParser::fill_field(std::size_t index, const Entry& sizes, const Entry& types,
                                        const Entry* counts) {
  const auto size = parse_number<std::uint64_t>(sizes.values[index].text);
  if (!size || (*size != 1 && *size != 2 && *size != 4 && *size != 8)) {
    return Unexpected(
        fail(sizes.values[index], "SIZE of a field", quoted(sizes.values[index].text), "1, 2, 4 or 8"));
  }
  const std::string_view type = types.values[index].text;
  if (type != "F" && type != "I" && type != "U") {
    return Unexpected(fail(types.values[index], "TYPE of a field", quoted(type), "F, I or U"));
  }
  const auto scalar = scalar_of(type, *size);
  if (!scalar) {
    return Unexpected(
        fail(types.values[index], "TYPE and SIZE do not fit", fmt::format("F of {} B", *size), "4 or 8 B"));
  }
  const auto count = counts == nullptr ? 1 : parse_number<std::uint64_t>(counts->values[index].text);
  if (!count || *count < 1 || *count > kMostCount) {
    return Unexpected(
        fail(counts->values[index], "COUNT of a field", quoted(counts->values[index].text), "1 to 4096"));
  }
  PcdField field{header_.fields[index].name, *scalar, static_cast<std::size_t>(*count), header_.point_bytes};
  header_.point_bytes += field.bytes();
  header_.fields[index] = std::move(field);
  return {};
}

Expected<void> HeaderParser::fill_fields() {
  const Entry* names = find("FIELDS");
  if (names == nullptr) return Unexpected(fail(end_, "FIELDS is missing"));
  if (auto checked = check_names(*names); !checked) return checked;
  for (const Token& name : names->values) header_.fields.push_back({std::string(name.text)});
  const auto sizes = list("SIZE", names->values.size());
  if (!sizes) return Unexpected(sizes.error());
  const auto types = list("TYPE", names->values.size());
  if (!types) return Unexpected(types.error());
  const Entry* counts = nullptr;
  if (find("COUNT") != nullptr) {
    const auto found = list("COUNT", names->values.size());
    if (!found) return Unexpected(found.error());
    counts = *found;
  }
  for (std::size_t i = 0; i < header_.fields.size(); ++i) {
    if (auto filled = fill_field(i, **sizes, **types, counts); !filled) return filled;
  }
  return {};
}

Expected<void> HeaderParser::fill_points() {
  const auto points = number("POINTS");
  if (!points) return Unexpected(points.error());
  const auto width = number("WIDTH");
  if (!width) return Unexpected(width.error());
  const auto height = number("HEIGHT");
  if (!height) return Unexpected(height.error());
  const Entry* entry = find("POINTS") != nullptr ? find("POINTS") : find("WIDTH");
  if (entry == nullptr) return Unexpected(fail(end_, "neither POINTS nor WIDTH is there"));
  header_.points_at = {{}, entry->key.line, entry->key.column};  // its text goes with the buffer
  header_.points = *points ? **points : **width * height->value_or(1);
  const std::uint64_t rows = height->value_or(1);
  if (!*width) return {};
  // By division: the product may be more than 64 bits hold.
  const bool fits = rows == 0 || **width == 0
                        ? header_.points == 0
                        : header_.points % rows == 0 && header_.points / rows == **width;
  if (!fits) {
    return Unexpected(fail(entry->key, "POINTS is not WIDTH x HEIGHT",
                           *points ? fmt::format("{}", **points) : "more than 64 bits hold",
                           fmt::format("{} x {}", **width, rows)));
  }
  return {};
}

Expected<void> HeaderParser::fill_data() {
  const Entry& entry = *find("DATA");
  const std::string_view kind = entry.values.front().text;
  if (kind == "ascii") {
    header_.data = PcdData::kAscii;
  } else if (kind == "binary") {
    header_.data = PcdData::kBinary;
  } else if (kind == "binary_compressed") {
    header_.data = PcdData::kBinaryCompressed;
  } else {
    return Unexpected(fail(entry.values.front(), "DATA is of no known kind", quoted(kind),
                           "ascii, binary or binary_compressed"));
  }
  return {};
}

Expected<void> HeaderParser::fill_viewpoint() {
  if (find("VIEWPOINT") == nullptr) return {};
  constexpr std::array<double, 7> kIdentity{0, 0, 0, 1, 0, 0, 0};
  const Entry& entry = *find("VIEWPOINT");
  if (entry.values.size() != kIdentity.size()) {
    return Unexpected(fail(entry.key, "VIEWPOINT", fmt::format("{} numbers", entry.values.size()), "7"));
  }
  for (std::size_t i = 0; i < kIdentity.size(); ++i) {
    const auto value = parse_number<double>(entry.values[i].text);
    if (!value)
      return Unexpected(fail(entry.values[i], "VIEWPOINT", quoted(entry.values[i].text), "a number"));
    header_.has_viewpoint = header_.has_viewpoint || *value != kIdentity[i];
  }
  return {};
}

/// Whether the data can be as long as the header says. Compressed data are checked when they are unpacked.
Expected<void> HeaderParser::check_size() const {
  const std::uint64_t left = input_.size() - header_.data_offset;
  // A number in ascii takes two bytes with its separator; the last one may stand without.
  std::uint64_t values = 0;
  for (const PcdField& field : header_.fields) values += field.count;
  const bool ascii = header_.data == PcdData::kAscii;
  const std::uint64_t least = std::max<std::uint64_t>(ascii ? 2 * values : header_.point_bytes, 1);
  const std::uint64_t most = (left + (ascii ? 1 : 0)) / least;
  if (header_.data == PcdData::kBinaryCompressed || header_.points <= most) return {};
  return Unexpected(fail(header_.points_at, "POINTS asks for more data than the file holds",
                         fmt::format("{} x {} B", header_.points, least), fmt::format("<= {} B", left)));
}

Expected<PcdHeader> HeaderParser::header() {
  if (find("DATA") == nullptr) return Unexpected(fail(end_, "DATA is missing"));
  using Step = Expected<void> (HeaderParser::*)();
  for (const Step step : {&HeaderParser::fill_data, &HeaderParser::fill_fields, &HeaderParser::fill_points,
                          &HeaderParser::fill_viewpoint}) {
    if (auto done = (this->*step)(); !done) return Unexpected(done.error());
  }
  if (auto checked = check_size(); !checked) return Unexpected(checked.error());
  return header_;
}

}  // namespace

Expected<PcdHeader> read_pcd_header(Input& input) {
  for (std::uint64_t look = kFirstLook;; look = kLongestHeader) {
    const auto bytes = input.head(look);
    if (!bytes) return Unexpected(bytes.error());
    const bool is_whole = bytes->size() == input.size();
    HeaderParser parser(input);
    const auto complete = parser.read_entries(as_text(*bytes), is_whole);
    if (!complete) return Unexpected(complete.error());
    if (*complete || is_whole || look == kLongestHeader) return parser.header();
  }
}

}  // namespace verge::io
