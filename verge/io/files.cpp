// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/files.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "verge/io/formats.hpp"
#include "verge/io/sniff.hpp"

namespace verge::io {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 5> kFoldersOfDataSets{"", "velodyne", "velodyne_points/data",
                                                             "LIDAR_TOP", "samples/LIDAR_TOP"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The run of digits at the front of `text`, which goes, without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

/// Suffixes of one kind share a name: what a folder may not mix.
std::string kind_of(const fs::path& path) {
  const std::string suffix = scan_suffix(path);
  return suffix == ".pcd.bin" ? ".bin" : suffix;
}

std::string kind_of(Format format) {
  if (format == Format::kKitti || format == Format::kNuscenes) return ".bin";
  return std::string(facts_of(format).suffix);
}

Error cannot_open(const fs::path& folder, const std::error_code& error) {
  return {
      ErrorCode::kCannotOpen, folder.string(), {}, fmt::format("cannot open: {}", error.message()), {}, {}};
}

using FilesByKind = std::map<std::string, std::vector<fs::path>>;

/// What a folder holds, by kind. A link that leads nowhere counts: whoever made it meant a scan.
Expected<FilesByKind> list_folder(const fs::path& folder) {
  FilesByKind files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code broken;
    const fs::file_status status = entry->status(broken);
    const std::string kind = kind_of(entry->path());
    if (!kind.empty() && (fs::is_regular_file(status) || broken || !fs::exists(status))) {
      files[kind].push_back(entry->path());
    }
  }
  if (error) return Unexpected(cannot_open(folder, error));
  return files;
}

/// The one kind of files that counts; empty where there is none.
Expected<std::vector<fs::path>> choose_kind(const fs::path& folder, FilesByKind files,
                                            std::optional<Format> forced) {
  if (forced) return std::move(files[kind_of(*forced)]);
  if (files.size() > 1) files.erase(".csv");  // tables beside scans are about them
  if (files.empty()) return std::vector<fs::path>();
  if (files.size() == 1) return std::move(files.begin()->second);
  std::vector<std::string> kinds;
  for (const auto& [kind, paths] : files) kinds.push_back(fmt::format("{} {}", paths.size(), kind));
  return Unexpected({ErrorCode::kUsage,
                     folder.string(),
                     {},
                     "folder has files of two formats: choose one",
                     fmt::format("{}", fmt::join(kinds, ", ")),
                     "one format"});
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view left = a;
  std::string_view right = b;
  while (!left.empty() && !right.empty()) {
    if (is_digit(left.front()) && is_digit(right.front())) {
      const std::string_view m = take_number(left);
      const std::string_view n = take_number(right);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
      continue;
    }
    if (left.front() != right.front()) {
      return static_cast<unsigned char>(left.front()) < static_cast<unsigned char>(right.front());
    }
    left.remove_prefix(1);
    right.remove_prefix(1);
  }
  if (left.empty() != right.empty()) return left.empty();
  return a < b;
}

Expected<ScanFiles> find_scan_files(const fs::path& folder, std::optional<Format> forced) {
  for (const std::string_view below : kFoldersOfDataSets) {
    const fs::path place = below.empty() ? folder : folder / below;
    std::error_code ignored;
    if (!below.empty() && !fs::is_directory(place, ignored)) continue;
    auto listed = list_folder(place);
    if (!listed) return Unexpected(listed.error());
    auto files = choose_kind(place, std::move(*listed), forced);
    if (!files) return Unexpected(files.error());
    if (files->empty()) continue;
    std::sort(files->begin(), files->end(), [](const fs::path& a, const fs::path& b) {
      return natural_less(a.filename().native(), b.filename().native());
    });
    return ScanFiles{place, std::move(*files)};
  }
  return Unexpected(
      {ErrorCode::kUnusable,
       folder.string(),
       {},
       "folder has no scans",
       {},
       forced ? fmt::format("files {}", kind_of(*forced)) : "files .bin, .pcd.bin, .pcd, .ply or .csv"});
}

}  // namespace verge::io
