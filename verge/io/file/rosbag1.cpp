// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/rosbag1.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/chunk.hpp"
#include "verge/io/file/chunked_bag.hpp"
#include "verge/io/file/ros_messages.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

constexpr std::string_view kVersion2 = "#ROSBAG V2.0\n";
constexpr std::uint64_t kLength = 4;                   // of the lengths before a record's header and data
constexpr std::uint64_t kMostHeaderBytes = 1U << 20U;  // reliability B2
constexpr std::uint64_t kMostDefinitionBytes = 64U << 20U;

/// The "op" field of a record's header.
enum class BagOp : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7,
};

/// Fields "name=value" of a record's header, each with its length before it; views into the header's bytes.
class HeaderFields {
 public:
  /// None where a field is longer than the header or has no '='.
  [[nodiscard]] static std::optional<HeaderFields> of(Bytes header) {
    HeaderFields out;
    while (!header.empty()) {
      if (header.size() < kLength) return std::nullopt;
      const auto length = load_le<std::uint32_t>(header, 0);
      if (length > header.size() - kLength) return std::nullopt;
      const std::string_view field = as_text(header.subspan(kLength, length));
      const auto equals = field.find('=');
      if (equals == std::string_view::npos) return std::nullopt;
      out.fields_[field.substr(0, equals)] = field.substr(equals + 1);
      header = header.subspan(kLength + length);
    }
    return out;
  }

  [[nodiscard]] std::optional<std::string_view> text(std::string_view name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) return std::nullopt;
    return found->second;
  }
  template <class T>
  [[nodiscard]] std::optional<T> number(std::string_view name) const {
    const auto value = text(name);
    if (!value || value->size() != sizeof(T)) return std::nullopt;
    return load_le<T>(std::as_bytes(std::span(*value)), 0);
  }
  [[nodiscard]] std::optional<BagOp> op() const {
    const auto value = number<std::uint8_t>("op");
    if (!value) return std::nullopt;
    return static_cast<BagOp>(*value);
  }

 private:
  std::map<std::string_view, std::string_view> fields_;
};

/// A record: its header's and its data's place, in the file or in a chunk.
struct Record {
  std::uint64_t at = 0;
  std::uint64_t header_bytes = 0;
  std::uint64_t data_bytes = 0;

  [[nodiscard]] std::uint64_t header_at() const { return at + kLength; }
  [[nodiscard]] std::uint64_t data_at() const { return at + 2 * kLength + header_bytes; }
  [[nodiscard]] std::uint64_t end() const { return data_at() + data_bytes; }
};

class Rosbag1 final : public ChunkedBag<Record> {
 public:
  explicit Rosbag1(Input input) : ChunkedBag(std::move(input), kVersion2.size()) {}

  /// Finds the topics and goes to the first record.
  [[nodiscard]] Expected<void> open();

 private:
  [[nodiscard]] Expected<void> read_bag_header();
  [[nodiscard]] Expected<bool> read_index();

  [[nodiscard]] Expected<Record> record_at(std::uint64_t at) override;
  [[nodiscard]] std::uint64_t end_of(const Record& record) const override { return record.end(); }
  [[nodiscard]] bool ends_data(const Record& /*record*/) const override { return false; }
  [[nodiscard]] Expected<std::optional<Message>> read_record(const Record& record) override;
  [[nodiscard]] Expected<std::optional<Message>> next_in_chunk() override;
  [[nodiscard]] Expected<std::optional<Message>> end() override;
  [[nodiscard]] Expected<void> read_connection(const Record& record, std::string header);
  [[nodiscard]] Expected<std::optional<Message>> read_message(const Record& record,
                                                              const HeaderFields& fields);
  [[nodiscard]] Expected<Chunk> unpack_chunk(const Record& record, const HeaderFields& fields);
  [[nodiscard]] Expected<std::optional<Message>> read_in_chunk(const Record& record);
  [[nodiscard]] std::optional<Record> record_in_chunk() const;
  [[nodiscard]] Expected<Message> message_of(const HeaderFields& fields, Bytes data, Place place) const;
  [[nodiscard]] bool define(const HeaderFields& fields, Bytes data);
  [[nodiscard]] bool count_messages(Bytes chunk_info);

