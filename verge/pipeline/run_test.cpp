// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/pipeline/run.hpp"

#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "verge/core/version.hpp"

namespace verge::pipeline {
namespace {

/// A scan of one ring whose only return stands `number` + 1 metres ahead, with one empty return.
Scan scan_number(std::size_t number) {
  const float x = static_cast<float>(number + 1);
  Scan scan;
  scan.frame = std::to_string(number);
  scan.stamp_ns = static_cast<std::int64_t>(number);
  scan.ring_begin = {0, 2};
  scan.x = {0.0F, x};
  scan.y = scan.z = scan.azimuth = scan.intensity = {0.0F, 0.0F};
  scan.range = {0.0F, x};
  scan.input_index = {0, 1};
  scan.dropped = 3;
  return scan;
}

/// Says one boundary as long as the scan's return is far; the later the scan, the sooner it is done, so that
/// results come out of order unless the run puts them back.
class Echo final : public detect::Detector {
 public:
  explicit Echo(detect::Order order) : order_(order) {}

  Scene process(const Scan& scan, Trace* trace) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(std::stoi(scan.frame) % 2 == 0 ? 4 : 0));
    {
      const std::scoped_lock lock(mutex_);
      seen_.push_back(scan.frame);
    }
    if (trace != nullptr) trace->values.push_back({"far", {static_cast<double>(scan.x.back())}});
    Scene scene;
    scene.boundaries.emplace_back().points = {{0, 0, 0}, scan.point(1)};
    return scene;
  }
  [[nodiscard]] detect::Order order() const override { return order_; }
  [[nodiscard]] const std::vector<std::string>& seen() const { return seen_; }

 private:
  detect::Order order_;
  std::mutex mutex_;
  std::vector<std::string> seen_;
};

Error damage(std::size_t number) {
  return {ErrorCode::kUnusable, std::to_string(number), "0", "is broken", {}, {}};
}

/// A recording of `count` scans in memory, and what a run writes of it.
struct Recording {
  std::size_t count = 0;
  std::set<std::size_t> broken{};
  std::size_t next = 0;
  std::vector<std::string> written{};
  std::vector<std::size_t> skipped{};
  std::atomic<bool> stop{false};
  Options options{
      .mount_hint = {1.5, 0.0, 0.01, 0.0}, .mount_config = {}, .method = "echo", .config_hash = "abc"};

  Expected<std::optional<Scan>> read() {
    if (next == count) return std::optional<Scan>{};
    const std::size_t number = next++;
    if (broken.contains(number)) return Unexpected(damage(number));
    return scan_number(number);
  }

  static Expected<std::string> record_of(const Frame& frame) {
    return frame.scene.frame + ":" + std::to_string(frame.scene.boundaries.at(0).points.at(1).x);
  }

  Ends ends() {
    return {.read = [this] { return read(); },
            .render = record_of,
            .write = [this](const Frame&, std::string&& record) -> Expected<void> {
              written.push_back(std::move(record));
              return {};
            },
            .skip = [this](std::size_t index, const Error&) { skipped.push_back(index); }};
  }

  Expected<Summary> run_on(detect::Detector& detector) { return run(ends(), detector, options, stop); }
};

std::vector<std::string> records_with(std::size_t threads, detect::Order order) {
  Recording recording{.count = 40, .broken = {0, 7, 39}};
  recording.options.threads = threads;
  Echo echo(order);
  EXPECT_TRUE(recording.run_on(echo).has_value());
  return recording.written;
}

TEST(Run, every_scan_comes_out_once_and_in_order_with_any_number_of_threads) {
  const auto alone = records_with(1, detect::Order::kIndependent);
  ASSERT_EQ(alone.size(), 37U);
  EXPECT_EQ(alone.front(), "1:2.000000");
  EXPECT_EQ(alone.back(), "38:39.000000");
  EXPECT_EQ(records_with(2, detect::Order::kIndependent), alone);
  EXPECT_EQ(records_with(4, detect::Order::kIndependent), alone);
  EXPECT_EQ(records_with(4, detect::Order::kSequential), alone);
}

