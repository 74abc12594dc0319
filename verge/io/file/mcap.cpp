// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/mcap.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/chunk.hpp"
#include "verge/io/file/chunked_bag.hpp"
#include "verge/io/file/crc32.hpp"
#include "verge/io/file/mcap_records.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

constexpr std::uint64_t kMessageHead = 2 + 4 + 8 + 8;       // channel, sequence, log time, publish time
constexpr std::uint64_t kMostDefinitionBytes = 64U << 20U;  // of a schema, a channel, the summary

struct Record {
  McapOp op{};
  std::uint64_t begin = 0;  // of its content
  std::uint64_t length = 0;
};

class McapBag final : public ChunkedBag<Record> {
 public:
  explicit McapBag(Input input) : ChunkedBag(std::move(input), kMcapMagic.size()) {}

  /// Finds the topics and goes to the first record.
  [[nodiscard]] Expected<void> open();

 private:
  [[nodiscard]] Expected<bool> read_summary();
  [[nodiscard]] Expected<std::optional<McapFooter>> read_footer();
  [[nodiscard]] bool add_summary(Bytes summary);

  [[nodiscard]] Expected<Record> record_at(std::uint64_t at) override;
  [[nodiscard]] std::uint64_t end_of(const Record& record) const override {
    return record.begin + record.length;
  }
  [[nodiscard]] bool ends_data(const Record& record) const override {
    return record.op == McapOp::kDataEnd || record.op == McapOp::kFooter;
  }
  [[nodiscard]] Expected<std::optional<Message>> read_record(const Record& record) override;
  [[nodiscard]] Expected<std::optional<Message>> next_in_chunk() override;
  [[nodiscard]] Expected<std::optional<Message>> end() override;
  [[nodiscard]] Expected<void> read_definition(const Record& record);
  [[nodiscard]] Expected<std::optional<Message>> read_message(const Record& record);
  [[nodiscard]] Expected<Chunk> unpack_chunk(const Record& record);
  [[nodiscard]] Expected<std::optional<Message>> leave_chunk(std::string what);
  [[nodiscard]] Expected<Message> message_of(Bytes head, Bytes data, Place place);
  [[nodiscard]] bool define(McapOp op, Bytes content);
  [[nodiscard]] Topic topic_of(const McapChannel& channel) const;

  Buffer unpacked_;
  std::map<std::uint16_t, std::string> schemas_;   // name of the type
  std::map<std::uint16_t, std::size_t> channels_;  // index of the topic
};

Topic McapBag::topic_of(const McapChannel& channel) const {
  Topic out;
  out.name = channel.topic;
  const auto schema = schemas_.find(channel.schema);
  if (schema != schemas_.end()) out.type = schema->second;
  if (channel.encoding == "ros1") {
    out.wire = Wire::kRos1;
  } else if (channel.encoding != "cdr") {
    out.unusable = fmt::format("encoding {}, not cdr or ros1", channel.encoding);
  }
  return out;
}

/// A schema or a channel; false where its content does not fit.
bool McapBag::define(McapOp op, Bytes content) {
  MessageReader reader(Wire::kRos1, content);
  if (op == McapOp::kSchema) {
    McapSchema schema = read_mcap_schema(reader);
    if (!reader.fault()) schemas_[schema.id] = std::move(schema.name);
  } else {
    const McapChannel channel = read_mcap_channel(reader);
    if (!reader.fault()) channels_[channel.id] = find_or_add(topics_, topic_of(channel));
  }
  return !reader.fault();
}

Expected<std::optional<McapFooter>> McapBag::read_footer() {
  constexpr std::uint64_t kFooter = kMcapRecordHead + kMcapFooterBytes;
  if (input_.size() < 2 * kMcapMagic.size() + kFooter) return std::nullopt;
  const auto tail = input_.read(input_.size() - kMcapMagic.size() - kFooter, kFooter + kMcapMagic.size());
  if (!tail) return Unexpected(tail.error());
  const bool is_footer = as_text(*tail).ends_with(kMcapMagic) &&
                         load_le<std::uint8_t>(*tail, 0) == static_cast<std::uint8_t>(McapOp::kFooter) &&
                         load_le<std::uint64_t>(*tail, 1) == kMcapFooterBytes;
  if (!is_footer) return std::nullopt;
  MessageReader reader(Wire::kRos1, tail->subspan(kMcapRecordHead, kMcapFooterBytes));
  return read_mcap_footer(reader);
}

