// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/mcap_writer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/crc32.hpp"
#include "verge/io/file/mcap_records.hpp"
#include "verge/io/file/point_cloud2.hpp"
#include "verge/io/file/ros_definitions.hpp"
#include "verge/io/file/ros_messages.hpp"

namespace verge::io {
namespace {

Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// The content of a record, value by value, little-endian.
class Content {
 public:
  template <class T>
  Content& number(T value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    out_.append(bytes.data(), bytes.size());
    return *this;
  }
  Content& text(std::string_view value) {
    return number(static_cast<std::uint32_t>(value.size())).raw(value);
  }
  Content& raw(std::string_view value) {
    out_.append(value);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return out_; }

 private:
  std::string out_;
};

void append_record(std::string& out, McapOp op, std::string_view content) {
  out.push_back(static_cast<char>(op));
  out.append(Content().number(std::uint64_t{content.size()}).bytes());
  out.append(content);
}

std::string_view name_of(Packing packing) {
  switch (packing) {
    case Packing::kLz4:
      return "lz4";
    case Packing::kZstd:
      return "zstd";
    default:
      return "";
  }
}

/// A topic that is written: its schema and its channel have the same number.
struct Channel {
  std::uint16_t id = 0;
  std::string schema_record;
  std::string channel_record;
  std::uint64_t messages = 0;
};

/// A chunk that is filled: its messages, and where each stands in it.
struct OpenChunk {
  struct Entry {
    std::uint64_t time = 0;
    std::uint64_t offset = 0;
  };
  std::string records;
  std::map<std::uint16_t, std::vector<Entry>> index;  // by channel
  std::uint64_t first_time = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_time = 0;
};

std::string message_index(std::uint16_t channel, const std::vector<OpenChunk::Entry>& entries) {
  Content content;
  content.number(channel).number(static_cast<std::uint32_t>(16 * entries.size()));
  for (const OpenChunk::Entry& entry : entries) content.number(entry.time).number(entry.offset);
  return content.bytes();
}

Channel make_channel(std::uint16_t id, std::string_view topic, std::string_view type,
                     std::string_view definition) {
  Channel out{id, {}, {}, 0};
  append_record(out.schema_record, McapOp::kSchema,
                Content().number(id).text(type).text("ros2msg").text(definition).bytes());
  append_record(out.channel_record, McapOp::kChannel,
                Content().number(id).number(id).text(topic).text("cdr").number(std::uint32_t{0}).bytes());
  return out;
}

constexpr std::string_view kWorld = "world";

/// The poses at the beginning and the end of the scan, as far as they are known.
std::vector<StampedTransform> transforms_of(const Scan& scan) {
  std::vector<StampedTransform> out;
  if (!scan.stamp_ns) return out;
  const auto add = [&](std::int64_t stamp_ns, const Pose& pose) {
    out.push_back({stamp_ns, std::string(kWorld), scan.frame_id, pose});
  };
  if (scan.motion) {
    add(*scan.stamp_ns, scan.motion->T_world_sensor_begin);
    add(*scan.stamp_ns + scan.motion->duration_ns, scan.motion->T_world_sensor_end);
  } else if (scan.T_world_sensor) {
    add(*scan.stamp_ns, *scan.T_world_sensor);
  }
  return out;
}

}  // namespace

struct McapWriter::State {
  State(AtomicFile target, McapWriterOptions chosen) : file(std::move(target)), options(std::move(chosen)) {}

  [[nodiscard]] Expected<void> write(std::string_view bytes);
  [[nodiscard]] Expected<Channel*> channel(std::string_view topic, std::string_view type,
                                           std::string_view definition);
  void add_message(Channel& channel, std::uint64_t time, std::string_view data);
  [[nodiscard]] Expected<void> close_chunk();
  [[nodiscard]] Expected<void> write_indexes(const OpenChunk& chunk, std::uint64_t chunk_begin,
                                             std::uint64_t packed_bytes);
  [[nodiscard]] Expected<void> write_summary();
  [[nodiscard]] std::string statistics() const;
  [[nodiscard]] std::uint64_t log_time(const Scan& scan);

