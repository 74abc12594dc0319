// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/raster/blocks.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

#include "verge/core/bytes.hpp"

namespace verge::raster {
namespace {

/// The marks of a picture, a bit each, background beyond its right and lower edge.
class MarkBits {
 public:
  explicit MarkBits(const Picture& picture)
      : words_(static_cast<std::size_t>(picture.cols) / 64 + 2),
        bits_(words_ * (static_cast<std::size_t>(picture.rows) + kBlockSides.front())) {
    for (int row = 0; row < picture.rows; ++row) take_row(picture, row);
  }

  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] std::uint64_t word(int row, std::size_t i) const { return bits_[begin(row) + i]; }

  [[nodiscard]] bool is_full(int col, int row, int side) const {
    std::uint64_t all = mask(side);
    for (int r = row; r < row + side; ++r) all &= window(r, col);
    return all == mask(side);
  }

  void clear(int col, int row, int side) {
    const std::size_t i = static_cast<std::size_t>(col) / 64;
    const int shift = col % 64;
    for (int r = row; r < row + side; ++r) {
      bits_[begin(r) + i] &= ~(mask(side) << shift);
      if (shift + side > 64) bits_[begin(r) + i + 1] &= ~(mask(side) >> (64 - shift));
    }
  }

 private:
  static std::uint64_t mask(int side) { return (std::uint64_t{1} << side) - 1; }
  [[nodiscard]] std::size_t begin(int row) const { return words_ * static_cast<std::size_t>(row); }

  void take_row(const Picture& picture, int row) {
    const Bytes pixels = std::as_bytes(std::span(picture.grey)).subspan(picture.index(row, 0));
    const auto cols = static_cast<std::size_t>(picture.cols);
    std::size_t col = 0;
    for (; col + 8 <= cols; col += 8) {
      const auto eight = load_le<std::uint64_t>(pixels, col);
      if (eight != 0) bits_[begin(row) + col / 64] |= marks_of(eight) << (col % 64);
    }
    for (; col < cols; ++col) {
      const std::uint64_t mark = pixels[col] != std::byte{0} ? 1 : 0;
      bits_[begin(row) + col / 64] |= mark << (col % 64);
    }
  }

  /// A bit for each of eight pixels, the first one's lowest.
  static std::uint64_t marks_of(std::uint64_t eight) {
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    const std::uint64_t high = (((eight & kLow) + kLow) | eight) & ~kLow;  // of each byte that is not 0
    return (high >> 7U) * 0x0102040810204080 >> 56U;                       // gathered in the highest byte
  }

  /// 64 pixels from that one on to the right.
  [[nodiscard]] std::uint64_t window(int row, int col) const {
    const std::size_t i = begin(row) + static_cast<std::size_t>(col) / 64;
    const int shift = col % 64;
    return shift == 0 ? bits_[i] : bits_[i] >> shift | bits_[i + 1] << (64 - shift);
  }

  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// Takes the largest block that has its upper left pixel there.
void take_block(MarkBits& marks, int col, int row, Blocks& blocks) {
  std::size_t size = 0;
  while (!marks.is_full(col, row, kBlockSides.at(size))) ++size;
  marks.clear(col, row, kBlockSides.at(size));
  blocks.at(size).push_back({static_cast<std::int16_t>(col), static_cast<std::int16_t>(row)});
}

/// Dealt out in so many hands that follow each other, so that neighbours come apart.
std::vector<BlockCorner> dealt(const std::vector<BlockCorner>& blocks) {
  constexpr std::size_t kHands = 8;
  const std::size_t hand = (blocks.size() + kHands - 1) / kHands;
  std::vector<BlockCorner> out;
  out.reserve(blocks.size());
  for (std::size_t first = 0; first < hand; ++first) {
    for (std::size_t i = first; i < blocks.size(); i += hand) out.push_back(blocks[i]);
  }
  return out;
}

}  // namespace

Blocks blocks_of(const Picture& picture) {
  MarkBits marks(picture);
  Blocks blocks;
  for (int row = 0; row < picture.rows; ++row) {
    for (std::size_t i = 0; i < marks.words(); ++i) {
      while (marks.word(row, i) != 0) {
        take_block(marks, static_cast<int>(64 * i) + std::countr_zero(marks.word(row, i)), row, blocks);
      }
    }
  }
  for (std::vector<BlockCorner>& list : blocks) list = dealt(list);
  return blocks;
}

}  // namespace verge::raster
