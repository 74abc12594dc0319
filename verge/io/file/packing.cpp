// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/packing.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <memory>
#include <utility>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include "verge/io/text.hpp"

namespace verge::io {
namespace {

bool copy_whole(Bytes bytes, std::span<std::byte> out) {
  if (bytes.size() != out.size()) return false;
  std::copy(bytes.begin(), bytes.end(), out.begin());
  return true;
}

bool unpack_lz4(Bytes packed, std::span<std::byte> out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, &LZ4F_freeDecompressionContext);
  std::size_t hint = 1;
  while (hint != 0) {  // 0: the frame is complete
    std::size_t written = out.size();
    std::size_t taken = packed.size();
    hint = LZ4F_decompress(context.get(), out.data(), &written, packed.data(), &taken, nullptr);
    if (LZ4F_isError(hint) != 0 || (written == 0 && taken == 0)) break;
    out = out.subspan(written);
    packed = packed.subspan(taken);
  }
  return hint == 0 && out.empty() && packed.empty();
}

bool unpack_zstd(Bytes packed, std::span<std::byte> out) {
  return ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()) == out.size();
}

bool unpack_bz2(Bytes packed, std::span<std::byte> out) {
  if (packed.size() > std::numeric_limits<unsigned>::max() ||
      out.size() > std::numeric_limits<unsigned>::max()) {
    return false;
  }
  auto written = static_cast<unsigned>(out.size());
  // The library does not write into its source, it only lacks the const.
  auto* source = reinterpret_cast<char*>(const_cast<std::byte*>(packed.data()));  // NOLINT(*-const-cast)
  return BZ2_bzBuffToBuffDecompress(reinterpret_cast<char*>(out.data()), &written, source,
                                    static_cast<unsigned>(packed.size()), 0, 0) == BZ_OK &&
         written == out.size();
}

std::string pack_zstd(Bytes bytes) {
  constexpr int kLevel = 3;  // the library's own default
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  assert(ZSTD_isError(size) == 0);  // the bound makes room enough
  out.resize(size);
  return out;
}

std::string pack_lz4(Bytes bytes) {
  LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
  preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
  std::string out(LZ4F_compressFrameBound(bytes.size(), &preferences), '\0');
  const std::size_t size =
      LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences);
  assert(LZ4F_isError(size) == 0);
  out.resize(size);
  return out;
}

}  // namespace

std::optional<Packing> packing_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Packing>, 5> kNames{{{"", Packing::kNone},
                                                                        {"none", Packing::kNone},
                                                                        {"lz4", Packing::kLz4},
                                                                        {"zstd", Packing::kZstd},
                                                                        {"bz2", Packing::kBz2}}};
  const auto found =
      std::find_if(kNames.begin(), kNames.end(), [&](const auto& known) { return known.first == name; });
  if (found == kNames.end()) return std::nullopt;
  return found->second;
}

bool is_zstd(Bytes bytes) {
  constexpr std::string_view kMagic = "\x28\xB5\x2F\xFD";
  return as_text(bytes).starts_with(kMagic);
}

std::optional<std::uint64_t> zstd_size(Bytes packed) {
  const std::uint64_t size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR) return std::nullopt;
  return size;
}

bool unpack(Packing packing, Bytes packed, std::span<std::byte> out) {
  switch (packing) {
    case Packing::kNone:
      return copy_whole(packed, out);
    case Packing::kLz4:
      return unpack_lz4(packed, out);
    case Packing::kZstd:
      return unpack_zstd(packed, out);
    case Packing::kBz2:
      break;
  }
  return unpack_bz2(packed, out);
}

std::string pack(Packing packing, Bytes bytes) {
  assert(packing != Packing::kBz2);
  if (packing == Packing::kZstd) return pack_zstd(bytes);
  if (packing == Packing::kLz4) return pack_lz4(bytes);
  return std::string(as_text(bytes));
}

}  // namespace verge::io