/// The channels and counts of the summary; false where something in it does not fit.
bool McapBag::add_summary(Bytes summary) {
  bool counted = false;
  while (!summary.empty()) {
    if (summary.size() < kMcapRecordHead) return false;
    const auto op = static_cast<McapOp>(summary[0]);
    const auto length = load_le<std::uint64_t>(summary, 1);
    if (length > summary.size() - kMcapRecordHead) return false;
    const Bytes content = summary.subspan(kMcapRecordHead, static_cast<std::size_t>(length));
    summary = summary.subspan(kMcapRecordHead + content.size());
    if ((op == McapOp::kSchema || op == McapOp::kChannel) && !define(op, content)) return false;
    if (op != McapOp::kStatistics) continue;
    MessageReader reader(Wire::kRos1, content);
    static_cast<void>(reader.bytes(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8));  // totals and times
    std::uint32_t bytes = reader.number<std::uint32_t>();
    for (; bytes >= 10 && !reader.fault(); bytes -= 10) {
      const auto channel = channels_.find(reader.number<std::uint16_t>());
      const auto count = reader.number<std::uint64_t>();
      if (channel != channels_.end()) topics_[channel->second].messages += count;
    }
    counted = !reader.fault();
  }
  return counted;
}

/// False where there is no summary to trust: then the file is read through.
Expected<bool> McapBag::read_summary() {
  const auto footer = read_footer();
  if (!footer) return Unexpected(footer.error());
  if (!*footer || (*footer)->summary_start == 0) return false;
  const std::uint64_t begin = (*footer)->summary_start;
  const std::uint64_t end = input_.size() - kMcapMagic.size() - kMcapRecordHead - kMcapFooterBytes;
  // The sum covers the footer too, up to itself.
  constexpr std::uint64_t kSummed = kMcapRecordHead + kMcapFooterBytes - 4;
  if (begin < kMcapMagic.size() || begin > end || end - begin > kMostDefinitionBytes) return false;
  const auto bytes = input_.read(begin, end - begin + kSummed);
  if (!bytes) return Unexpected(bytes.error());
  const std::uint32_t crc = (*footer)->summary_crc;
  if (crc != 0 && crc32(*bytes) != crc) return false;
  return add_summary(bytes->first(static_cast<std::size_t>(end - begin)));
}

Expected<void> McapBag::open() {
  const auto magic = input_.head(kMcapMagic.size());
  if (!magic) return Unexpected(magic.error());
  if (as_text(*magic) != kMcapMagic)
    return Unexpected(input_.error_at(ErrorCode::kUnusable, 0, "no MCAP file"));
  const auto summary = read_summary();
  if (!summary) return Unexpected(summary.error());
  if (*summary) return {};
  schemas_.clear();
  channels_.clear();
  return survey();
}

Expected<std::optional<Message>> McapBag::end() {
  const auto footer = read_footer();
  if (!footer) return Unexpected(footer.error());
  if (*footer) return std::nullopt;
  return Unexpected(error({{}, progress_.at}, "recording was not closed: it has no footer"));
}

Expected<Record> McapBag::record_at(std::uint64_t at) {
  const std::uint64_t left = input_.size() - at;
  if (left < kMcapRecordHead) {
    return Unexpected(error({{}, at}, "file ends in the head of a record", fmt::format("{} B", left),
                            fmt::format(">= {} B", kMcapRecordHead)));
  }
  const auto head = input_.read(at, kMcapRecordHead);
  if (!head) return Unexpected(head.error());
  const Record record{static_cast<McapOp>((*head)[0]), at + kMcapRecordHead,
                      load_le<std::uint64_t>(*head, 1)};
  if (static_cast<std::uint8_t>(record.op) == 0)
    return Unexpected(error({{}, at}, "record has no operation"));
  const std::uint64_t room = left - kMcapRecordHead;
  if (record.length > room) {
    return Unexpected(error({{}, at}, "record is longer than what is left of the file",
                            fmt::format("{} B", record.length), fmt::format("<= {} B", room)));
  }
  return record;
}

Expected<void> McapBag::read_definition(const Record& record) {
  if (record.length > kMostDefinitionBytes) {
    return Unexpected(input_.error_at(ErrorCode::kLimit, record.begin, "definition is too long",
                                      fmt::format("{} B", record.length),
                                      fmt::format("<= {} B", kMostDefinitionBytes)));
  }
  const auto content = input_.read(record.begin, record.length);
  if (!content) return Unexpected(content.error());
  if (define(record.op, *content)) return {};
  return Unexpected(error({{}, record.begin}, "definition of a channel or a schema is damaged"));
}

/// `head` and the data behind it as a message; an error where nobody defined its channel.
Expected<Message> McapBag::message_of(Bytes head, Bytes data, Place place) {
  const auto id = load_le<std::uint16_t>(head, 0);
  const auto channel = channels_.find(id);
  if (channel == channels_.end()) {
    return Unexpected(error(place, "message of a channel that is not defined", fmt::format("{}", id)));
  }
  const auto log_time = load_le<std::uint64_t>(head, 6);
  place.offset += kMessageHead;
  return Message{channel->second, static_cast<std::int64_t>(log_time), data, std::move(place)};
}

