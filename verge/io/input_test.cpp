// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/input.hpp"

#include <cerrno>
#include <chrono>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "verge/io/test_files.hpp"
#include "verge/io/text.hpp"

namespace verge::io {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr std::string_view kText = "0123456789abcdef";

InputLimits quick() { return {.memory_max_bytes = 64ULL << 20U, .timeout_ms = 50}; }

/// The disk's third call fails; what came before is good.
ssize_t failing_pread(int fd, void* buffer, std::size_t count, off_t offset) {
  if (offset >= 8) {
    errno = EIO;
    return -1;
  }
  return ::pread(fd, buffer, std::min<std::size_t>(count, 4), offset);
}

/// Somebody empties the file behind the first 4 bytes while it is read.
ssize_t shrinking_pread(int fd, void* buffer, std::size_t count, off_t offset) {
  return offset >= 4 ? 0 : ::pread(fd, buffer, std::min<std::size_t>(count, 4), offset);
}

/// A signal comes before every byte.
ssize_t interrupted_pread(int fd, void* buffer, std::size_t count, off_t offset) {
  static thread_local bool interrupt = false;
  interrupt = !interrupt;
  if (interrupt) {
    errno = EINTR;
    return -1;
  }
  return ::pread(fd, buffer, std::min<std::size_t>(count, 1), offset);
}

}  // namespace

TEST(Input, AFileIsReadWhereItIsAsked) {
  const TemporaryFolder folder;
  auto input = Input::open(folder.write("a", kText), {});
  ASSERT_TRUE(input);
  EXPECT_EQ(input->size(), kText.size());
  const auto middle = input->read(4, 6);
  ASSERT_TRUE(middle);
  EXPECT_EQ(as_text(*middle), "456789");
  EXPECT_EQ(as_text(input->head(3).value()), "012");
  EXPECT_EQ(as_text(input->head(100).value()), kText);
}

TEST(Input, MemoryIsReadWhereItStands) {
  Input input = Input::of(testing::bytes_of(kText), "memory");
  const auto middle = input.read(4, 6);
  ASSERT_TRUE(middle);
  EXPECT_EQ(as_text(*middle).data(), kText.data() + 4);
}

TEST(Input, AMissingFileAFolderAndALinkLoopCannotBeOpened) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  for (const auto& path : {folder.path() / "missing", folder.path(), folder.path() / "loop",
                           std::filesystem::path(std::string(4096, 'a'))}) {
    const auto input = Input::open(path, {});
    ASSERT_FALSE(input) << path;
    EXPECT_EQ(input.error().code, ErrorCode::kCannotOpen) << path;
    EXPECT_EQ(input.error().file, path.string());
  }
}

TEST(Input, AFileThatShrinksWhileItIsReadIsDamagedWhereItEnds) {
  const TemporaryFolder folder;
  auto input = Input::open(folder.write("a", kText), {.pread = &shrinking_pread});
  ASSERT_TRUE(input);
  const auto bytes = input->read(0, input->size());
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(bytes.error().where, "4");
}

TEST(Input, ATruncatedFileIsDamagedAndDoesNotKill) {
  const TemporaryFolder folder;
  const auto path = folder.write("a", kText);
  auto input = Input::open(path, {});
  ASSERT_TRUE(input);
  std::filesystem::resize_file(path, 5);
  const auto bytes = input->read(0, input->size());
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(bytes.error().where, "5");
}

TEST(Input, AFileThatGrowsCountsAsLongAsItWas) {
  const TemporaryFolder folder;
  const auto path = folder.write("a", kText);
  auto input = Input::open(path, {});
  ASSERT_TRUE(input);
  std::filesystem::resize_file(path, 1000);
  EXPECT_EQ(input->size(), kText.size());
  EXPECT_EQ(as_text(input->head(1000).value()), kText);
}

