// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section R: recordings of ROS, in each of .bag, .db3 and .mcap that can have the fault. R05 (a record
// without its operation) is nothing that a database can have; only ROS 1 has MD5 sums of its types (R07), the
// others have encodings that we do not read.
#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

#include "tests/faults/bad_inputs.hpp"
#include "verge/io/file/packing.hpp"
#include "verge/io/file/test_bags.hpp"

namespace verge::faults {
namespace {

namespace fs = std::filesystem;
using io::Packing;
using io::Wire;
using testing::bag_field;
using testing::bag_record;
using testing::BagShape;
using testing::cloud_message;
using testing::cloud_messages;
using testing::CloudParts;
using testing::db3_of;
using testing::le;
using testing::mcap_of;
using testing::mcap_record;
using testing::McapShape;
using testing::rosbag1_of;
using testing::simple_cloud;
using testing::TestMessage;

using Messages = std::vector<TestMessage>;

constexpr std::size_t kFirstChunk = 13 + 4096;  // of a .bag
constexpr std::size_t kMcapFooter = 8 + 20;     // from the end: its content and the magic
constexpr std::size_t kPage = 4096;             // of a database

/// One of the formats, in its plainest form.
struct Kind {
  std::string name;  ///< For titles.
  std::string suffix;
  Wire wire;
  std::string (*make)(const Messages&);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds{
      {"Bag", ".bag", Wire::kRos1, [](const Messages& m) { return rosbag1_of(m); }},
      {"Db3", ".db3", Wire::kCdr, [](const Messages& m) { return db3_of(m); }},
      {"Mcap", ".mcap", Wire::kCdr, [](const Messages& m) { return mcap_of(m); }}};
  return kKinds;
}

/// Clouds of 1, 2, ... points.
Messages clouds(std::uint32_t n, Wire wire = Wire::kCdr) { return cloud_messages(n, wire); }
std::string bag(std::uint32_t n, const BagShape& shape = {}) {
  return rosbag1_of(clouds(n, Wire::kRos1), shape);
}

std::size_t nth(std::string_view text, std::string_view what, int n) {
  std::size_t at = text.find(what);
  while (--n > 0) at = text.find(what, at + 1);
  return at;
}

std::string replaced(std::string bytes, std::size_t at, std::string_view by) {
  return bytes.replace(at, by.size(), by);
}

BadInput damaged(std::string title, const std::string& suffix, std::string bytes, std::string says,
                 std::string where, std::size_t used) {
  return {"",       std::move(title), file("R" + suffix, std::move(bytes)),
          kDamaged, std::move(says),  std::move(where),
          used};
}

BadInput harmless(std::string title, const std::string& suffix, std::string bytes, std::size_t used,
                  std::string says = {}) {
  return {"", std::move(title), file("R" + suffix, std::move(bytes)), kGood, std::move(says), "", used, 0};
}

BadInput refused(std::string title, const std::string& suffix, std::string bytes, std::string says,
                 Exit exit = kUnusable) {
  return {"", std::move(title), file("R" + suffix, std::move(bytes)), exit, std::move(says)};
}

/// A .bag with more records before its first chunk; its header still says where the index is.
std::string with_records(std::string bag, const std::string& records) {
  const std::size_t index_pos = bag.find("index_pos=") + 10;
  std::uint64_t index = 0;
  std::memcpy(&index, bag.data() + index_pos, sizeof(index));
  return replaced(std::move(bag), index_pos, le(index + records.size())).insert(kFirstChunk, records);
}

// --- R01: a recorder that was killed ---------------------------------------------------------------------

void add_not_closed(Section& all) {
  for (const char* compression : {"none", "lz4", "bz2"}) {
    const std::string bytes = bag(4, {.compression = compression, .index = false});
    all.add(1, damaged("NotClosedBag", ".bag", bytes, "bag was not closed: it has no index",
                       std::to_string(bytes.size()), 10));
  }
  for (const std::size_t chunk : {0U, 2U}) {
    const std::string bytes = mcap_of(clouds(4), {.messages_per_chunk = chunk, .footer = false});
    all.add(1, damaged("NotClosedMcap", ".mcap", bytes, "recording was not closed: it has no footer",
                       std::to_string(bytes.size()), 10));
  }
  all.add(1, refused("NotClosedAndEmptyBag", ".bag", rosbag1_of({}, {.index = false}), "bag was not closed"));
  all.add(1, refused("NotClosedAndEmptyMcap", ".mcap", mcap_of({}, {.footer = false}),
                     "recording was not closed"));
  // What a .db3 itself holds is whole. What stands in the WAL beside it may be in it already: a warning.
  const std::string db3 = db3_of(clouds(4));
  const std::string wal(32 + 24 + kPage, 'w');
  all.add(1, {"", "WalBesideADb3",
              [db3, wal](const fs::path& in) {
                write(in / "R.db3-wal", wal);
                write(in / "R.db3", db3);
                return in / "R.db3";
              },
              kGood, "R.db3-wal: the recorder's WAL is not read", "", 10, 0});
  all.add(1, {"", "WalInAFolder", folder("R", {{"R_0.db3", db3}, {"R_0.db3-wal", wal}}), kGood,
              "R_0.db3-wal: the recorder's WAL is not read", "", 10, 0});
}

// --- R02: cut or damaged chunks --------------------------------------------------------------------------

void add_cut_bags(Section& all) {
  const std::string whole = bag(6);
  const std::size_t third = nth(whole, "op=\x05", 3) - 8;
  all.add(2, damaged("CutInAChunkBag", ".bag", whole.substr(0, third + 100),
                     "record is longer than what is left of the file", std::to_string(third), 10));
  all.add(2, damaged("CutBetweenChunksBag", ".bag", whole.substr(0, third), "bag ends before its index",
                     std::to_string(third), 10));
  all.add(2, damaged("CutInALengthBag", ".bag", whole.substr(0, third + 3), "file ends in a record's length",
                     std::to_string(third), 10));
  for (const char* compression : {"lz4", "bz2"}) {
    std::string bytes = bag(6, {.compression = compression});
    const std::size_t inside = nth(bytes, "op=\x05", 2) + 80;
    bytes[inside] = static_cast<char>(bytes[inside] ^ 0x55);
    all.add(2, damaged("ChunkDamagedBag", ".bag", bytes, "chunk is damaged: it does not unpack", "",
                       1 + 2 + 5 + 6));
  }
}

void add_cut_mcaps(Section& all) {
  const std::string whole = mcap_of(clouds(6));
  const std::size_t third = nth(whole, "zstd", 3);
  const std::size_t record = third - 32 - 9;  // 32 bytes of the chunk stand before its compression's name
  all.add(2, damaged("CutInAChunkMcap", ".mcap", whole.substr(0, third + 30),
                     "record is longer than what is left of the file", std::to_string(record), 10));
  all.add(2, damaged("CutBetweenChunksMcap", ".mcap", whole.substr(0, record), "recording was not closed",
                     std::to_string(record), 10));
  for (const Packing packing : {Packing::kLz4, Packing::kZstd}) {
    std::string bytes = mcap_of(clouds(6), {.packing = packing});
    const std::size_t inside = nth(bytes, packing == Packing::kLz4 ? "lz4" : "zstd", 2) + 40;
    bytes[inside] = static_cast<char>(bytes[inside] ^ 0x55);
    all.add(2, damaged("ChunkDamagedMcap", ".mcap", bytes, "chunk is damaged", "", 1 + 2 + 5 + 6));
  }
  std::string bytes = mcap_of(clouds(6), {.packing = Packing::kNone});
  bytes[bytes.find("sensor_msgs")] ^= 0x55;
  all.add(2, damaged("ChecksumOfAChunkMcap", ".mcap", bytes, "chunk is damaged: its checksum is wrong", "",
                     3 + 4 + 5 + 6));
}

void add_cut_databases(Section& all) {
  const std::string small = db3_of(clouds(6));  // pages: schema, topics, messages, index of their times
  all.add(2, damaged("CutInTheIndexDb3", ".db3", small.substr(0, small.size() - 1), "database is cut",
                     std::to_string(small.size() - 1), 21));
  all.add(2, refused("CutBeforeTheMessagesDb3", ".db3", small.substr(0, 2 * kPage), "database is cut"));
  all.add(2, refused("CutInTheSchemaDb3", ".db3", small.substr(0, 1000), "database is cut"));
  const std::string large = db3_of(clouds(60));
  BadInput half = damaged("CutInTheMessagesDb3", ".db3", large.substr(0, large.size() / 2), "database is cut",
                          std::to_string(large.size() / 2), 0);
  half.used.reset();  // as many as SQLite put there; verge/io/file/rosbag2_test.cpp compares them
  all.add(2, std::move(half));
}

// --- R03: bombs ------------------------------------------------------------------------------------------

struct Bomb {
  std::string title;
  std::string packing;
  std::string packed;
  std::uint64_t unpacked = 0;
  std::string says;
  Exit alone = kUnusable;  ///< Where there is nothing else in the recording.
};

std::vector<Bomb> bombs_of_bags() {
  const std::string zeros(4U << 20U, '\0');
  const std::string bz2 = testing::packed_by("bz2", zeros);
  const std::string lz4 = testing::packed_by("lz4", zeros);
  return {{"Bz2Over1024", "bz2", bz2, zeros.size(), "chunk cannot be compressed that much", kLimit},
          {"Bz2MoreThanItTells", "bz2", bz2, 100, "does not unpack to its size"},
          {"Lz4Over1GiB", "lz4", lz4, (1U << 30U) + 1, "chunk is too large", kLimit},
          {"Lz4MoreThanItTells", "lz4", lz4, 1000, "does not unpack to its size"},
          {"UnknownCompression", "zip", "", 0, "chunk has an unknown compression"}};
}

std::vector<Bomb> bombs_of_mcaps() {
  const std::string zeros(1U << 20U, '\0');
  const std::string zstd = io::pack(Packing::kZstd, std::as_bytes(std::span(zeros)));
  return {{"ZstdOver1024", "zstd", zstd, zeros.size(), "chunk cannot be compressed that much", kLimit},
          {"ZstdMoreThanItTells", "zstd", zstd, 1000, "does not unpack to its size"},
          {"ZstdOver1GiB", "zstd", zstd, (1U << 30U) + 1, "chunk is too large", kLimit},
          {"ZstdOf16EiB", "zstd", zstd, ~0ULL, "chunk is too large", kLimit},
          {"UnknownCompression", "zip", "", 0, "chunk has an unknown compression"}};
}

void add_bombs(Section& all) {
  for (const Bomb& bomb : bombs_of_bags()) {
    const std::string chunk = bag_record(bag_field("op", "\x05") + bag_field("compression", bomb.packing) +
                                             bag_field("size", le(static_cast<std::uint32_t>(bomb.unpacked))),
                                         bomb.packed);
    all.add(3, damaged(bomb.title + "Bag", ".bag", with_records(bag(4), chunk), bomb.says, "", 10));
    all.add(3, refused(bomb.title + "AloneInABag", ".bag", rosbag1_of({}, {.index = false}) + chunk,
                       bomb.says, bomb.alone));
  }
  for (const Bomb& bomb : bombs_of_mcaps()) {
    const auto length = static_cast<std::uint32_t>(bomb.packing.size());
    const std::string chunk =
        mcap_record(0x06, std::string(16, '\0') + le(bomb.unpacked) + le(0U) + le(length) + bomb.packing +
                              le(std::uint64_t{bomb.packed.size()}) + bomb.packed);
    all.add(3, damaged(bomb.title + "Mcap", ".mcap", mcap_of(clouds(4)).insert(8, chunk), bomb.says, "", 10));
    all.add(3, refused(bomb.title + "AloneInAMcap", ".mcap", mcap_of({}).insert(8, chunk), bomb.says,
                       bomb.alone));
  }
  Messages messages = clouds(4);
  const std::string zeros(8U << 20U, '\0');
  messages[0].data = io::pack(Packing::kZstd, std::as_bytes(std::span(zeros)));
  const std::string says = "packed message does not tell a size that is allowed";
  all.add(3, damaged("MessageOver1024Db3", ".db3", db3_of(messages), says, "messages row 1+0", 9));
  all.add(3, refused("MessageOver1024AloneInADb3", ".db3", db3_of({messages[0]}), says, kLimit));
}

// --- R04: indexes; R05: records --------------------------------------------------------------------------

void add_indexes(Section& all) {
  const std::string closed = bag(4);
  const std::size_t index_pos = closed.find("index_pos=") + 10;
  for (const std::uint64_t at :
       {std::uint64_t{14}, std::uint64_t{kFirstChunk}, std::uint64_t{closed.size() - 5}}) {
    all.add(4, harmless("IndexElsewhereBag", ".bag", replaced(closed, index_pos, le(at)), 10));
  }
  // Behind the end: as if the bag were cut.
  all.add(4, damaged("IndexOutsideBag", ".bag", replaced(closed, index_pos, le(~0ULL)),
                     "bag ends before its index", std::to_string(closed.size()), 10));
  const std::string mcap = mcap_of(clouds(4));
  for (const std::uint64_t at : {std::uint64_t{1}, std::uint64_t{mcap.size()}, ~std::uint64_t{0}}) {
    all.add(4,
            harmless("SummaryOutsideMcap", ".mcap", replaced(mcap, mcap.size() - kMcapFooter, le(at)), 10));
  }
  const std::string db3 = db3_of(clouds(4));
  all.add(4,
          harmless("IndexOverwrittenDb3", ".db3", replaced(db3, 3 * kPage, std::string(kPage, '\xFF')), 10));
}

void add_records(Section& all) {
  const std::string stray = bag_record(bag_field("conn", le(0)), "data");
  all.add(5, damaged("NoOperationBag", ".bag", with_records(bag(4), stray), "record has no operation",
                     std::to_string(kFirstChunk), 10));
  std::string in_chunk = bag(4);
  in_chunk[nth(in_chunk, "op=\x02", 2)] = 'x';
  all.add(5, damaged("NoOperationInAChunkBag", ".bag", in_chunk, "record has no operation", "", 8));
  std::string broken = bag(4);
  broken[nth(broken, "op=\x02", 2) - 4] = '\x7F';
  all.add(5, damaged("FieldLongerThanItsHeaderBag", ".bag", broken, "record has no operation", "", 8));
  const std::string mcap = mcap_of(clouds(4), {.messages_per_chunk = 0});
  std::uint64_t summary = 0;
  std::memcpy(&summary, mcap.data() + mcap.size() - kMcapFooter, sizeof(summary));
  const std::size_t data_end = summary - 13;
  all.add(5, damaged("NoOperationMcap", ".mcap", std::string(mcap).insert(data_end, mcap_record(0, "data")),
                     "record has no operation", std::to_string(data_end), 10));
}

// --- R06 to R09: messages --------------------------------------------------------------------------------

/// The second of four clouds, of two points, is another.
std::string with_cloud(const Kind& kind, const CloudParts& parts) {
  Messages messages = clouds(4, kind.wire);
  messages[1].data = cloud_message(parts, kind.wire);
  return kind.make(messages);
}

CloudParts big_endian(CloudParts parts) {
  parts.big_endian = true;
  std::string& data = parts.data;
  for (std::size_t point = 0; point < data.size(); point += 14) {
    const auto turn = [&](std::size_t at, std::size_t bytes) {
      const auto begin = data.begin() + static_cast<std::ptrdiff_t>(point + at);
      std::reverse(begin, begin + static_cast<std::ptrdiff_t>(bytes));
    };
    for (const std::size_t at : {0U, 4U, 8U}) turn(at, 4);
    turn(12, 2);
  }
  return parts;
}

void add_clouds(Section& all, const Kind& kind) {
  const auto bad = [&](const std::string& title, const CloudParts& parts, const std::string& says) {
    all.add(6, damaged(title + kind.name, kind.suffix, with_cloud(kind, parts), says, "", 8));
  };
  CloudParts parts = simple_cloud(2);
  parts.point_step = 0;
  bad("PointStep0", parts, "field lies outside its point");
  parts = simple_cloud(2);
  parts.fields[2].offset = 11;
  bad("FieldPastTheStep", parts, "field lies outside its point");
  parts = simple_cloud(2);
  parts.fields[0].count = ~0U;
  bad("FieldOf4GValues", parts, "field lies outside its point");
  parts = simple_cloud(2);
  parts.fields[1].datatype = 9;
  bad("UnknownDatatype", parts, "field has no known type");
  parts = simple_cloud(2);
  parts.height = parts.width = ~0U;
  bad("HeightTimesWidthBeyond32Bits", parts, "rows are shorter than their points");
  parts = simple_cloud(2);
  parts.height = 2;
  bad("MoreRowsThanData", parts, "cloud is larger than its data");
  parts = simple_cloud(2);
  parts.fields.pop_back();
  parts.fields.pop_back();
  bad("NoZ", parts, "cloud lacks a coordinate");
  all.add(6,
          harmless("BigEndian" + kind.name, kind.suffix, with_cloud(kind, big_endian(simple_cloud(2))), 10));
}

void add_types(Section& all) {
  all.add(7, refused("AnotherMd5Bag", ".bag", bag(4, {.md5 = std::string(32, '0')}),
                     "another definition, MD5 00000"));
  all.add(7, refused("OtherEncodingMcap", ".mcap", mcap_of(clouds(4), {.encoding = "protobuf"}),
                     "/points (sensor_msgs/msg/PointCloud2: encoding protobuf, not cdr or ros1)"));
  all.add(7, refused("OtherSerializationDb3", ".db3", db3_of(clouds(4), {.serialization = "protobuf"}),
                     "serialization protobuf, not cdr"));
  Messages messages = clouds(4);
  messages[1].data[1] = '\x07';
  all.add(7, damaged("Xcdr2Mcap", ".mcap", mcap_of(messages),
                     "message is XCDR2, not plain CDR (got encoding 7", "", 8));
  all.add(7, damaged("Xcdr2Db3", ".db3", db3_of(messages), "message is XCDR2, not plain CDR (got encoding 7",
                     "messages row 2+0", 8));
}

void add_connections(Section& all) {
  std::string bytes = bag(4);
  const std::size_t message = nth(bytes, "op=\x02", 2);
  all.add(8,
          damaged("UnknownConnectionBag", ".bag", replaced(bytes, bytes.find("conn=", message) + 5, le(77)),
                  "message of an unknown connection (got 77)", "", 8));
  const std::string stray = mcap_record(0x05, le(std::uint16_t{99}) + std::string(20, '\0') + "data");
  all.add(8, damaged("UnknownChannelMcap", ".mcap", mcap_of(clouds(4)).insert(8, stray),
                     "message of a channel that is not defined (got 99)", "17", 10));
  all.add(8, damaged("UnknownTopicDb3", ".db3",
                     db3_of(clouds(4), {.more_sql = "UPDATE messages SET topic_id = 77 WHERE id = 2"}),
                     "message of an unknown topic (got 77)", "messages row 2+0", 8));
}

void add_times(Section& all, const Kind& kind) {
  Messages messages = clouds(3, kind.wire);
  TestMessage old = messages[1];
  old.time_ns -= 3'600'000'000'000;
  old.data = cloud_message(simple_cloud(4, old.time_ns), kind.wire);
  messages.push_back(old);
  all.add(9, harmless("TimeGoesBack" + kind.name, kind.suffix, kind.make(messages), 10,
                      "the recording goes back in time"));
}

// --- R10: folders ----------------------------------------------------------------------------------------

void add_folders(Section& all) {
  const std::string db3 = db3_of(clouds(4));
  const std::string packed = io::pack(Packing::kZstd, std::as_bytes(std::span(db3)));
  const std::string zstd = "is compressed with zstd: unpack it first (zstd -d)";
  all.add(10, {"", "NoMetadataDb3", folder("R", {{"R_0.db3", db3}, {"R_1.db3", db3}}), kGood, "", "", 20, 0});
  all.add(10, {"", "NoMetadataMcap", folder("R", {{"R_0.mcap", mcap_of(clouds(4))}}), kGood, "", "", 10, 0});
  all.add(10, {"", "MetadataThatIsNoYaml", folder("R", {{"R_0.db3", db3}, {"metadata.yaml", "\xFF{["}}),
               kGood, "", "", 10, 0});
  all.add(10, {"", "OneFileOfTwoIsNothing", folder("R", {{"R_0.db3", db3}, {"R_1.db3", "nothing"}}), kDamaged,
               "R_1.db3:0: no SQLite database", "0", 10});
  all.add(10, refused("FileCompressedAsAWhole", ".db3.zstd", packed, zstd));
  all.add(10, {"", "FolderOfFilesCompressedAsAWhole", folder("R", {{"R_0.db3.zstd", packed}}), kUnusable,
               "R_0.db3.zstd:0: " + zstd, "0"});
  all.add(10,
          {"", "OneFileOfTwoCompressedAsAWhole", folder("R", {{"R_0.db3.zstd", packed}, {"R_1.db3", db3}}),
           kDamaged, "R_0.db3.zstd:0: " + zstd, "0", 10});
}

}  // namespace

std::vector<BadInput> bad_inputs_ros() {
  Section all('R');
  add_not_closed(all);
  add_cut_bags(all);
  add_cut_mcaps(all);
  add_cut_databases(all);
  add_bombs(all);
  add_indexes(all);
  add_records(all);
  for (const Kind& kind : kinds()) add_clouds(all, kind);
  add_types(all);
  add_connections(all);
  for (const Kind& kind : kinds()) add_times(all, kind);
  add_folders(all);
  return std::move(all).take();
}

}  // namespace verge::faults
