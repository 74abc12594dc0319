// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/atomic_file.hpp"

#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace verge {
namespace {
namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("atomic_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsOnlyWithCommit) {
  const fs::path target = folder_ / "out.txt";
  auto file = AtomicFile::create(target);
  ASSERT_TRUE(file.has_value());
  ASSERT_TRUE(file->write("hello").has_value());
  EXPECT_FALSE(fs::exists(target));
  ASSERT_TRUE(file->commit().has_value());
  EXPECT_EQ(content(target), "hello");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldFileStaysAndNothingIsLeft) {
  const fs::path target = folder_ / "out.txt";
  ASSERT_TRUE(write_file(target, "old").has_value());
  {
    auto file = AtomicFile::create(target);
    ASSERT_TRUE(file.has_value());
    ASSERT_TRUE(file->write(std::string(200'000, 'n')).has_value());
  }
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicFileTest, AFullDiskLeavesTheOldFile) {
  const fs::path target = folder_ / "out.txt";
  ASSERT_TRUE(write_file(target, "old").has_value());
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto result = write_file(target, std::string(100'000, 'n'));
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicFileTest, AFullDeviceIsAnError) {
  const auto result = write_file("/dev/full", "x");
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::kCannotWrite);
}

TEST_F(AtomicFileTest, APipeWhoseReaderHasGoneIsItsOwnOutcome) {
  std::signal(SIGPIPE, SIG_IGN);
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  auto file = AtomicFile::create(pipe);
  ASSERT_TRUE(file.has_value());
  ::close(reader);
  ASSERT_TRUE(file->write("nobody listens").has_value());
  EXPECT_EQ(file->flush().error().code, ErrorCode::kReaderGone);
  EXPECT_EQ(file->commit().error().code, ErrorCode::kReaderGone);
}

TEST_F(AtomicFileTest, AMissingFolderAndAFolderAsTargetAreErrors) {
  EXPECT_FALSE(write_file(folder_ / "none" / "out.txt", "x").has_value());
  EXPECT_FALSE(write_file(folder_, "x").has_value());
}

TEST_F(AtomicFileTest, ALinkStaysALink) {
  ASSERT_TRUE(write_file(folder_ / "real.txt", "old").has_value());
  fs::create_symlink(folder_ / "real.txt", folder_ / "link.txt");
  ASSERT_TRUE(write_file(folder_ / "link.txt", "new").has_value());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(content(folder_ / "real.txt"), "new");
}

TEST_F(AtomicFileTest, TheLongestNameWorks) {
  const fs::path target = folder_ / std::string(255, 'a');
  EXPECT_TRUE(write_file(target, "x").has_value());
  EXPECT_FALSE(write_file(folder_ / std::string(256, 'a'), "x").has_value());
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicFileTest, StandardOutputIsAppendedToAndNeverRenamedOver) {
  const fs::path target = folder_ / "redirected.txt";
  const int saved = ::dup(STDOUT_FILENO);
  const int fd = ::open(target.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ASSERT_GE(fd, 0);
  ::fflush(stdout);
  ::dup2(fd, STDOUT_FILENO);
  for (const auto* text : {"one ", "two"}) {
    auto file = AtomicFile::standard_output();
    EXPECT_TRUE(file && file->is_direct() && file->write(text) && file->commit());
  }
  ::dup2(saved, STDOUT_FILENO);
  ::close(saved);
  ::close(fd);
  EXPECT_EQ(content(target), "one two");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(AtomicFileTest, FileMarkedReadOnlyIsKept) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write every file";
  const fs::path target = folder_ / "kept.txt";
  ASSERT_TRUE(write_file(target, "old").has_value());
  fs::permissions(target, fs::perms::owner_read);
  const auto written = write_file(target, "new");
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(content(target), "old");
}

}  // namespace
}  // namespace verge
