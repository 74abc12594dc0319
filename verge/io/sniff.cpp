// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/sniff.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "verge/io/file/alasca_stream.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/file/floats.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/file/rosbag1.hpp"
#include "verge/io/formats.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

constexpr std::uint64_t kLook = 64ULL << 10U;

/// Something that packs files, which we do not unpack.
struct Packer {
  std::string_view magic;
  std::string_view name;
  std::string_view undo;  ///< The command that unpacks.
};

std::optional<Packer> packer_of(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::array<Packer, 5> kPackers{{{"\x1F\x8B"sv, "gzip", "gunzip"},
                                            {"BZh"sv, "bzip2", "bunzip2"},
                                            {"\xFD"
                                             "7zXZ\0"sv,
                                             "xz", "unxz"},
                                            {"\x28\xB5\x2F\xFD"sv, "zstd", "zstd -d"},
                                            {"PK\x03\x04"sv, "zip", "unzip"}}};
  const auto* found = std::find_if(kPackers.begin(), kPackers.end(),
                                   [&](const Packer& packer) { return head.starts_with(packer.magic); });
  if (found == kPackers.end()) return std::nullopt;
  return *found;
}

bool is_utf16(std::string_view head) { return head.starts_with("\xFF\xFE") || head.starts_with("\xFE\xFF"); }

bool is_ply(std::string_view head) {
  return head.starts_with("ply\n") || head.starts_with("ply\r") || head == "ply";
}

/// A PCD file begins with its comment or, without it, with one of its first entries.
bool is_pcd(std::string_view head) {
  LineReader lines(head);
  while (const auto line = lines.next()) {
    if (line->starts_with('#') && line->substr(0, 64).find(".PCD") != std::string_view::npos) return true;
    if (line->empty() || line->front() == '#') continue;
    return line->starts_with("VERSION ") || line->starts_with("FIELDS ") || line->starts_with("COLUMNS ");
  }
  return false;
}

/// What the two .bin formats have for them.
struct BinCheck {
  RowCheck kitti;
  RowCheck nuscenes;
  bool kitti_size = false;
  bool nuscenes_size = false;

  [[nodiscard]] bool is_kitti() const { return kitti.plausible() && kitti.has_intensities(); }
  [[nodiscard]] bool is_nuscenes() const { return nuscenes.plausible() && nuscenes.has_rings(); }
  [[nodiscard]] bool beyond_doubt() const {
    return (is_kitti() && kitti_size && kitti.all_coordinates()) ||
           (is_nuscenes() && nuscenes_size && nuscenes.all_coordinates());
  }
};

BinCheck check_bin(const Input& input, Bytes head) {
  return {check_rows(head, 4), check_rows(head, 5), input.size() % 16 == 0, input.size() % 20 == 0};
}

/// By the names that the two data sets give their files and folders.
std::optional<Format> bin_by_name(const std::filesystem::path& path) {
  if (scan_suffix(path) == ".pcd.bin") return Format::kNuscenes;
  for (const std::filesystem::path& part : path.parent_path()) {
    if (part == "velodyne" || part == "velodyne_points") return Format::kKitti;
    if (part == "LIDAR_TOP") return Format::kNuscenes;
  }
  return std::nullopt;
}

Expected<Format> choose_bin(const Input& input, const BinCheck& check, std::optional<Format> neighbours) {
  if (check.is_kitti() != check.is_nuscenes()) return check.is_kitti() ? Format::kKitti : Format::kNuscenes;
  if (check.kitti_size != check.nuscenes_size) return check.kitti_size ? Format::kKitti : Format::kNuscenes;
  if (const auto named = bin_by_name(input.name())) return *named;
  if (neighbours) return *neighbours;
  if (!check.kitti_size) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, input.size() - input.size() % sizeof(float),
                                     "size is not a whole number of points",
                                     fmt::format("{} B", input.size()),
                                     "a multiple of 16 B (kitti) or 20 B (nuscenes)"));
  }
  if (check.is_kitti()) {
    return Unexpected(
        input.error_at(ErrorCode::kUsage, 0, "kitti and nuscenes fit alike: choose the format"));
  }
  return 2 * check.nuscenes.rings >= check.nuscenes.rows ? Format::kNuscenes : Format::kKitti;
}

