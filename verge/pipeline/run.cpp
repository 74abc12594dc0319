// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/pipeline/run.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "verge/pipeline/stages.hpp"

namespace verge::pipeline {
namespace {

/// What travels from stage to stage: a frame with its record, or why there is none.
struct Item {
  Frame frame;
  std::string record;
  std::optional<Error> damage;   // the scan could not be read
  std::optional<Error> failure;  // its record could not be made
};

using ItemPtr = std::shared_ptr<Item>;

/// Seconds that `action` takes.
template <class Action>
double timed(Action&& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void render(Item& item, const Ends& ends) {
  auto record = ends.render(item.frame);
  if (record) {
    item.record = *std::move(record);
  } else {
    item.failure = std::move(record).error();
  }
}

/// The serial ends of the run and what they remember; the stages between hold no state.
class Run {
 public:
  Run(const Ends& ends, const std::atomic<bool>& stop) : ends_(ends), stop_(stop) {}

  /// The next scan, or null where the run ends.
  [[nodiscard]] ItemPtr read() {
    if (failed_.load()) return nullptr;
    if (stop_.load()) {
      summary_.interrupted = true;
      return nullptr;
    }
    Expected<std::optional<Scan>> next;
    const double read_s = timed([&] { next = ends_.read(); });
    if (next && !*next) return nullptr;
    auto item = std::make_shared<Item>();
    item->frame.index = index_++;
    item->frame.times.read_s = read_s;
    if (next) {
      item->frame.scan = *std::move(*next);
    } else {
      item->damage = std::move(next).error();
    }
    return item;
  }

  void write(Item& item) {
    if (failed_.load()) return;
    if (item.damage) return count_damage(item);
    if (!item.failure) write_record(item);
    if (!item.failure) return count_frame(item.frame);
    failure_ = std::move(item.failure);
    failed_.store(true);
  }

  [[nodiscard]] Expected<Summary> result() && {
    if (failure_) return Unexpected(*std::move(failure_));
    return std::move(summary_);
  }

 private:
  void write_record(Item& item) {
    Expected<void> written;
    item.frame.times.write_s += timed([&] { written = ends_.write(item.frame, std::move(item.record)); });
    if (!written) item.failure = std::move(written).error();
  }

  void count_damage(const Item& item) {
    ++summary_.counts.damaged;
    if (!summary_.first_error) summary_.first_error = item.damage;
    ends_.skip(item.frame.index, *item.damage);
  }

  void count_frame(const Frame& frame) {
    add(summary_.counts, frame.scan, frame.scene);
    summary_.mounts.push_back(frame.mount.mount);
    summary_.times.push_back(frame.times);
  }

  const Ends& ends_;
  const std::atomic<bool>& stop_;
  std::atomic<bool> failed_{false};
  std::size_t index_ = 0;
  std::optional<Error> failure_;
  Summary summary_;
};

constexpr auto kParallelism = tbb::global_control::max_allowed_parallelism;

std::size_t thread_count(const Options& options) {
  if (options.threads > 0) return options.threads;
  return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

/// A stage on items that hold a scan; damaged ones pass it by.
template <class Stage>
auto filter(tbb::filter_mode mode, Stage stage) {
  return tbb::make_filter<ItemPtr, ItemPtr>(mode, [stage](ItemPtr item) {
    if (!item->damage) stage(*item);
    return item;
  });
}

tbb::filter<void, void> chain(Run& state, const Ends& ends, detect::Detector& detector,
                              const Options& options) {
  const auto detect_mode = detector.order() == detect::Order::kIndependent
                               ? tbb::filter_mode::parallel
                               : tbb::filter_mode::serial_in_order;
  const auto read = tbb::make_filter<void, ItemPtr>(tbb::filter_mode::serial_in_order,
                                                    [&state](tbb::flow_control& control) {
                                                      ItemPtr item = state.read();
                                                      if (!item) control.stop();
                                                      return item;
                                                    });
  const auto prepared = filter(tbb::filter_mode::parallel, [&options](Item& item) {
    item.frame.times.mount_s = timed([&] { prepare(item.frame, options); });
  });
  const auto detected = filter(detect_mode, [&detector, &options](Item& item) {
    item.frame.times.detect_s = timed([&] { detect_on(item.frame, detector, options); });
  });
  const auto rendered = filter(tbb::filter_mode::parallel, [&ends](Item& item) {
    item.frame.times.write_s = timed([&] { render(item, ends); });
  });
  const auto written = tbb::make_filter<ItemPtr, void>(tbb::filter_mode::serial_in_order,
                                                       [&state](const ItemPtr& item) { state.write(*item); });
  return read & prepared & detected & rendered & written;
}

}  // namespace

Expected<Summary> run(const Ends& ends, detect::Detector& detector, const Options& options,
                      const std::atomic<bool>& stop) {
  const std::size_t threads = thread_count(options);
  Run state(ends, stop);
  // More threads than the machine has must be asked for; for the time of this run only.
  const std::size_t most = std::max(threads, tbb::global_control::active_value(kParallelism));
  const tbb::global_control allowed(kParallelism, most);
  // An arena of its own limits this run alone, not the whole process.
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_pipeline(2 * threads, chain(state, ends, detector, options)); });
  return std::move(state).result();
}

}  // namespace verge::pipeline
