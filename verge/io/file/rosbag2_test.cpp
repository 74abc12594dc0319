// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/rosbag2.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/io/file/test_bags.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using testing::db3_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::mcap_of;
using testing::Outcome;
using testing::read_through;
using testing::TemporaryFolder;
using testing::TestMessage;

Outcome run_db3(const std::string& bytes) {
  return read_through(open_db3(Input::of(bytes_of(bytes), "a.db3"), {}));
}

std::vector<TestMessage> clouds(std::uint32_t first, std::uint32_t n) {
  return testing::cloud_messages(n, Wire::kCdr, first);
}

}  // namespace

TEST(Db3, AFileOnDiskIsReadAsMemoryIsAndNothingIsLeftBesideIt) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.db3", db3_of(clouds(0, 3)));
  auto input = Input::open(path, {});
  ASSERT_TRUE(input);
  const Outcome got = read_through(open_db3(*std::move(input), {}));
  EXPECT_THAT(got.points(), ElementsAre(1, 2, 3));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Db3, ADatabaseInWalModeIsRead) {
  std::string bytes = db3_of(clouds(0, 3));
  bytes[18] = bytes[19] = 2;  // as the "resilient" profile of rosbag2 leaves it
  EXPECT_THAT(run_db3(bytes).points(), ElementsAre(1, 2, 3));
}

TEST(Db3, WhatIsNoRecordingIsSaid) {
  EXPECT_EQ(run_db3("SQLite format 2").errors.at(0).code, ErrorCode::kUnusable);
  const Outcome got = run_db3(db3_of({}, {.more_sql = "DROP TABLE messages"}));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
  EXPECT_EQ(got.errors[0].got, "no table messages");
}

TEST(Db3, AViewIsNoTableEvenIfItNeverEnds) {
  const Outcome got = run_db3(db3_of(
      {},
      {.more_sql = "DROP TABLE messages; CREATE VIEW messages AS WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL "
                   "SELECT n + 1 FROM r) SELECT n AS id, 1 AS topic_id, n AS timestamp, '' AS data FROM r"}));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
}

TEST(Db3, OfACutFileTheScansBeforeTheCutAreRead) {
  const std::string whole = db3_of(clouds(0, 300));
  const Outcome all = run_db3(whole);
  ASSERT_EQ(all.scans.size(), 300U);
  std::size_t most = 0;
  for (std::size_t size = 100; size < whole.size(); size += 1997) {
    const Outcome got = run_db3(whole.substr(0, size));
    ASSERT_EQ(got.errors.size(), 1U) << size;
    EXPECT_EQ(got.errors[0].what, "database is cut") << size;
    EXPECT_EQ(got.errors[0].where, std::to_string(size));
    EXPECT_EQ(got.errors[0].need, std::to_string(whole.size()) + " B");
    if (!got.scans.empty()) {
      EXPECT_EQ(got.errors[0].code, ErrorCode::kDamaged) << size;
    }
    for (std::size_t i = 0; i < got.scans.size(); ++i) {
      ASSERT_EQ(got.scans[i].cloud.x, all.scans[i].cloud.x) << size;
    }
    most = std::max(most, got.scans.size());
  }
  EXPECT_GT(most, 250U);
}

TEST(Db3, AWalWithSomethingInItIsToldOnce) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.db3", db3_of(clouds(0, 3)));
  std::vector<std::string> said;
  const Log log = [&](LogLevel level, std::string_view text) {
    EXPECT_EQ(level, LogLevel::kWarning);
    said.emplace_back(text);
  };
  warn_of_wal(path, log);
  folder.write("a.db3-wal", std::string(32, 'w'));  // a header alone
  warn_of_wal(path, log);
  EXPECT_TRUE(said.empty());
  folder.write("a.db3-wal", std::string(4152, 'w'));
  EXPECT_EQ(read_through(open_rosbag2_folder(folder.path(), {}, {.log = log})).scans.size(), 3U);
  EXPECT_THAT(said, ElementsAre(HasSubstr("a.db3-wal: the recorder's WAL is not read")));
}