  Buffer unpacked_;
  std::uint64_t index_at_ = 0;                        // of the index; 0: the bag was not closed
  std::map<std::uint32_t, std::size_t> connections_;  // index of the topic
};

/// The topic of a connection: its name stands in the record's header, the rest in its data.
Topic topic_of(std::string_view name, const HeaderFields& data) {
  Topic out;
  out.wire = Wire::kRos1;
  out.name = name;
  out.type = data.text("type").value_or("");
  const std::string_view sum = data.text("md5sum").value_or("");
  const std::string_view known = md5_of(out.type);
  if (!known.empty() && sum != known && sum != "*")
    out.unusable = fmt::format("another definition, MD5 {}", sum.substr(0, known.size()));
  return out;
}

/// A connection; false where something in it is missing.
bool Rosbag1::define(const HeaderFields& fields, Bytes data) {
  const auto id = fields.number<std::uint32_t>("conn");
  const auto name = fields.text("topic");
  const auto header = HeaderFields::of(data);
  if (!id || !name || !header) return false;
  connections_[*id] = find_or_add(topics_, topic_of(*name, *header));
  return true;
}

Expected<Record> Rosbag1::record_at(std::uint64_t at) {
  const auto too_long = [&](const char* what, std::uint64_t got, std::uint64_t need) {
    return Unexpected(error({{}, at}, what, fmt::format("{} B", got), fmt::format("<= {} B", need)));
  };
  const std::uint64_t left = input_.size() - at;
  if (left < 2 * kLength) return too_long("file ends in a record's length", 2 * kLength, left);
  const auto header_length = input_.read(at, kLength);
  if (!header_length) return Unexpected(header_length.error());
  Record record{at, load_le<std::uint32_t>(*header_length, 0), 0};
  const std::uint64_t most = std::min(kMostHeaderBytes, left - 2 * kLength);
  if (record.header_bytes > most)
    return too_long("header of a record is too long", record.header_bytes, most);
  const auto data_length = input_.read(record.header_at() + record.header_bytes, kLength);
  if (!data_length) return Unexpected(data_length.error());
  record.data_bytes = load_le<std::uint32_t>(*data_length, 0);
  const std::uint64_t room = left - 2 * kLength - record.header_bytes;
  if (record.data_bytes > room)
    return too_long("record is longer than what is left of the file", record.data_bytes, room);
  return record;
}

/// The first record: where the index is.
Expected<void> Rosbag1::read_bag_header() {
  const auto record = record_at(progress_.at);
  if (!record) return Unexpected(record.error());
  const auto header = input_.read(record->header_at(), record->header_bytes);
  if (!header) return Unexpected(header.error());
  const auto fields = HeaderFields::of(*header);
  const auto index_at =
      fields && fields->op() == BagOp::kBagHeader ? fields->number<std::uint64_t>("index_pos") : std::nullopt;
  if (!index_at) return Unexpected(error({{}, record->at}, "bag begins without its header"));
  index_at_ = *index_at;
  return {};
}

/// Counts of the messages of a chunk, by connection.
bool Rosbag1::count_messages(Bytes chunk_info) {
  constexpr std::size_t kEntry = 8;
  for (; chunk_info.size() >= kEntry; chunk_info = chunk_info.subspan(kEntry)) {
    const auto connection = connections_.find(load_le<std::uint32_t>(chunk_info, 0));
    if (connection == connections_.end()) return false;
    topics_[connection->second].messages += load_le<std::uint32_t>(chunk_info, 4);
  }
  return chunk_info.empty();
}

