// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/files.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "verge/io/sniff.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::vector<std::string> names_of(const ScanFiles& files) {
  std::vector<std::string> names;
  for (const auto& file : files.files) names.push_back(file.filename().string());
  return names;
}

std::string some_name() {
  std::string name;
  for (const char c : *rc::gen::container<std::string>(rc::gen::element('0', '1', '2', '9', 'a', '.', '_')))
    name += c;
  return name;
}

}  // namespace

TEST(NaturalLess, NumbersCountAsNumbers) {
  std::vector<std::string> names{"10.bin", "9.bin", "scan100", "scan20", "02.bin",
                                 "2.bin",  "a",     "",        "2a",     "2"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_THAT(names,
              ElementsAre("", "2", "02.bin", "2.bin", "2a", "9.bin", "10.bin", "a", "scan20", "scan100"));
  EXPECT_TRUE(natural_less("99999999999999999999998", "99999999999999999999999"));  // beyond 64 bits
}

RC_GTEST_PROP(NaturalLess, IsATotalOrder, ()) {
  const std::string a = some_name();
  const std::string b = some_name();
  const std::string c = some_name();
  RC_ASSERT(!natural_less(a, a));
  RC_ASSERT((a == b) == (!natural_less(a, b) && !natural_less(b, a)));
  RC_ASSERT(!(natural_less(a, b) && natural_less(b, a)));
  if (natural_less(a, b) && natural_less(b, c)) RC_ASSERT(natural_less(a, c));
}

TEST(FrameName, IsTheNameWithoutItsSuffix) {
  EXPECT_EQ(frame_name("a/000123.bin"), "000123");
  EXPECT_EQ(frame_name("n015-2018__LIDAR_TOP__1531883530.pcd.bin"), "n015-2018__LIDAR_TOP__1531883530");
  EXPECT_EQ(frame_name("scan.v2.pcd"), "scan.v2");
  EXPECT_EQ(frame_name("SCAN.PCD"), "SCAN");
  EXPECT_EQ(frame_name("/dev/stdin"), "stdin");
}

TEST(FindScanFiles, TakesScansInNaturalOrderAndLeavesOtherFilesAlone) {
  const TemporaryFolder folder;
  for (const char* name : {"10.pcd", "9.pcd", "README.md", "9.label", "poses.txt", "index.csv"})
    folder.write(name, "x");
  std::filesystem::create_directory(folder.path() / "8.pcd");  // a folder is no scan, whatever its name
  std::filesystem::create_symlink("nowhere", folder.path() / "11.pcd");
  const auto files = find_scan_files(folder.path(), std::nullopt);
  ASSERT_TRUE(files) << to_string(files.error());
  EXPECT_THAT(names_of(*files), ElementsAre("9.pcd", "10.pcd", "11.pcd"));
}

TEST(FindScanFiles, TablesCountWhereThereIsNothingElse) {
  const TemporaryFolder folder;
  folder.write("1.csv", "x");
  EXPECT_THAT(names_of(find_scan_files(folder.path(), std::nullopt).value()), ElementsAre("1.csv"));
}

TEST(FindScanFiles, TwoFormatsHaveToBeChosenFrom) {
  const TemporaryFolder folder;
  folder.write("1.bin", "x");
  folder.write("1.ply", "x");
  const auto files = find_scan_files(folder.path(), std::nullopt);
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, ErrorCode::kUsage);
  EXPECT_THAT(to_string(files.error()), HasSubstr("1 .bin, 1 .ply"));
  EXPECT_THAT(names_of(find_scan_files(folder.path(), Format::kPly).value()), ElementsAre("1.ply"));
  EXPECT_THAT(names_of(find_scan_files(folder.path(), Format::kNuscenes).value()), ElementsAre("1.bin"));
}

TEST(FindScanFiles, GoesToTheDataSetsOwnFolder) {
  for (const char* below : {"velodyne", "velodyne_points/data", "LIDAR_TOP", "samples/LIDAR_TOP"}) {
    const TemporaryFolder folder;
    folder.write(std::filesystem::path(below) / "1.bin", "x");
    folder.write("poses.txt", "x");
    const auto files = find_scan_files(folder.path(), std::nullopt);
    ASSERT_TRUE(files) << below;
    EXPECT_EQ(files->folder, folder.path() / below);
  }
}

TEST(FindScanFiles, AFolderWithoutScansSaysWhatWasLookedFor) {
  const TemporaryFolder folder;
  folder.write("a.txt", "x");
  const auto files = find_scan_files(folder.path(), std::nullopt);
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, ErrorCode::kUnusable);
  EXPECT_THAT(to_string(files.error()), HasSubstr(".pcd.bin"));
  EXPECT_THAT(to_string(find_scan_files(folder.path(), Format::kPly).error()), HasSubstr(".ply"));
}

}  // namespace verge::io
