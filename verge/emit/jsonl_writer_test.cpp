// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/jsonl_writer.hpp"

#include <array>
#include <csignal>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "verge/emit/scene_json.hpp"
#include "verge/emit/test_folder.hpp"

namespace verge::emit {
namespace {

using SceneWriterTest = TestFolder;

Scene named(const std::string& frame) {
  Scene scene;
  scene.frame = frame;
  return scene;
}

TEST_F(SceneWriterTest, AFileHoldsOneLineAScanAndAppearsWithFinish) {
  auto writer = SceneWriter::open(folder_ / "out.jsonl");
  ASSERT_TRUE(writer.has_value());
  ASSERT_TRUE(writer->write(named("a")) && writer->write(named("b")));
  EXPECT_FALSE(exists(folder_ / "out.jsonl"));
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(content(folder_ / "out.jsonl"),
            to_json_line(named("a")) + "\n" + to_json_line(named("b")) + "\n");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(SceneWriterTest, ADashIsStandardOutput) {
  const auto output = open_output("-");
  ASSERT_TRUE(output.has_value());
  EXPECT_TRUE(output->is_direct());
  EXPECT_FALSE(exists(std::filesystem::path("-")));
}

TEST_F(SceneWriterTest, NoScansGiveAnEmptyFile) {
  auto writer = SceneWriter::open(folder_ / "out.jsonl");
  ASSERT_TRUE(writer && writer->finish());
  EXPECT_EQ(content(folder_ / "out.jsonl"), "");
}

TEST_F(SceneWriterTest, WithoutFinishNothingIsLeft) {
  {
    auto writer = SceneWriter::open(folder_ / "out.jsonl");
    ASSERT_TRUE(writer && writer->write(named("a")));
  }
  EXPECT_EQ(entries(), 0U);
}

TEST_F(SceneWriterTest, AMissingFolderCannotBeWritten) {
  const auto writer = SceneWriter::open(folder_ / "none" / "out.jsonl");
  ASSERT_FALSE(writer.has_value());
  EXPECT_EQ(writer.error().code, ErrorCode::kCannotWrite);
}

TEST_F(SceneWriterTest, AFullDeviceIsAnErrorFromTheFirstLineOn) {
  auto writer = SceneWriter::open("/dev/full");
  ASSERT_TRUE(writer.has_value());
  EXPECT_EQ(writer->write(named("a")).error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(writer->finish().error().code, ErrorCode::kCannotWrite);
}

TEST_F(SceneWriterTest, APipeGetsEachLineAtOnceAndSaysWhenItsReaderHasGone) {
  std::signal(SIGPIPE, SIG_IGN);
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  auto writer = SceneWriter::open(pipe);
  ASSERT_TRUE(writer && writer->write(named("a")));
  std::array<char, 4096> bytes{};
  const ssize_t got = ::read(reader, bytes.data(), bytes.size());
  ASSERT_GT(got, 0);
  EXPECT_EQ(std::string(bytes.data(), static_cast<std::size_t>(got)), to_json_line(named("a")) + "\n");
  ::close(reader);
  EXPECT_EQ(writer->write(named("b")).error().code, ErrorCode::kReaderGone);
}

}  // namespace
}  // namespace verge::emit
