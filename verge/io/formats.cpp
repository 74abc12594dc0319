// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>

namespace verge::io {
namespace {

/// A row a format, in the order of the enum.
constexpr std::array<FormatFacts, enum_names<Format>.size()> kFacts{{
    {.suffix = ".bin", .written = true},                      // kitti
    {.suffix = ".pcd.bin", .written = true},                  // nuscenes
    {.suffix = ".pcd", .written = true},                      // pcd
    {.suffix = ".ply", .written = true},                      // ply
    {.suffix = ".csv", .written = true},                      // csv
    {.suffix = ".las", .written = true},                      // las
    {.suffix = ".idc", .many_scans = true, .written = true},  // ibeo
    {.suffix = ".alasca", .many_scans = true, .written = true},
    {.suffix = ".pcap", .other_suffix = ".pcapng", .many_scans = true, .written = true},
    {.suffix = ".bag", .many_scans = true},
    {.suffix = ".db3", .many_scans = true},
    {.suffix = ".mcap", .many_scans = true, .written = true},
}};

bool has_suffix(std::string_view name, std::string_view suffix) {
  return !suffix.empty() && name.size() > suffix.size() && name.ends_with(suffix);
}

}  // namespace

const FormatFacts& facts_of(Format format) { return kFacts[static_cast<std::size_t>(format)]; }

std::string_view name_of(Format format) { return enum_names<Format>[static_cast<std::size_t>(format)]; }

std::vector<Format> all_formats() {
  std::vector<Format> all;
  for (std::size_t i = 0; i < kFacts.size(); ++i) all.push_back(static_cast<Format>(i));
  return all;
}

std::optional<Format> format_of_name(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  std::optional<Format> found;
  for (const Format format : all_formats()) {
    const FormatFacts& facts = facts_of(format);
    if (!has_suffix(name, facts.suffix) && !has_suffix(name, facts.other_suffix)) continue;
    // ".pcd.bin" is not ".bin".
    if (!found || facts.suffix.size() > facts_of(*found).suffix.size()) found = format;
  }
  return found;
}

}  // namespace verge::io