TEST(Input, AnErrorOfTheDiskIsDamageAtItsOffset) {
  const TemporaryFolder folder;
  auto input = Input::open(folder.write("a", kText), {.pread = &failing_pread});
  ASSERT_TRUE(input);
  const auto bytes = input->read(0, input->size());
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(bytes.error().where, "8");
  EXPECT_THAT(bytes.error().what, HasSubstr("cannot read"));
}

TEST(Input, ASignalDoesNotDisturbReading) {
  const TemporaryFolder folder;
  auto input = Input::open(folder.write("a", kText), {.pread = &interrupted_pread});
  ASSERT_TRUE(input);
  EXPECT_EQ(as_text(input->head(100).value()), kText);
}

TEST(Input, APipeThatNobodyWritesTimesOut) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const auto before = std::chrono::steady_clock::now();
  const auto input = Input::open(path, quick());
  const auto waited = std::chrono::steady_clock::now() - before;
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().code, ErrorCode::kTimeout);
  EXPECT_GE(waited, std::chrono::milliseconds(50));
  EXPECT_LT(waited, std::chrono::seconds(10));
}

TEST(Input, APipeIsReadToItsEnd) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string sent(300'000, 'x');  // more than a pipe holds, more than the first buffer
  std::thread writer([&] {
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    std::size_t done = 0;
    while (done < sent.size()) {
      const ssize_t n = ::write(fd, sent.data() + done, sent.size() - done);
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    ::close(fd);
  });
  auto input = Input::open(path, {.timeout_ms = 10'000});
  writer.join();
  ASSERT_TRUE(input) << to_string(input.error());
  EXPECT_EQ(as_text(input->read(0, input->size()).value()), sent);
}

TEST(Input, AnEndlessDeviceHitsTheLimit) {
  const auto input = Input::open("/dev/zero", {.memory_max_bytes = 4ULL << 20U});
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().code, ErrorCode::kLimit);
}

TEST(Input, AnEmptyDeviceIsEmpty) {
  const auto input = Input::open("/dev/null", {});
  ASSERT_TRUE(input);
  EXPECT_EQ(input->size(), 0U);
}

TEST(Input, BytesBeyond4GiBAreReadWithoutTheRest) {
  const TemporaryFolder folder;
  const auto path = folder.write("sparse", "");
  constexpr std::uint64_t kSize = 5ULL << 30U;
  std::filesystem::resize_file(path, kSize);
  {
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    ASSERT_EQ(::pwrite(fd, "tail", 4, static_cast<off_t>(kSize - 4)), 4);
    ::close(fd);
  }
  auto input = Input::open(path, quick());
  ASSERT_TRUE(input);
  EXPECT_EQ(as_text(input->read(kSize - 4, 4).value()), "tail");
  const auto all = input->read(0, kSize);
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().code, ErrorCode::kLimit);
}

TEST(Input, MemoryIsAllowedByTheCeilingAndByTheSize) {
  const std::string mebibyte(1U << 20U, '\0');
  const Input input = Input::of(testing::bytes_of(mebibyte), "m", {.memory_max_bytes = 64ULL << 20U});
  EXPECT_TRUE(input.allow(100'000, 1U << 20U));
  EXPECT_FALSE(input.allow(1'000'000, 0));  // 128 MB > 64 MiB
  EXPECT_FALSE(input.allow(~0ULL, ~0ULL));  // no overflow
  const Input small = Input::of({}, "s", {});
  EXPECT_TRUE(small.allow(131'072, 0));  // 16 MiB are free
  EXPECT_FALSE(small.allow(131'073, 0));
  EXPECT_EQ(small.allow(131'073, 0).error().code, ErrorCode::kLimit);
}

TEST(Input, TheBufferGoesToTheNextInput) {
  const TemporaryFolder folder;
  auto first = Input::open(folder.write("a", kText), {});
  ASSERT_TRUE(first);
  const std::byte* place = first->head(16).value().data();
  auto second = Input::open(folder.write("b", kText), {}, std::move(*first).take_buffer());
  ASSERT_TRUE(second);
  EXPECT_EQ(second->head(16).value().data(), place);
}

}  // namespace verge::io
