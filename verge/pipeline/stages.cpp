// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/pipeline/stages.hpp"

#include <utility>

#include "verge/core/version.hpp"

namespace verge::pipeline {
namespace {

bool hints_say_all(const MountHint& hint) {
  return hint.height_m && hint.pitch_rad && hint.roll_rad && hint.forward_rad;
}

/// What the caller knows goes first, then what the scan itself says.
MountHint merged(const MountHint& hint, const std::optional<Mount>& own) {
  if (!own) return hint;
  return {hint.height_m.value_or(own->height_m), hint.pitch_rad.value_or(own->pitch_rad),
          hint.roll_rad.value_or(own->roll_rad), hint.forward_rad.value_or(own->forward_rad)};
}

MountEstimate mount_of(const Scan& scan, const Options& options) {
  const MountHint hint = merged(options.mount_hint, scan.mount);
  if (!hints_say_all(hint)) return estimate_mount(scan, hint, options.mount_config);
  return {{*hint.height_m, *hint.pitch_rad, *hint.roll_rad, *hint.forward_rad}, 0.0, true, true};
}

}  // namespace

void prepare(Frame& frame, const Options& options) {
  frame.scan = deskew(std::move(frame.scan));
  frame.mount = mount_of(frame.scan, options);
  frame.scan.mount = frame.mount.mount;
}

void detect_on(Frame& frame, detect::Detector& detector, const Options& options) {
  if (options.trace) frame.trace.emplace();
  frame.scene = detector.process(frame.scan, frame.trace ? &*frame.trace : nullptr);
  frame.scene.frame = frame.scan.frame;
  frame.scene.frame_id = frame.scan.frame_id;
  frame.scene.stamp_ns = frame.scan.stamp_ns;
  frame.scene.method = options.method;
  frame.scene.version = version();
  frame.scene.config_hash = options.config_hash;
}

}  // namespace verge::pipeline
