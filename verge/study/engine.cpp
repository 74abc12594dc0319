// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/engine.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "verge/core/version.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/part_store.hpp"
#include "verge/study/parts.hpp"

namespace verge::study {
namespace {

/// A part of the work: one drive, or one labelled set, past some contestants.
struct Job {
  std::size_t cell = 0;
  std::uint64_t drive = 0;
  std::vector<eval::LabelledScan> known{};  ///< Of a labelled set.
  std::string settings{};                   ///< All that its results depend on but for the contestant.
  std::vector<std::size_t> contestants{};   ///< Whose results are not kept yet.
  std::size_t scans = 0;                    ///< That have to be made or read.
};

std::string text_of(const eval::SceneEvaluationConfig& config) {
  return fmt::format("{} {} {} {} {}", config.range_m, config.tolerance_m, config.any_side,
                     fmt::join(config.ranges_m, ","), fmt::join(config.tolerances_m, ","));
}

std::string text_of(const Judged& judged) {
  return fmt::format("{} {} {}", judged.boundaries, judged.corners, judged.objects);
}

/// Size and time of a file that is there.
std::string state_of(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(file, ignored);
  const auto time = std::filesystem::last_write_time(file, ignored);
  return fmt::format("{} {} {}\n", file.string(), size, time.time_since_epoch().count());
}

std::string settings_of(const Suite& suite, const std::string& salt) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n", version(), salt, suite.name, text_of(suite.evaluation),
                     text_of(suite.judged));
}

void add_drives(const Suite& suite, std::size_t cell, const MadeDrives& drives, const std::string& salt,
                std::vector<Job>& jobs) {
  for (std::uint64_t drive = 1; drive <= drives.drives; ++drive) {
    Job job{.cell = cell, .drive = drive};
    job.settings = settings_of(suite, salt) +
                   fmt::format("{} {} {} {}\n", drives.first_scan, drives.scans, drives.step, drives.lost);
    job.scans = drives.scans;
    jobs.push_back(std::move(job));
  }
}

Expected<void> add_set(const Suite& suite, std::size_t cell, const LabelledScans& set,
                       const std::string& salt, std::vector<Job>& jobs) {
  auto known = known_scans(set);
  if (!known) return Unexpected(std::move(known).error());
  Job job{.cell = cell, .known = *std::move(known)};
  job.settings =
      settings_of(suite, salt) + fmt::format("{} {} {} {}\n", set.odd_only, set.boxes, set.first, set.last);
  for (const eval::LabelledScan& scan : job.known)
    job.settings += state_of(scan.scan) + state_of(scan.labels);
  job.scans = job.known.size();
  jobs.push_back(std::move(job));
  return {};
}

Expected<std::vector<Job>> jobs_of(const Suite& suite, const std::string& salt) {
  std::vector<Job> jobs;
  for (std::size_t cell = 0; cell < suite.cells.size(); ++cell) {
    const auto& scans = suite.cells[cell].scans;
    if (const auto* drives = std::get_if<MadeDrives>(&scans)) {
      add_drives(suite, cell, *drives, salt, jobs);
    } else if (auto added = add_set(suite, cell, std::get<LabelledScans>(scans), salt, jobs); !added) {
      return Unexpected(std::move(added).error());
    }
  }
  return jobs;
}

std::optional<Error> misuse_in(const Suite& suite) {
  const auto error = [](std::string what) {
    return Error{ErrorCode::kUsage, {}, {}, std::move(what), {}, {}};
  };
  const auto labelled = std::ranges::count_if(suite.cells, is_labelled);
  if (labelled != 0 && labelled != std::ssize(suite.cells))
    return error("a suite is of drives or of labelled sets, not of both");
  return std::nullopt;
}

/// One run of a suite from its jobs to its results.
class Run {
 public:
  Run(Results& results, std::vector<Job> jobs, PartStore store, const RunHooks& hooks,
      const std::atomic<bool>& stop)
      : results_(results),
        jobs_(std::move(jobs)),
        store_(std::move(store)),
        hooks_(hooks),
        stop_(stop),
        tallies_(jobs_.size() * results.contestants.size()) {
    for (std::size_t job = 0; job < jobs_.size(); ++job) take_kept(job);
  }

