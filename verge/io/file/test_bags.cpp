// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/test_bags.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>

#include <bzlib.h>
#include <sqlite3.h>

#include "verge/io/file/crc32.hpp"

namespace verge::testing {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

Bytes bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string plain_type(std::string type) {
  if (const auto at = type.find("/msg/"); at != std::string::npos) type.replace(at, 5, "/");
  return type;
}

std::string md5_of(const std::string& type) {
  static const std::map<std::string, std::string> kSums{
      {"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"},
      {"velodyne_msgs/VelodyneScan", "50804fc9533a0e579e6322c04ae70566"},
      {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
      {"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"}};
  const auto found = kSums.find(type);
  return found == kSums.end() ? "992ce8a1687cec8c8bd883ec73ca41d1" : found->second;
}

void write_pose(WireWriter& writer, const Pose& pose) {
  for (const double value : {pose.translation.x, pose.translation.y, pose.translation.z, pose.rotation.x,
                             pose.rotation.y, pose.rotation.z, pose.rotation.w}) {
    writer.number(value);
  }
}

std::string text32(std::string_view value) {
  return le(static_cast<std::uint32_t>(value.size())) + std::string(value);
}

std::string time_field(std::int64_t time_ns) {
  return le(static_cast<std::uint32_t>(time_ns / kSecond)) +
         le(static_cast<std::uint32_t>(time_ns % kSecond));
}

}  // namespace

WireWriter::WireWriter(io::Wire wire, bool big_endian) : wire_(wire), big_endian_(big_endian) {
  if (wire == io::Wire::kCdr) out_ = std::string("\0", 1) + (big_endian ? '\0' : '\1') + std::string(2, '\0');
}

WireWriter& WireWriter::text(std::string_view value) {
  const bool ends_in_zero = wire_ == io::Wire::kCdr;
  number(static_cast<std::uint32_t>(value.size() + (ends_in_zero ? 1 : 0)));
  out_ += value;
  if (ends_in_zero) out_.push_back('\0');
  return *this;
}

WireWriter& WireWriter::raw(std::string_view bytes) {
  out_ += bytes;
  return *this;
}

WireWriter& WireWriter::header(std::int64_t stamp_ns, std::string_view frame) {
  if (wire_ == io::Wire::kRos1) number(std::uint32_t{7});  // seq
  number(static_cast<std::uint32_t>(stamp_ns / kSecond));
  number(static_cast<std::uint32_t>(stamp_ns % kSecond));
  return text(frame);
}

std::string cloud_message(const CloudParts& parts, io::Wire wire, bool big_endian_wire) {
  WireWriter writer(wire, big_endian_wire);
  writer.header(parts.stamp_ns, parts.frame).number(parts.height).number(parts.width);
  writer.number(static_cast<std::uint32_t>(parts.fields.size()));
  for (const CloudField& field : parts.fields) {
    writer.text(field.name).number(field.offset).number(field.datatype).number(field.count);
  }
  writer.number(static_cast<std::uint8_t>(parts.big_endian ? 1 : 0));
  writer.number(parts.point_step).number(parts.row_step);
  writer.number(static_cast<std::uint32_t>(parts.data.size())).raw(parts.data);
  return writer.number(std::uint8_t{1}).bytes();
}

CloudParts simple_cloud(std::uint32_t n, std::int64_t stamp_ns) {
  CloudParts out;
  out.stamp_ns = stamp_ns;
  out.width = n;
  out.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"ring", 12, 4, 1}};
  out.point_step = 14;
  out.row_step = 14 * n;
  for (std::uint32_t i = 0; i < n; ++i) {
    out.data += le(static_cast<float>(i + 1)) + le(2.0F) + le(3.0F) + le(static_cast<std::uint16_t>(i % 4));
  }
  return out;
}

std::string tf_message(const std::vector<TestTransform>& transforms, io::Wire wire) {
  WireWriter writer(wire);
  writer.number(static_cast<std::uint32_t>(transforms.size()));
  for (const TestTransform& transform : transforms) {
    writer.header(transform.stamp_ns, transform.parent).text(transform.child);
    write_pose(writer, transform.pose);
  }
  return writer.bytes();
}

std::string odometry_message(const TestTransform& transform, io::Wire wire) {
  WireWriter writer(wire);
  writer.header(transform.stamp_ns, transform.parent).text(transform.child);
  write_pose(writer, transform.pose);
  for (int i = 0; i < 36 + 6 + 36; ++i) writer.number(0.0);  // covariance, twist, covariance
  return writer.bytes();
}

std::string mcap_record(std::uint8_t op, std::string_view content) {
  return le(op) + le(std::uint64_t{content.size()}) + std::string(content);
}

