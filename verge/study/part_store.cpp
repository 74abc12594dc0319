// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/part_store.hpp"

#include <fstream>
#include <ios>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "verge/core/atomic_file.hpp"
#include "verge/core/hash.hpp"
#include "verge/study/tally_json.hpp"

namespace verge::study {
namespace {

bool is_plain(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

std::string slug_of(std::string_view name) {
  std::string slug;
  for (const char c : name) {
    if (is_plain(c)) {
      slug += c;
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  constexpr std::size_t kLongest = 100;
  return slug.substr(0, kLongest);
}

/// The tally with a check of its text, so that a bit that flips is seen.
std::string checked(std::string_view tally) {
  return fmt::format("{{\"check\":\"{:016x}\",\"tally\":{}}}\n", fnv1a(tally), tally);
}

std::optional<Tally> tally_in(std::string_view bytes) {
  constexpr std::string_view kBefore = R"({"check":"0123456789abcdef","tally":)";
  constexpr std::string_view kAfter = "}\n";
  if (bytes.size() < kBefore.size() + kAfter.size()) return std::nullopt;
  const std::string_view text = bytes.substr(kBefore.size(), bytes.size() - kBefore.size() - kAfter.size());
  if (bytes != checked(text)) return std::nullopt;
  auto tally = parse_tally(text);
  return tally ? std::optional(*std::move(tally)) : std::nullopt;
}

}  // namespace

std::string PartKey::file_name() const {
  return fmt::format("{}-{:016x}.json", slug_of(name), fnv1a(name + '\n' + settings));
}

Expected<PartStore> PartStore::open(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Unexpected(Error{ErrorCode::kCannotWrite, folder.string(), {}, error.message(), {}, {}});
  PartStore store;
  store.folder_ = folder;
  return store;
}

std::optional<Tally> PartStore::find(const PartKey& key,
                                     const std::function<void(const std::string&)>& warning) const {
  if (!folder_) return std::nullopt;
  const auto path = *folder_ / key.file_name();
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  auto tally = tally_in(bytes);
  if (!tally) warning(fmt::format("{}: is damaged, and is made again", path.string()));
  return tally;
}

Expected<void> PartStore::keep(const PartKey& key, const Tally& tally) const {
  if (!folder_) return {};
  return write_file(*folder_ / key.file_name(), checked(to_json(tally)));
}

}  // namespace verge::study