  AtomicFile file;
  McapWriterOptions options;
  std::uint64_t at = 0;  // bytes written
  std::map<std::string, Channel, std::less<>> channels;
  OpenChunk chunk;
  std::vector<std::string> chunk_indexes;
  std::uint64_t first_time = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t last_time = 0;
  std::optional<std::uint64_t> scan_time;  // of the last scan
};

Expected<void> McapWriter::State::write(std::string_view bytes) {
  at += bytes.size();
  return file.write(bytes);
}

/// The channel of a topic; written where it is new, before the chunk that uses it.
Expected<Channel*> McapWriter::State::channel(std::string_view topic, std::string_view type,
                                              std::string_view definition) {
  if (const auto known = channels.find(topic); known != channels.end()) return &known->second;
  const auto id = static_cast<std::uint16_t>(channels.size() + 1);
  Channel& made = channels[std::string(topic)] = make_channel(id, topic, type, definition);
  if (auto written = write(made.schema_record); !written) return Unexpected(std::move(written).error());
  if (auto written = write(made.channel_record); !written) return Unexpected(std::move(written).error());
  return &made;
}

void McapWriter::State::add_message(Channel& channel, std::uint64_t time, std::string_view data) {
  chunk.index[channel.id].push_back({time, chunk.records.size()});
  chunk.first_time = std::min(chunk.first_time, time);
  chunk.last_time = std::max(chunk.last_time, time);
  const auto sequence = static_cast<std::uint32_t>(channel.messages++);
  append_record(chunk.records, McapOp::kMessage,
                Content().number(channel.id).number(sequence).number(time).number(time).raw(data).bytes());
}

Expected<void> McapWriter::State::close_chunk() {
  if (chunk.records.empty()) return {};
  const OpenChunk full = std::exchange(chunk, {});
  const std::string packed = pack(options.packing, bytes_of(full.records));
  const std::uint64_t begin = at;
  std::string record;
  append_record(record, McapOp::kChunk,
                Content()
                    .number(full.first_time)
                    .number(full.last_time)
                    .number(std::uint64_t{full.records.size()})
                    .number(crc32(bytes_of(full.records)))
                    .text(name_of(options.packing))
                    .number(std::uint64_t{packed.size()})
                    .raw(packed)
                    .bytes());
  first_time = std::min(first_time, full.first_time);
  last_time = std::max(last_time, full.last_time);
  if (auto written = write(record); !written) return written;
  return write_indexes(full, begin, packed.size());
}

/// The message indexes behind a chunk; keeps the chunk's index for the summary.
Expected<void> McapWriter::State::write_indexes(const OpenChunk& full, std::uint64_t chunk_begin,
                                                std::uint64_t packed_bytes) {
  const std::uint64_t begin = at;
  Content offsets;
  for (const auto& [id, entries] : full.index) {
    offsets.number(id).number(at);
    std::string record;
    append_record(record, McapOp::kMessageIndex, message_index(id, entries));
    if (auto written = write(record); !written) return written;
  }
  chunk_indexes.push_back(Content()
                              .number(full.first_time)
                              .number(full.last_time)
                              .number(chunk_begin)
                              .number(begin - chunk_begin)
                              .text(offsets.bytes())
                              .number(at - begin)
                              .text(name_of(options.packing))
                              .number(packed_bytes)
                              .number(std::uint64_t{full.records.size()})
                              .bytes());
  return {};
}

std::string McapWriter::State::statistics() const {
  std::uint64_t messages = 0;
  std::map<std::uint16_t, std::uint64_t> by_id;
  for (const auto& [topic, channel] : channels) {
    messages += channel.messages;
    by_id[channel.id] = channel.messages;
  }
  Content counts;
  for (const auto& [id, count] : by_id) counts.number(id).number(count);
  return Content()
      .number(messages)
      .number(static_cast<std::uint16_t>(channels.size()))
      .number(static_cast<std::uint32_t>(channels.size()))
      .number(std::uint32_t{0})  // attachments
      .number(std::uint32_t{0})  // metadata
      .number(static_cast<std::uint32_t>(chunk_indexes.size()))
      .number(messages == 0 ? 0 : first_time)
      .number(last_time)
      .text(counts.bytes())
      .bytes();
}

Expected<void> McapWriter::State::write_summary() {
  std::map<std::uint16_t, const Channel*> by_id;
  for (const auto& [topic, channel] : channels) by_id[channel.id] = &channel;
  const std::uint64_t begin = at;
  std::string summary;
  std::string offsets;
  // A group of records of one kind, and where it stands.
  const auto add_group = [&](McapOp op, const auto& add_records) {
    const std::uint64_t group = summary.size();
    add_records();
    if (summary.size() == group) return;
    append_record(offsets, McapOp::kSummaryOffset,
                  Content()
                      .number(static_cast<std::uint8_t>(op))
                      .number(begin + group)
                      .number(summary.size() - group)
                      .bytes());
  };
  add_group(McapOp::kSchema, [&] {
    for (const auto& [id, channel] : by_id) summary += channel->schema_record;
  });
  add_group(McapOp::kChannel, [&] {
    for (const auto& [id, channel] : by_id) summary += channel->channel_record;
  });
  add_group(McapOp::kStatistics, [&] { append_record(summary, McapOp::kStatistics, statistics()); });
  add_group(McapOp::kChunkIndex, [&] {
    for (const std::string& index : chunk_indexes) append_record(summary, McapOp::kChunkIndex, index);
  });
  const std::uint64_t offsets_begin = begin + summary.size();
  summary += offsets;
  // The footer's sum covers the summary and the footer up to the sum itself.
  summary.push_back(static_cast<char>(McapOp::kFooter));
  summary += Content().number(kMcapFooterBytes).number(begin).number(offsets_begin).bytes();
  summary += Content().number(crc32(bytes_of(summary))).bytes();
  summary += kMcapMagic;
  return write(summary);
}

/// When the scan was recorded: its stamp or, where it has none, a tenth of a second after the one before.
std::uint64_t McapWriter::State::log_time(const Scan& scan) {
  constexpr std::uint64_t kStep_ns = 100'000'000;
  if (scan.stamp_ns) {
    scan_time = static_cast<std::uint64_t>(std::max<std::int64_t>(*scan.stamp_ns, 0));
  } else {
    scan_time = scan_time ? *scan_time + kStep_ns : 0;
  }
  return *scan_time;
}

McapWriter::McapWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&&) noexcept = default;
McapWriter::~McapWriter() = default;

