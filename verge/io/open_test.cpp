// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "verge/io/source.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using testing::bytes_of;
using ::testing::ElementsAre;
using testing::floats;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::kitti_rings;
using testing::TemporaryFolder;

/// What came out of a source, one word a call: the frame, or the error's code as a number with '!'.
std::vector<std::string> outcomes(Source& source) {
  std::vector<std::string> words;
  while (true) {
    auto scan = source.next();
    if (!scan) {
      words.push_back("!" + std::to_string(static_cast<int>(scan.error().code)));
      continue;
    }
    if (!*scan) return words;
    words.push_back((*scan)->frame);
  }
}

std::string code(ErrorCode code) { return "!" + std::to_string(static_cast<int>(code)); }

}  // namespace

TEST(Open, OneFileGivesOneScan) {
  const TemporaryFolder folder;
  const auto path = folder.write("000042.bin", kitti_rings(4, 50));
  const auto source = open(path);
  ASSERT_TRUE(source) << to_string(source.error());
  EXPECT_EQ((*source)->info().format, Format::kKitti);
  EXPECT_THAT((*source)->info().files, ElementsAre(path));
  EXPECT_THAT(outcomes(**source), ElementsAre("000042"));
  EXPECT_FALSE((*source)->next().value());  // and the end stays the end
}

TEST(Open, AFolderGivesItsScansInOrderAndGoesOnAfterADamagedOne) {
  const TemporaryFolder folder;
  folder.write("10.bin", kitti_rings(4, 50));
  folder.write("9.bin", kitti_rings(4, 50));
  folder.write("8.bin", kitti_rings(4, 50).substr(1));
  folder.write("11.bin", "");
  std::filesystem::create_symlink("nowhere", folder.path() / "12.bin");
  const auto source = open(folder.path());
  ASSERT_TRUE(source) << to_string(source.error());
  EXPECT_THAT(outcomes(**source), ElementsAre(code(ErrorCode::kUnusable), "9", "10",
                                              code(ErrorCode::kUnusable), code(ErrorCode::kCannotOpen)));
}

TEST(Open, OnlyTheFramesAskedForAreRead) {
  const TemporaryFolder folder;
  for (int i = 0; i < 6; ++i) folder.write(std::to_string(i) + ".bin", kitti_rings(4, 50));
  const auto frames = [&](std::size_t begin, std::optional<std::size_t> end) {
    const auto source = open(folder.path(), {.frames_begin = begin, .frames_end = end});
    return outcomes(**source);
  };
  EXPECT_THAT(frames(2, 4), ElementsAre("2", "3"));
  EXPECT_THAT(frames(4, std::nullopt), ElementsAre("4", "5"));
  EXPECT_THAT(frames(0, 100), ::testing::SizeIs(6));
  EXPECT_THAT(frames(6, std::nullopt), IsEmpty());
  EXPECT_THAT(frames(3, 2), IsEmpty());
}

TEST(Open, PosesBelongToTheFileNotToItsPlaceInTheRange) {
  const TemporaryFolder folder;
  std::string poses;
  for (int i = 0; i < 6; ++i) {
    folder.write("velodyne/00000" + std::to_string(i) + ".bin", kitti_rings(4, 50));
    poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(i) + "\n";
  }
  folder.write("poses.txt", poses);
  folder.write("calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  const auto source = open(folder.path(), {.frames_begin = 3, .frames_end = 4});
  ASSERT_TRUE(source);
  const auto scan = (*source)->next();
  ASSERT_TRUE(scan && *scan && (*scan)->T_world_sensor);
  EXPECT_DOUBLE_EQ((*scan)->T_world_sensor->translation.x, 3.0);
  // One file of the folder knows its row too.
  const auto single = open(folder.path() / "velodyne/000005.bin");
  const auto last = (*single)->next();
  ASSERT_TRUE(last && *last && (*last)->T_world_sensor);
  EXPECT_DOUBLE_EQ((*last)->T_world_sensor->translation.x, 5.0);
}

TEST(Open, APathThatIsNotThereCannotBeOpened) {
  const auto source = open("/nowhere/at/all");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kCannotOpen);
}

TEST(Open, AFolderWhereNothingFitsSaysWhyForTheFirst) {
  const TemporaryFolder folder;
  folder.write("1.bin", "abc");
  folder.write("2.bin", "");
  const auto source = open(folder.path());
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(source.error()), HasSubstr("1.bin:"));
}

TEST(Open, APipeIsReadOnce) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string sent = kitti_rings(4, 50);
  std::thread writer([&] {
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    EXPECT_EQ(::write(fd, sent.data(), sent.size()), static_cast<ssize_t>(sent.size()));
    ::close(fd);
  });
  const auto source = open(path, {.timeout_ms = 10'000});
  writer.join();
  ASSERT_TRUE(source) << to_string(source.error());
  const auto scan = (*source)->next();
  ASSERT_TRUE(scan && *scan);
  EXPECT_EQ((*scan)->size(), 200U);
}

TEST(Open, NotesAreSaidOnceARecording) {
  const TemporaryFolder folder;
  for (int i = 0; i < 5; ++i) folder.write(std::to_string(i) + ".bin", kitti_rings(4, 50));
  std::vector<std::string> notes;
  const auto source =
      open(folder.path(), {.log = [&](LogLevel, std::string_view text) { notes.emplace_back(text); }});
  ASSERT_TRUE(source);
  EXPECT_EQ(outcomes(**source).size(), 5U);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("4 rings")));
}

TEST(Open, EveryCallHasTheSameBytesForTheSameFile) {
  const TemporaryFolder folder;
  folder.write("a.bin", kitti_rings(8, 300));
  folder.write("b.bin", kitti_rings(8, 300));
  const auto source = open(folder.path());
  const auto a = (*source)->next();
  const auto b = (*source)->next();
  ASSERT_TRUE(a && *a && b && *b);
  EXPECT_EQ((*a)->x, (*b)->x);
  EXPECT_EQ((*a)->input_index, (*b)->input_index);
  EXPECT_EQ((*a)->ring_begin, (*b)->ring_begin);
}

TEST(Decode, IsWhatOpenDoes) {
  const TemporaryFolder folder;
  const std::string bytes = kitti_rings(8, 300);
  const auto path = folder.write("a.bin", bytes);
  const auto decoded = decode(bytes_of(bytes), path.string());
  const auto source = open(path);
  const auto read = (*source)->next();
  ASSERT_TRUE(decoded && read && *read);
  EXPECT_EQ(decoded->x, (*read)->x);
  EXPECT_EQ(decoded->frame, (*read)->frame);
  EXPECT_EQ(decoded->ring_count(), 8U);
}

TEST(Decode, DenormalCoordinatesAreNone) {
  std::vector<float> values;
  for (int i = 0; i < 10; ++i) values.insert(values.end(), {5.0F, 1.0F, -1.0F, 0.5F});
  values[4] = 1e-40F;   // x of the second
  values[9] = -1e-42F;  // y of the third
  values[3] = 1e-40F;   // an intensity: nobody minds
  const auto scan = decode(bytes_of(floats(values)), "a.bin");
  ASSERT_TRUE(scan) << to_string(scan.error());
  EXPECT_EQ(scan->size(), 8U);
  EXPECT_EQ(scan->dropped, 2U);
}

TEST(Decode, AScanWithoutAnyUsablePointIsDamaged) {
  const auto scan = decode(bytes_of("x,y,z\nnan,1,1\n1,inf,1\n"), "a.csv");
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().code, ErrorCode::kDamaged);
  EXPECT_THAT(to_string(scan.error()), HasSubstr("no point can be used"));
}

}  // namespace verge::io