TEST(Rosbag2, FilesThatWereCompressedAsAWholeAreNamed) {
  const TemporaryFolder folder;
  folder.write("rec_0.db3.zstd", pack(Packing::kZstd, bytes_of(db3_of(clouds(0, 2)))));
  const Outcome alone = read_through(open_rosbag2_folder(folder.path(), {}, {}));
  ASSERT_EQ(alone.errors.size(), 1U);
  EXPECT_EQ(alone.errors[0].code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(alone.errors[0]), HasSubstr("rec_0.db3.zstd:0: is compressed with zstd: unpack it"));
  folder.write("rec_1.db3", db3_of(clouds(2, 2)));  // the one that was written last
  const Outcome got = read_through(open_rosbag2_folder(folder.path(), {}, {}));
  EXPECT_THAT(got.points(), ElementsAre(3, 4));
  EXPECT_EQ(got.errors.size(), 1U);
}

TEST(Db3, OtherSerializationsAreNotRead) {
  const Outcome got = run_db3(db3_of(clouds(0, 2), {.serialization = "protobuf"}));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_THAT(got.errors[0].got, HasSubstr("serialization protobuf"));
}

TEST(Db3, R8RowsThatFitNothingAreErrorsAndTheNextIsRead) {
  const Outcome got =
      run_db3(db3_of(clouds(0, 4), {.more_sql = "UPDATE messages SET topic_id = 77 WHERE id = 2;"
                                                "UPDATE messages SET data = 'text' WHERE id = 3"}));
  EXPECT_THAT(got.points(), ElementsAre(1, 4));
  ASSERT_EQ(got.errors.size(), 2U);
  EXPECT_EQ(got.errors[0].where, "messages row 2+0");
  EXPECT_EQ(got.errors[0].got, "77");
  EXPECT_EQ(got.errors[1].where, "messages row 3+0");
}

TEST(Db3, APackedMessageThatTellsTooMuchIsRefused) {
  const std::string bomb = pack(Packing::kZstd, bytes_of(std::string(8U << 20U, '\0')));
  auto messages = clouds(0, 2);
  messages[0].data = bomb;
  const Outcome got = run_db3(db3_of(messages));
  EXPECT_THAT(got.points(), ElementsAre(2));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kLimit);
}

TEST(Rosbag2, R10AFolderNeedsNoMetadataAndItsFilesGoByNumber) {
  const TemporaryFolder folder;
  for (const std::uint32_t i : {0U, 2U, 10U}) {
    folder.write("rec_" + std::to_string(i) + ".db3", db3_of(clouds(2 * i, 2)));
  }
  folder.write("notes.txt", "no recording");
  const Outcome got = read_through(open_rosbag2_folder(folder.path(), {}, {}));
  EXPECT_TRUE(got.errors.empty());
  EXPECT_THAT(got.points(), ElementsAre(1, 2, 5, 6, 21, 22));
  EXPECT_EQ(got.counters.at("messages received"), 6U);
}

TEST(Rosbag2, FoldersOfMcapAreReadLikewise) {
  const TemporaryFolder folder;
  folder.write("rec_0.mcap", mcap_of(clouds(0, 2)));
  folder.write("rec_1.mcap", mcap_of(clouds(2, 2)));
  folder.write("metadata.yaml", "rosbag2_bagfile_information:\n");
  EXPECT_THAT(read_through(open_rosbag2_folder(folder.path(), {}, {})).points(), ElementsAre(1, 2, 3, 4));
}

TEST(Rosbag2, AFileOfTheFolderThatCannotBeReadIsAnErrorInItsPlace) {
  const TemporaryFolder folder;
  folder.write("rec_0.db3", db3_of(clouds(0, 2)));
  folder.write("rec_1.db3", "nothing");
  folder.write("rec_2.db3", db3_of(clouds(2, 1)));
  const Outcome got = read_through(open_rosbag2_folder(folder.path(), {}, {}));
  EXPECT_THAT(got.points(), ElementsAre(1, 2, 3));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_THAT(got.errors[0].file, HasSubstr("rec_1.db3"));
}

TEST(Rosbag2, AFolderWithoutARecordingIsUnusable) {
  const TemporaryFolder folder;
  const Outcome got = read_through(open_rosbag2_folder(folder.path(), {}, {}));
  ASSERT_EQ(got.errors.size(), 1U);
  EXPECT_EQ(got.errors[0].code, ErrorCode::kUnusable);
}

}  // namespace verge::io