  [[nodiscard]] Expected<void> run(std::size_t threads) {
    tbb::task_arena arena(static_cast<int>(threads));
    const auto worker = [this](std::size_t) {
      // What a job itself does in parallel must not take up another job while it waits.
      for (std::size_t job = next_++; job < jobs_.size() && goes_on(); job = next_++)
        tbb::this_task_arena::isolate([&] { guarded_work(job); });
    };
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, threads, worker, tbb::simple_partitioner()); });
    if (thrown_) std::rethrow_exception(thrown_);
    if (failure_) return Unexpected(*std::move(failure_));
    sum_up();
    return {};
  }

 private:
  [[nodiscard]] std::optional<Tally>& slot(std::size_t job, std::size_t contestant) {
    return tallies_[job * results_.contestants.size() + contestant];
  }

  [[nodiscard]] PartKey key_of(const Job& job, const Contestant& contestant) const {
    const std::string drive = job.drive == 0 ? std::string() : fmt::format(" {}", job.drive);
    return {fmt::format("{} {}{} {}", results_.suite.name, results_.suite.cells[job.cell].name, drive,
                        contestant.name),
            job.settings + settings_text(contestant)};
  }

  void take_kept(std::size_t index) {
    Job& job = jobs_[index];
    for (std::size_t i = 0; i < results_.contestants.size(); ++i) {
      const Contestant& contestant = results_.contestants[i];
      if (!contestant.predictions) slot(index, i) = store_.find(key_of(job, contestant), hooks_.warning);
      if (!slot(index, i)) job.contestants.push_back(i);
    }
    // The scans of a drive are made once for all contestants, those of a set are read once for each.
    const std::size_t readings = job.drive == 0 ? methods_in(job) : job.contestants.empty() ? 0 : 1;
    total_ += readings * job.scans;
  }

  [[nodiscard]] std::size_t methods_in(const Job& job) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        job.contestants, [this](std::size_t i) { return !results_.contestants[i].predictions; }));
  }

  [[nodiscard]] bool goes_on() const { return !stop_.load() && !failed_.load(); }

  void guarded_work(std::size_t index) {
    try {
      work(index);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      failed_.store(true);
    }
  }

  void work(std::size_t index) {
    const Job& job = jobs_[index];
    if (job.contestants.empty()) return;
    const PartHooks hooks{stop_, [this] { count_scan(); }, [this](const std::string& text) { warn(text); }};
    const Cell& cell = results_.suite.cells[job.cell];
    if (const auto* set = std::get_if<LabelledScans>(&cell.scans)) {
      work_on_set(index, *set, hooks);
    } else {
      work_on_drive(index, cell, hooks);
    }
  }

  void work_on_drive(std::size_t index, const Cell& cell, const PartHooks& hooks) {
    const Job& job = jobs_[index];
    std::vector<const Contestant*> contestants;
    for (const std::size_t i : job.contestants) contestants.push_back(&results_.contestants[i]);
    auto tallies = judge_drive(results_.suite, cell, job.drive, contestants, hooks);
    if (!tallies) return;
    for (std::size_t i = 0; i < tallies->size(); ++i)
      finish(index, job.contestants[i], std::move((*tallies)[i]));
  }

  void work_on_set(std::size_t index, const LabelledScans& set, const PartHooks& hooks) {
    const Job& job = jobs_[index];
    for (const std::size_t i : job.contestants) {
      auto tally = judge_labelled(set, job.known, results_.contestants[i], hooks);
      if (!tally) return fail(std::move(tally).error());
      if (*tally) finish(index, i, **std::move(tally));
    }
  }

  void finish(std::size_t index, std::size_t contestant, Tally tally) {
    if (!results_.contestants[contestant].predictions) {
      auto kept = store_.keep(key_of(jobs_[index], results_.contestants[contestant]), tally);
      if (!kept) return fail(std::move(kept).error());
    }
    slot(index, contestant) = std::move(tally);
  }

  void count_scan() {
    const std::scoped_lock lock(mutex_);
    hooks_.progress(++done_, total_);
  }

  void warn(const std::string& text) {
    const std::scoped_lock lock(mutex_);
    hooks_.warning(text);
  }

  void fail(Error error) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::move(error);
    failed_.store(true);
  }

  /// In the order of the jobs, so that sums of floating-point numbers do not depend on who was first.
  void sum_up() {
    results_.tallies.resize(results_.suite.cells.size() * results_.contestants.size());
    for (std::size_t job = 0; job < jobs_.size(); ++job) {
      for (std::size_t i = 0; i < results_.contestants.size(); ++i) {
        ++results_.parts;
        if (!slot(job, i)) continue;
        ++results_.parts_done;
        results_.tallies[jobs_[job].cell * results_.contestants.size() + i] += *slot(job, i);
      }
    }
  }

  Results& results_;
  std::vector<Job> jobs_;
  PartStore store_;
  const RunHooks& hooks_;
  const std::atomic<bool>& stop_;
  std::vector<std::optional<Tally>> tallies_;  // job by job, contestant by contestant
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;  // of all below
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::optional<Error> failure_;
  std::exception_ptr thrown_;
};

std::size_t threads_of(const RunOptions& options) {
  if (options.jobs > 0) return options.jobs;
  return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

}  // namespace

Expected<Results> run(Suite suite, std::vector<Contestant> contestants, const RunOptions& options,
                      const RunHooks& hooks, const std::atomic<bool>& stop) {
  if (auto misuse = misuse_in(suite)) return Unexpected(*std::move(misuse));
  auto jobs = jobs_of(suite, options.salt);
  if (!jobs) return Unexpected(std::move(jobs).error());
  PartStore store;
  if (options.keep_in) {
    auto opened = PartStore::open(*options.keep_in);
    if (!opened) return Unexpected(std::move(opened).error());
    store = *std::move(opened);
  }
  Results results{.suite = std::move(suite), .contestants = std::move(contestants)};
  Run work(results, *std::move(jobs), std::move(store), hooks, stop);
  if (auto done = work.run(threads_of(options)); !done) return Unexpected(std::move(done).error());
  return results;
}

}  // namespace verge::study