/// Connections and counts of the index; false where there is no index to trust: then the file is read
/// through.
Expected<bool> Rosbag1::read_index() {
  if (index_at_ < kVersion2.size() || index_at_ >= input_.size()) return false;
  for (std::uint64_t at = index_at_; at < input_.size();) {
    const auto record = record_at(at);
    if (!record || record->data_bytes > kMostDefinitionBytes) return false;
    const auto header = input_.read(record->header_at(), record->header_bytes);
    if (!header) return Unexpected(header.error());
    const std::string kept(as_text(*header));
    const auto fields = HeaderFields::of(std::as_bytes(std::span(kept)));
    const auto data = input_.read(record->data_at(), record->data_bytes);
    if (!data) return Unexpected(data.error());
    if (!fields || !fields->op()) return false;
    const bool is_connection = *fields->op() == BagOp::kConnection;
    if (!is_connection && *fields->op() != BagOp::kChunkInfo) return false;
    if (!(is_connection ? define(*fields, *data) : count_messages(*data))) return false;
    at = record->end();
  }
  return !topics_.empty();
}

Expected<void> Rosbag1::open() {
  const auto magic = input_.head(kVersion2.size());
  if (!magic) return Unexpected(magic.error());
  if (as_text(*magic) != kVersion2) {
    const std::string_view got = as_text(*magic);
    return Unexpected(input_.error_at(ErrorCode::kUnusable, 0, "no ROS 1 bag of version 2.0",
                                      std::string(got.substr(0, got.find('\n'))), "#ROSBAG V2.0"));
  }
  if (auto header = read_bag_header(); !header) {
    header.error().code = ErrorCode::kUnusable;
    return header;
  }
  const auto index = read_index();
  if (!index) return Unexpected(index.error());
  if (*index) return {};
  connections_.clear();
  return survey();
}

Expected<std::optional<Message>> Rosbag1::end() {
  if (index_at_ == 0) return Unexpected(error({{}, input_.size()}, "bag was not closed: it has no index"));
  if (index_at_ > input_.size()) {
    return Unexpected(error({{}, input_.size()}, "bag ends before its index",
                            fmt::format("{} B", input_.size()), fmt::format("> {} B", index_at_)));
  }
  return std::nullopt;
}