TEST(Run, sequential_detector_sees_the_scans_in_order) {
  Recording recording{.count = 20};
  recording.options.threads = 4;
  Echo echo(detect::Order::kSequential);
  ASSERT_TRUE(recording.run_on(echo).has_value());
  ASSERT_EQ(echo.seen().size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(echo.seen()[i], std::to_string(i));
}

TEST(Run, counts_add_up) {
  Recording recording{.count = 5, .broken = {1}};
  Echo echo(detect::Order::kIndependent);
  const auto summary = recording.run_on(echo);
  ASSERT_TRUE(summary.has_value());
  EXPECT_EQ(summary->counts.scans, 4U);
  EXPECT_EQ(summary->counts.damaged, 1U);
  EXPECT_EQ(summary->counts.boundaries, 4U);
  EXPECT_FALSE(summary->interrupted);
  EXPECT_EQ(recording.skipped, std::vector<std::size_t>{1});
  EXPECT_EQ(summary->first_error->file, "1");
  EXPECT_EQ(summary->counts.points.received, 20U);
  EXPECT_EQ(summary->counts.points.used, 4U);
  EXPECT_EQ(summary->counts.points.not_finite, 12U);
  EXPECT_EQ(summary->counts.points.no_return, 4U);
  EXPECT_EQ(summary->mounts.size(), 4U);
  EXPECT_EQ(summary->times.size(), 4U);
}

TEST(Run, empty_recording_gives_an_empty_summary) {
  Recording recording;
  Echo echo(detect::Order::kIndependent);
  const auto summary = recording.run_on(echo);
  ASSERT_TRUE(summary.has_value());
  EXPECT_EQ(summary->counts.scans + summary->counts.damaged, 0U);
}

TEST(Run, scene_says_whose_it_is) {
  Recording recording{.count = 1};
  recording.options.trace = true;
  Echo echo(detect::Order::kIndependent);
  Ends ends = recording.ends();
  std::optional<Scene> scene;
  std::optional<double> traced;
  ends.write = [&](const Frame& frame, std::string&&) -> Expected<void> {
    scene = frame.scene;
    traced = frame.trace->find_values("far")->values.at(0);
    return {};
  };
  ASSERT_TRUE(run(ends, echo, recording.options, recording.stop).has_value());
  EXPECT_EQ(scene->frame, "0");
  EXPECT_EQ(scene->stamp_ns, 0);
  EXPECT_EQ(scene->method, "echo");
  EXPECT_EQ(scene->version, version());
  EXPECT_EQ(scene->config_hash, "abc");
  EXPECT_EQ(traced, 1.0);
}

TEST(Run, mount_is_the_hint_then_the_scans_own) {
  Recording recording{.count = 1};
  recording.options.mount_hint = {1.5, {}, {}, {}};
  Echo echo(detect::Order::kIndependent);
  Ends ends = recording.ends();
  ends.read = [&]() -> Expected<std::optional<Scan>> {
    auto next = recording.read();
    if (next && *next) (*next)->mount = Mount{9.0, 0.1, 0.2, 0.3};
    return next;
  };
  const auto summary = run(ends, echo, recording.options, recording.stop);
  ASSERT_TRUE(summary.has_value());
  EXPECT_EQ(summary->mounts.at(0), (Mount{1.5, 0.1, 0.2, 0.3}));
}

TEST(Run, stop_ends_it_after_the_scans_under_way) {
  Recording recording{.count = 1000};
  recording.options.threads = 2;
  Echo echo(detect::Order::kIndependent);
  Ends ends = recording.ends();
  ends.write = [&](const Frame&, std::string&& record) -> Expected<void> {
    recording.written.push_back(std::move(record));
    if (recording.written.size() == 5) recording.stop = true;
    return {};
  };
  const auto summary = run(ends, echo, recording.options, recording.stop);
  ASSERT_TRUE(summary.has_value());
  EXPECT_TRUE(summary->interrupted);
  EXPECT_GE(summary->counts.scans, 5U);
  EXPECT_LE(summary->counts.scans, 10U) << "more than the scans under way were taken on";
  EXPECT_EQ(summary->counts.scans, recording.written.size());
}

TEST(Run, failure_of_writing_ends_it_with_that_error_and_nothing_is_written_after) {
  Recording recording{.count = 1000};
  recording.options.threads = 2;
  Echo echo(detect::Order::kIndependent);
  Ends ends = recording.ends();
  ends.write = [&](const Frame& frame, std::string&& record) -> Expected<void> {
    if (frame.index == 3) return Unexpected({ErrorCode::kCannotWrite, "out", {}, "full", {}, {}});
    recording.written.push_back(std::move(record));
    return {};
  };
  const auto summary = run(ends, echo, recording.options, recording.stop);
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().code, ErrorCode::kCannotWrite);
  EXPECT_EQ(recording.written.size(), 3U);
  EXPECT_LT(recording.next, 20U);
}

TEST(Run, failure_of_rendering_stands_at_its_place_in_the_order) {
  Recording recording{.count = 30};
  recording.options.threads = 4;
  Echo echo(detect::Order::kIndependent);
  Ends ends = recording.ends();
  ends.render = [](const Frame& frame) -> Expected<std::string> {
    if (frame.index >= 6) return Unexpected({ErrorCode::kCannotWrite, frame.scan.frame, {}, "full", {}, {}});
    return Recording::record_of(frame);
  };
  const auto summary = run(ends, echo, recording.options, recording.stop);
  ASSERT_FALSE(summary.has_value());
  EXPECT_EQ(summary.error().file, "6");
  EXPECT_EQ(recording.written.size(), 6U);
}

TEST(Run, exception_of_a_detector_reaches_the_caller) {
  class Thrower final : public detect::Detector {
   public:
    Scene process(const Scan& /*scan*/, Trace* /*trace*/) override { throw std::bad_alloc(); }
    [[nodiscard]] detect::Order order() const override { return detect::Order::kIndependent; }
  };
  Recording recording{.count = 10};
  Thrower thrower;
  EXPECT_THROW((void)recording.run_on(thrower), std::bad_alloc);
}

}  // namespace
}  // namespace verge::pipeline