/// pcap in both orders of bytes, with microseconds or nanoseconds, and pcapng.
bool is_pcap(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::array kMagics{"\xD4\xC3\xB2\xA1"sv, "\xA1\xB2\xC3\xD4"sv, "\x4D\x3C\xB2\xA1"sv,
                               "\xA1\xB2\x3C\x4D"sv, "\x0A\x0D\x0D\x0A"sv};
  return std::any_of(kMagics.begin(), kMagics.end(),
                     [&](std::string_view magic) { return head.starts_with(magic); });
}

/// By the bytes that every file of the format begins with, or that its messages begin with.
std::optional<Format> format_of_magic(Bytes head) {
  const std::string_view text = as_text(head);
  if (is_ply(text)) return Format::kPly;
  if (is_pcd(text)) return Format::kPcd;
  if (text.starts_with("LASF")) return Format::kLas;
  if (is_pcap(text)) return Format::kPcap;
  if (text.starts_with(kRosbag1Magic)) return Format::kBag;
  if (text.starts_with("SQLite format 3")) return Format::kDb3;
  if (text.starts_with("\x89MCAP")) return Format::kMcap;
  // These have no header of their own: last, since a capture may hold their messages.
  if (is_ibeo(head)) return Format::kIbeo;
  if (is_alasca(head)) return Format::kAlasca;
  if (looks_like_table(text)) return Format::kCsv;
  return std::nullopt;
}

}  // namespace

std::string scan_suffix(const std::filesystem::path& path) {
  const auto format = format_of_name(path);
  if (!format || facts_of(*format).many_scans) return {};
  return std::string(facts_of(*format).suffix);
}

std::string frame_name(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::string suffix = scan_suffix(path);
  return suffix.empty() ? path.stem().string() : name.substr(0, name.size() - suffix.size());
}

bool name_lies(const std::filesystem::path& path, Format format) {
  const auto named = format_of_name(path);
  if (!named) return false;
  // .bin says no more than that it is binary.
  const bool bin = *named == Format::kKitti || *named == Format::kNuscenes;
  const bool is_bin = format == Format::kKitti || format == Format::kNuscenes || facts_of(format).many_scans;
  return bin ? !is_bin : *named != format;
}

Expected<Format> sniff(Input& input, std::optional<Format> bin) {
  if (input.size() == 0) return Unexpected(input.error_at(ErrorCode::kUnusable, 0, "is empty"));
  const auto bytes = input.head(kLook);
  if (!bytes) return Unexpected(bytes.error());
  const std::string_view head = as_text(*bytes);
  if (const auto format = format_of_magic(*bytes)) return *format;
  const auto named = format_of_name(input.name());
  const BinCheck check = check_bin(input, *bytes);
  if (check.beyond_doubt()) return choose_bin(input, check, bin);
  if (const auto packer = packer_of(head)) {
    return Unexpected(input.error_at(
        ErrorCode::kUnusable, 0,
        fmt::format("is compressed with {}: unpack it first ({})", packer->name, packer->undo)));
  }
  if (is_utf16(head)) {
    return Unexpected(
        input.error_at(ErrorCode::kUnusable, 0, "is UTF-16 text", "a UTF-16 byte order mark", "UTF-8"));
  }
  if (named == Format::kKitti || named == Format::kNuscenes) return choose_bin(input, check, bin);
  if (named) return *named;  // its reader says what is wrong
  return Unexpected(input.error_at(ErrorCode::kUnusable, 0, "no known format fits", {},
                                   fmt::format("{}", fmt::join(enum_names<Format>, ", "))));
}

}  // namespace verge::io
