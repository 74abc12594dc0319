// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "verge/core/error.hpp"
#include "verge/detect/detector.hpp"
#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"
#include "verge/pipeline/summary.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/scan.hpp"

namespace verge::pipeline {

/// What a run does with every scan.
struct Options {
  MountHint mount_hint;      ///< What is known of the mount; the rest is estimated from each scan.
  MountConfig mount_config;  ///< How it is estimated.
  bool trace = false;        ///< Keep the method's intermediates.
  std::size_t threads = 0;   ///< 0: as many as the machine has.
  std::string method;        ///< Name of the method, for Scene::method.
  std::string config_hash;   ///< Of everything that can change a result, for Scene::config_hash.
};

/// One scan on its way through.
struct Frame {
  std::size_t index = 0;  ///< Place in the recording, counted from 0; damaged scans have one too.
  Scan scan;              ///< Deskewed where its motion and times are known; with its mount.
  MountEstimate mount;
  Scene scene;
  std::optional<Trace> trace;
  StageTimes times;
};

/// The two ends of a run and what lies before the second. All are called once a scan.
struct Ends {
  /// The next scan, none at the end; in order, from one thread at a time.
  std::function<Expected<std::optional<Scan>>()> read;
  /// The record of a frame as bytes; from several threads at once, in any order (pictures are drawn here).
  std::function<Expected<std::string>(const Frame&)> render;
  /// Takes the record; in order, from one thread at a time.
  std::function<Expected<void>(const Frame&, std::string&& record)> write;
  /// Hears of a scan that cannot be used; in order, between the calls of write.
  std::function<void(std::size_t index, const Error&)> skip;
};

/// Takes every scan through deskewing, mount, detection and writing. Stages overlap: independent detectors
/// work on several scans at once, sequential ones on one after the other; the records and their order are
/// the same with any number of threads. At most two scans a thread are in memory.
///
/// A scan that cannot be read is counted and skipped. `stop` ends the run after the scans under way; what
/// they gave is written. Fails with the first error of `render` or `write`; nothing is written after it.
[[nodiscard]] Expected<Summary> run(const Ends& ends, detect::Detector& detector, const Options& options,
                                    const std::atomic<bool>& stop);

}  // namespace verge::pipeline