std::string mcap_of(const std::vector<TestMessage>& messages, const McapShape& shape) {
  const std::string magic("\x89MCAP0\r\n", 8);
  std::string out = magic + mcap_record(0x01, text32("ros2") + text32("test"));
  std::map<std::string, std::uint16_t> ids;
  std::map<std::uint16_t, std::uint64_t> counts;
  std::string definitions;
  std::string chunk;
  std::size_t in_chunk = 0;
  std::uint64_t begin_ns = 0;
  const auto close_chunk = [&] {
    if (chunk.empty()) return;
    const std::string packed = io::pack(shape.packing, bytes_of(chunk));
    const std::string name = shape.packing == io::Packing::kNone  ? ""
                             : shape.packing == io::Packing::kLz4 ? "lz4"
                                                                  : "zstd";
    out += mcap_record(0x06, le(begin_ns) + le(begin_ns) + le(std::uint64_t{chunk.size()}) +
                                 le(shape.checksums ? io::crc32(bytes_of(chunk)) : 0U) + text32(name) +
                                 le(std::uint64_t{packed.size()}) + packed);
    out += mcap_record(0x07, le(std::uint16_t{1}) + le(std::uint32_t{0}));
    chunk.clear();
    in_chunk = 0;
  };
  for (const TestMessage& message : messages) {
    std::string& to = shape.messages_per_chunk == 0 ? out : chunk;
    if (!ids.contains(message.topic)) {
      const auto id = static_cast<std::uint16_t>(ids.size() + 3);
      ids[message.topic] = id;
      const std::string definition =
          mcap_record(0x03, le(id) + text32(message.type) + text32("ros2msg") + text32("")) +
          mcap_record(
              0x04, le(id) + le(id) + text32(message.topic) + text32(shape.encoding) + le(std::uint32_t{0}));
      to += definition;
      definitions += definition;
    }
    const std::uint16_t id = ids[message.topic];
    const auto time = static_cast<std::uint64_t>(message.time_ns);
    begin_ns = time;
    ++counts[id];
    to += mcap_record(0x05, le(id) + le(std::uint32_t{0}) + le(time) + le(time) + message.data);
    if (++in_chunk == shape.messages_per_chunk) close_chunk();
  }
  close_chunk();
  if (!shape.footer) return out;
  out += mcap_record(0x0F, le(std::uint32_t{0}));
  const std::uint64_t summary_start = shape.summary ? out.size() : 0;
  std::string end;
  if (shape.summary) {
    std::string by_channel;
    for (const auto& [id, count] : counts) by_channel += le(id) + le(count);
    end = definitions +
          mcap_record(0x0B, le(std::uint64_t{messages.size()}) + le(static_cast<std::uint16_t>(ids.size())) +
                                std::string(16, '\0') + std::string(16, '\0') + text32(by_channel));
  }
  end += le(std::uint8_t{0x02}) + le(std::uint64_t{20}) + le(summary_start) + le(std::uint64_t{0});
  return out + end + le(shape.checksums ? io::crc32(bytes_of(end)) : 0U) + magic;
}

std::string bag_field(std::string_view name, std::string_view value) {
  return text32(std::string(name) + "=" + std::string(value));
}

std::string bag_record(std::string_view header, std::string_view data) {
  return text32(header) + text32(data);
}