/// A message outside of chunks; its data are read only where somebody wants them.
Expected<std::optional<Message>> McapBag::read_message(const Record& record) {
  const Place place{{}, record.begin};
  if (record.length < kMessageHead) return Unexpected(error(place, "message is too short"));
  const auto head = input_.read(record.begin, kMessageHead);
  if (!head) return Unexpected(head.error());
  auto message = message_of(*head, {}, place);
  if (!message) return Unexpected(std::move(message).error());
  if (!topics_[message->topic].wanted) return *std::move(message);
  const auto data = input_.read(record.begin + kMessageHead, record.length - kMessageHead);
  if (!data) return Unexpected(data.error());
  message->data = *data;
  return *std::move(message);
}

Expected<McapBag::Chunk> McapBag::unpack_chunk(const Record& record) {
  constexpr std::uint64_t kMostHead = 8 + 8 + 8 + 4 + 4 + 64 + 8;  // 64: name of the compression
  const auto head = input_.read(record.begin, std::min(record.length, kMostHead));
  if (!head) return Unexpected(head.error());
  MessageReader reader(Wire::kRos1, *head);
  const McapChunk chunk = read_mcap_chunk(reader);
  if (reader.fault()) return Unexpected(error({{}, record.begin}, "head of a chunk is damaged"));
  if (chunk.packed_bytes > record.length - chunk.head_bytes) {
    return Unexpected(error({{}, record.begin}, "records of a chunk are longer than the chunk",
                            fmt::format("{} B", chunk.packed_bytes),
                            fmt::format("<= {} B", record.length - chunk.head_bytes)));
  }
  const std::uint64_t begin = record.begin + chunk.head_bytes;
  const auto records =
      read_chunk(input_, {begin, chunk.packed_bytes, chunk.unpacked_bytes, chunk.packing}, unpacked_);
  if (!records) return Unexpected(records.error());
  if (chunk.crc != 0 && crc32(*records) != chunk.crc) {
    return Unexpected(error({{}, begin}, "chunk is damaged: its checksum is wrong"));
  }
  return Chunk{*records, begin};
}

Expected<std::optional<Message>> McapBag::leave_chunk(std::string what) {
  progress_.in_chunk = false;
  ++progress_.bad_records;
  return Unexpected(error({progress_.chunk_place, progress_.chunk_at}, std::move(what)));
}

Expected<std::optional<Message>> McapBag::next_in_chunk() {
  Progress& p = progress_;
  while (p.chunk_at < p.chunk.size()) {
    const Bytes left = p.chunk.subspan(p.chunk_at);
    ++p.records;
    if (left.size() < kMcapRecordHead) return leave_chunk("chunk ends in the head of a record");
    const auto op = static_cast<McapOp>(left[0]);
    const auto length = load_le<std::uint64_t>(left, 1);
    if (length > left.size() - kMcapRecordHead)
      return leave_chunk("record is longer than what is left of its chunk");
    const Bytes content = left.subspan(kMcapRecordHead, static_cast<std::size_t>(length));
    const Place place{p.chunk_place, p.chunk_at + kMcapRecordHead};
    p.chunk_at += kMcapRecordHead + content.size();
    const bool is_definition = op == McapOp::kSchema || op == McapOp::kChannel;
    const bool fits =
        op == McapOp::kMessage ? content.size() >= kMessageHead : !is_definition || define(op, content);
    if (!fits) {
      ++p.bad_records;
      return Unexpected(error(place, "record of a chunk is damaged"));
    }
    if (op != McapOp::kMessage) continue;
    auto message = message_of(content.first(kMessageHead), content.subspan(kMessageHead), place);
    if (message) return *std::move(message);
    ++p.bad_records;
    return Unexpected(std::move(message).error());
  }
  p.in_chunk = false;
  return std::nullopt;
}

Expected<std::optional<Message>> McapBag::read_record(const Record& record) {
  switch (record.op) {
    case McapOp::kMessage:
      return read_message(record);
    case McapOp::kChunk:
      if (auto entered = enter_chunk(unpack_chunk(record)); !entered)
        return Unexpected(std::move(entered).error());
      return std::nullopt;
    case McapOp::kSchema:
    case McapOp::kChannel:
      if (auto read = read_definition(record); !read) return Unexpected(std::move(read).error());
      return std::nullopt;
    default:
      return std::nullopt;  // indexes, attachments, metadata and what later versions bring
  }
}

}  // namespace

Expected<std::unique_ptr<Bag>> open_mcap_bag(Input input) { return open_bag_as<McapBag>(std::move(input)); }

Expected<std::unique_ptr<Recording>> open_mcap(Input input, const RecordingOptions& options) {
  return scans_of(open_mcap_bag(std::move(input)), options);
}

}  // namespace verge::io