Expected<Message> Rosbag1::message_of(const HeaderFields& fields, Bytes data, Place place) const {
  const auto id = fields.number<std::uint32_t>("conn");
  const auto time = fields.number<std::uint64_t>("time");
  if (!id || !time) return Unexpected(error(place, "message has no connection or no time"));
  const auto connection = connections_.find(*id);
  if (connection == connections_.end())
    return Unexpected(error(place, "message of an unknown connection", fmt::format("{}", *id)));
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  const auto seconds = static_cast<std::int64_t>(*time & 0xFFFF'FFFFU);
  const auto nanoseconds = static_cast<std::int64_t>(*time >> 32U);
  return Message{connection->second, seconds * kNanoseconds + nanoseconds, data, std::move(place)};
}

/// A message outside of chunks; its data are read only where somebody wants them.
Expected<std::optional<Message>> Rosbag1::read_message(const Record& record, const HeaderFields& fields) {
  auto message = message_of(fields, {}, {{}, record.data_at()});
  if (!message) return Unexpected(std::move(message).error());
  if (!topics_[message->topic].wanted) return *std::move(message);
  const auto data = input_.read(record.data_at(), record.data_bytes);
  if (!data) return Unexpected(data.error());
  message->data = *data;
  return *std::move(message);
}

/// `header` are the bytes that the fields look into: reading the data overwrites the input's own.
Expected<void> Rosbag1::read_connection(const Record& record, std::string header) {
  const auto fields = HeaderFields::of(std::as_bytes(std::span(header)));
  if (record.data_bytes > kMostDefinitionBytes) {
    return Unexpected(input_.error_at(ErrorCode::kLimit, record.at, "connection is too long",
                                      fmt::format("{} B", record.data_bytes),
                                      fmt::format("<= {} B", kMostDefinitionBytes)));
  }
  const auto data = input_.read(record.data_at(), record.data_bytes);
  if (!data) return Unexpected(data.error());
  if (fields && define(*fields, *data)) return {};
  return Unexpected(error({{}, record.at}, "connection is damaged"));
}

Expected<Rosbag1::Chunk> Rosbag1::unpack_chunk(const Record& record, const HeaderFields& fields) {
  const auto packing = fields.text("compression");
  const auto size = fields.number<std::uint32_t>("size");
  if (!packing || !size) return Unexpected(error({{}, record.at}, "chunk has no compression or no size"));
  const auto records =
      read_chunk(input_, {record.data_at(), record.data_bytes, *size, std::string(*packing)}, unpacked_);
  if (!records) return Unexpected(records.error());
  return Chunk{*records, record.data_at()};
}

/// The next record of the chunk; none where it does not fit what is left.
std::optional<Record> Rosbag1::record_in_chunk() const {
  const Bytes left = progress_.chunk.subspan(static_cast<std::size_t>(progress_.chunk_at));
  if (left.size() < 2 * kLength) return std::nullopt;
  Record record{progress_.chunk_at, load_le<std::uint32_t>(left, 0), 0};
  if (record.header_bytes > std::min<std::uint64_t>(kMostHeaderBytes, left.size() - 2 * kLength))
    return std::nullopt;
  record.data_bytes = load_le<std::uint32_t>(left, static_cast<std::size_t>(kLength + record.header_bytes));
  if (record.data_bytes > left.size() - 2 * kLength - record.header_bytes) return std::nullopt;
  return record;
}

Expected<std::optional<Message>> Rosbag1::read_in_chunk(const Record& record) {
  const auto part = [&](std::uint64_t at, std::uint64_t length) {
    return progress_.chunk.subspan(static_cast<std::size_t>(at), static_cast<std::size_t>(length));
  };
  const Place place{progress_.chunk_place, record.at};
  const auto fields = HeaderFields::of(part(record.header_at(), record.header_bytes));
  if (!fields || !fields->op()) return Unexpected(error(place, "record has no operation"));
  const Bytes data = part(record.data_at(), record.data_bytes);
  if (*fields->op() == BagOp::kConnection && !define(*fields, data))
    return Unexpected(error(place, "connection is damaged"));
  if (*fields->op() != BagOp::kMessage) return std::nullopt;
  auto message = message_of(*fields, data, {progress_.chunk_place, record.data_at()});
  if (!message) return Unexpected(std::move(message).error());
  return *std::move(message);
}

Expected<std::optional<Message>> Rosbag1::next_in_chunk() {
  Progress& p = progress_;
  while (p.chunk_at < p.chunk.size()) {
    ++p.records;
    const auto record = record_in_chunk();
    if (!record) {
      p.in_chunk = false;
      ++p.bad_records;
      return Unexpected(
          error({p.chunk_place, p.chunk_at}, "record is longer than what is left of its chunk"));
    }
    p.chunk_at = record->end();
    auto message = read_in_chunk(*record);
    if (!message) ++p.bad_records;
    if (!message || *message) return message;
  }
  p.in_chunk = false;
  return std::nullopt;
}

Expected<std::optional<Message>> Rosbag1::read_record(const Record& record) {
  const auto bytes = input_.read(record.header_at(), record.header_bytes);
  if (!bytes) return Unexpected(bytes.error());
  const auto fields = HeaderFields::of(*bytes);
  if (!fields || !fields->op()) return Unexpected(error({{}, record.at}, "record has no operation"));
  Expected<void> read;
  switch (*fields->op()) {
    case BagOp::kMessage:
      return read_message(record, *fields);
    case BagOp::kChunk:
      read = enter_chunk(unpack_chunk(record, *fields));
      break;
    case BagOp::kConnection:
      read = read_connection(record, std::string(as_text(*bytes)));
      break;
    default:
      break;  // the bag's header, indexes and what later versions bring
  }
  if (!read) return Unexpected(std::move(read).error());
  return std::nullopt;
}

}  // namespace

Expected<std::unique_ptr<Bag>> open_rosbag1_bag(Input input) {
  return open_bag_as<Rosbag1>(std::move(input));
}

Expected<std::unique_ptr<Recording>> open_rosbag1(Input input, const RecordingOptions& options) {
  return scans_of(open_rosbag1_bag(std::move(input)), options);
}

}  // namespace verge::io