std::string packed_by(const std::string& compression, std::string records) {
  if (compression == "lz4") return io::pack(io::Packing::kLz4, bytes_of(records));
  if (compression == "none") return records;
  std::string out(records.size() * 2 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  BZ2_bzBuffToBuffCompress(out.data(), &size, records.data(), static_cast<unsigned>(records.size()), 9, 0, 0);
  out.resize(size);
  return out;
}

std::string rosbag1_of(const std::vector<TestMessage>& messages, const BagShape& shape) {
  constexpr std::size_t kBagHeaderBytes = 4096;
  const std::string magic = "#ROSBAG V2.0\n";
  std::map<std::string, std::uint32_t> ids;
  std::map<std::uint32_t, std::uint32_t> counts;
  std::string body;
  std::string connections;
  std::string chunk;
  std::size_t in_chunk = 0;
  std::uint32_t chunks = 0;
  const auto close_chunk = [&] {
    if (chunk.empty()) return;
    body += bag_record(bag_field("op", "\x05") + bag_field("compression", shape.compression) +
                           bag_field("size", le(static_cast<std::uint32_t>(chunk.size()))),
                       packed_by(shape.compression, chunk));
    body += bag_record(bag_field("op", "\x04") + bag_field("ver", le(1)) + bag_field("conn", le(0)) +
                           bag_field("count", le(0)),
                       "");
    chunk.clear();
    in_chunk = 0;
    ++chunks;
  };
  for (const TestMessage& message : messages) {
    if (!ids.contains(message.topic)) {
      const auto id = static_cast<std::uint32_t>(ids.size());
      ids[message.topic] = id;
      const std::string type = plain_type(message.type);
      const std::string connection =
          bag_record(bag_field("op", "\x07") + bag_field("conn", le(id)) + bag_field("topic", message.topic),
                     bag_field("topic", message.topic) + bag_field("type", type) +
                         bag_field("md5sum", shape.md5.empty() ? md5_of(type) : shape.md5) +
                         bag_field("message_definition", "..."));
      chunk += connection;
      connections += connection;
    }
    const std::uint32_t id = ids[message.topic];
    ++counts[id];
    chunk += bag_record(
        bag_field("op", "\x02") + bag_field("conn", le(id)) + bag_field("time", time_field(message.time_ns)),
        message.data);
    if (++in_chunk == shape.messages_per_chunk) close_chunk();
  }
  close_chunk();
  const std::uint64_t index_at = shape.index ? magic.size() + kBagHeaderBytes + body.size() : 0;
  std::string fields = bag_field("op", "\x03") + bag_field("index_pos", le(index_at)) +
                       bag_field("conn_count", le(static_cast<std::uint32_t>(shape.index ? ids.size() : 0))) +
                       bag_field("chunk_count", le(shape.index ? chunks : 0U));
  const std::string header = bag_record(fields, std::string(kBagHeaderBytes - 8 - fields.size(), ' '));
  if (!shape.index) return magic + header + body;
  std::string entries;
  for (const auto& [id, count] : counts) entries += le(id) + le(count);
  const std::string info = bag_record(
      bag_field("op", "\x06") + bag_field("ver", le(1)) + bag_field("chunk_pos", le(std::uint64_t{4109})) +
          bag_field("start_time", time_field(0)) + bag_field("end_time", time_field(0)) +
          bag_field("count", le(static_cast<std::uint32_t>(counts.size()))),
      entries);
  return magic + header + body + connections + info;
}

std::string db3_of(const std::vector<TestMessage>& messages, const Db3Shape& shape) {
  sqlite3* made = nullptr;
  sqlite3_open(":memory:", &made);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(made, &sqlite3_close);
  const auto run = [&](const std::string& sql) {
    if (sqlite3_exec(made, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(made));
  };
  run("PRAGMA page_size=" + std::to_string(shape.page_bytes));
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
      "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL,"
      "data BLOB NOT NULL);CREATE INDEX timestamp_idx ON messages (timestamp ASC);");
  std::map<std::string, std::size_t> ids;
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(made, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?,?,?)", -1, &insert,
                     nullptr);
  for (const TestMessage& message : messages) {
    if (!ids.contains(message.topic)) {
      ids.emplace(message.topic, ids.size() + 1);
      run("INSERT INTO topics VALUES(" + std::to_string(ids[message.topic]) + ",'" + message.topic + "','" +
          message.type + "','" + shape.serialization + "','')");
    }
    const std::string data =
        shape.compress ? io::pack(io::Packing::kZstd, bytes_of(message.data)) : message.data;
    sqlite3_bind_int64(insert, 1, static_cast<sqlite3_int64>(ids[message.topic]));
    sqlite3_bind_int64(insert, 2, message.time_ns);
    sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  if (!shape.more_sql.empty()) run(shape.more_sql);
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
      sqlite3_serialize(made, "main", &size, 0), &sqlite3_free);
  return {reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)};
}

std::vector<std::size_t> Outcome::points() const {
  std::vector<std::size_t> out;
  for (const io::Decoded& scan : scans) out.push_back(scan.cloud.x.size());
  return out;
}

Outcome read_through(Expected<std::unique_ptr<io::Recording>> recording) {
  Outcome out;
  if (!recording) {
    out.errors.push_back(recording.error());
    return out;
  }
  while (out.errors.size() < 1000) {
    auto next = (*recording)->next();
    if (!next) {
      out.errors.push_back(next.error());
    } else if (*next) {
      out.scans.push_back(std::move(**next));
    } else {
      break;
    }
  }
  for (const io::Counter& counter : (*recording)->counters()) out.counters[counter.name] = counter.count;
  return out;
}

std::vector<TestMessage> cloud_messages(std::uint32_t n, io::Wire wire, std::uint32_t first) {
  std::vector<TestMessage> out;
  for (std::uint32_t i = first; i < first + n; ++i) {
    const std::int64_t time = 1'700'000'000 * kSecond + kSecond / 10 * i;
    out.push_back(
        {"/points", "sensor_msgs/msg/PointCloud2", time, cloud_message(simple_cloud(i + 1, time), wire)});
  }
  return out;
}

}  // namespace verge::testing
