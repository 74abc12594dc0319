// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/file/bag.hpp"
#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// What the recordings share whose records stand one behind the other, some of them chunks that hold (packed)
/// records: ROS 1 bags and MCAP. The format says where a record lies (`Record`) and what it holds.
template <class Record>
class ChunkedBag : public Bag {
 public:
  /// `first`: where the first record of the file begins.
  ChunkedBag(Input input, std::uint64_t first) : input_(std::move(input)), first_(first) { rewind(); }

  [[nodiscard]] std::vector<Topic>& topics() final { return topics_; }
  [[nodiscard]] const std::string& name() const final { return input_.name(); }
  [[nodiscard]] Expected<void> allow(std::uint64_t points) const final { return input_.allow(points, 0); }
  [[nodiscard]] Expected<std::optional<Message>> next() final;
  [[nodiscard]] std::vector<Counter> counters() const final;

 protected:
  /// How far the file is read.
  struct Progress {
    std::uint64_t at = 0;  ///< Next record of the file.
    bool ended = false;
    bool in_chunk = false;
    Bytes chunk;                 ///< Records of the chunk that is read.
    std::uint64_t chunk_at = 0;  ///< Next record in it.
    std::string chunk_place;
    std::uint64_t chunks = 0, bad_chunks = 0;
    std::uint64_t records = 0, bad_records = 0;
  };

  /// Records of a chunk, and where they stand in the file.
  struct Chunk {
    Bytes records;
    std::uint64_t at = 0;
  };

  /// The record at `at`, its length checked against what is left of the file.
  [[nodiscard]] virtual Expected<Record> record_at(std::uint64_t at) = 0;
  [[nodiscard]] virtual std::uint64_t end_of(const Record& record) const = 0;
  /// Whether the data end before this record.
  [[nodiscard]] virtual bool ends_data(const Record& record) const = 0;
  /// A record of the file: its message if it is one.
  [[nodiscard]] virtual Expected<std::optional<Message>> read_record(const Record& record) = 0;
  /// The next message of the chunk that is read; none behind its last.
  [[nodiscard]] virtual Expected<std::optional<Message>> next_in_chunk() = 0;
  /// The end of the data: an error where the file was not closed.
  [[nodiscard]] virtual Expected<std::optional<Message>> end() = 0;

  /// Reads the file through for its topics and how many messages each has; what was known of them before is
  /// to be forgotten. Where there are none and the file is damaged, the damage is why.
  [[nodiscard]] Expected<void> survey();
  /// Goes on with the records of a chunk, or counts it as bad.
  [[nodiscard]] Expected<void> enter_chunk(Expected<Chunk> chunk);
  [[nodiscard]] Error error(const Place& place, std::string what, std::string got = {},
                            std::string need = {}) const;

  Input input_;
  Progress progress_;
  std::vector<Topic> topics_;

 private:
  void rewind() {
    progress_ = {};
    progress_.at = first_;
  }

  std::uint64_t first_;
};

template <class Record>
Expected<std::optional<Message>> ChunkedBag<Record>::next() {
  Progress& p = progress_;
  while (!p.ended) {
    if (p.in_chunk) {
      auto message = next_in_chunk();
      if (!message || *message) return message;
      continue;
    }
    if (p.at == input_.size()) {
      p.ended = true;
      return end();
    }
    const auto record = record_at(p.at);
    if (!record) {  // nothing says where the next record begins
      p.ended = true;
      ++p.records;
      ++p.bad_records;
      return Unexpected(record.error());
    }
    if (ends_data(*record)) {
      p.ended = true;
      return end();
    }
    p.at = end_of(*record);
    ++p.records;
    auto message = read_record(*record);
    if (!message) ++p.bad_records;
    if (!message || *message) return message;
  }
  return std::nullopt;
}

template <class Record>
std::vector<Counter> ChunkedBag<Record>::counters() const {
  const Progress& p = progress_;
  return {{"records received", p.records},          {"records used", p.records - p.bad_records},
          {"records rejected", p.bad_records},      {"chunks received", p.chunks},
          {"chunks used", p.chunks - p.bad_chunks}, {"chunks rejected", p.bad_chunks}};
}

template <class Record>
Expected<void> ChunkedBag<Record>::survey() {
  topics_.clear();
  std::optional<Error> trouble;
  while (!progress_.ended) {
    const auto message = next();
    if (message && *message) ++topics_[(*message)->topic].messages;
    if (!message && !trouble) trouble = message.error();
  }
  rewind();
  return nothing_but_damage(topics_, trouble);
}

template <class Record>
Expected<void> ChunkedBag<Record>::enter_chunk(Expected<Chunk> chunk) {
  Progress& p = progress_;
  ++p.chunks;
  if (!chunk) {
    ++p.bad_chunks;
    return Unexpected(std::move(chunk).error());
  }
  p.in_chunk = true;
  p.chunk = chunk->records;
  p.chunk_at = 0;
  p.chunk_place = fmt::format("{}", chunk->at);
  return {};
}

template <class Record>
Error ChunkedBag<Record>::error(const Place& place, std::string what, std::string got,
                                std::string need) const {
  return {ErrorCode::kDamaged, input_.name(),  place.where(),
          std::move(what),     std::move(got), std::move(need)};
}

/// A file as `Format`, a bag that is made of the file and opened: Expected<void> open().
template <class Format>
[[nodiscard]] Expected<std::unique_ptr<Bag>> open_bag_as(Input input) {
  auto bag = std::make_unique<Format>(std::move(input));
  if (auto opened = bag->open(); !opened) return Unexpected(std::move(opened).error());
  return bag;
}

}  // namespace verge::io