Expected<McapWriter> McapWriter::create(const std::filesystem::path& path, const McapWriterOptions& options) {
  assert(options.packing != Packing::kBz2);
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(std::move(file).error());
  McapWriter out(std::make_unique<State>(*std::move(file), options));
  std::string begin(kMcapMagic);
  append_record(begin, McapOp::kHeader, Content().text("ros2").text("verge").bytes());
  if (auto written = out.state_->write(begin); !written) return Unexpected(std::move(written).error());
  return out;
}

Expected<void> McapWriter::add(const Scan& scan) {
  constexpr std::int64_t kGreatestStamp_ns =
      std::numeric_limits<std::int32_t>::max() * std::int64_t{1'000'000'000};
  constexpr std::size_t kMostRings = 1U << 16U;
  const std::int64_t stamp_ns = scan.stamp_ns.value_or(0);
  if (stamp_ns > kGreatestStamp_ns || stamp_ns < -kGreatestStamp_ns || scan.ring_count() > kMostRings) {
    return Unexpected(Error{ErrorCode::kCannotWrite,
                            scan.frame,
                            {},
                            "scan has no place in a ROS 2 message",
                            fmt::format("stamp {} ns, {} rings", stamp_ns, scan.ring_count()),
                            "a stamp of 32-bit seconds, at most 65536 rings"});
  }
  const std::uint64_t time = state_->log_time(scan);
  if (const auto transforms = transforms_of(scan); !transforms.empty()) {
    const auto channel = state_->channel("/tf", "tf2_msgs/msg/TFMessage", kTransformsDefinition);
    if (!channel) return Unexpected(channel.error());
    state_->add_message(**channel, time, write_transforms(transforms));
  }
  const auto channel =
      state_->channel(state_->options.topic, "sensor_msgs/msg/PointCloud2", kPointCloud2Definition);
  if (!channel) return Unexpected(channel.error());
  state_->add_message(**channel, time, write_point_cloud2(scan));
  if (state_->chunk.records.size() < state_->options.chunk_bytes) return {};
  return state_->close_chunk();
}

Expected<void> McapWriter::finish() {
  if (auto closed = state_->close_chunk(); !closed) return closed;
  std::string data_end;
  append_record(data_end, McapOp::kDataEnd, Content().number(std::uint32_t{0}).bytes());  // 0: no sum
  if (auto written = state_->write(data_end); !written) return written;
  if (auto written = state_->write_summary(); !written) return written;
  return state_->file.commit();
}

}  // namespace verge::io
