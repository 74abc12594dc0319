// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "verge/detect/gradient/boundaries.hpp"
#include "verge/detect/gradient/candidates.hpp"
#include "verge/detect/gradient/denoise.hpp"
#include "verge/detect/gradient/regions.hpp"
#include "verge/detect/gradient/scan_lines.hpp"
#include "verge/model/trace.hpp"
#include "verge/scan/mount.hpp"

namespace verge::detect::gradient {

/// Writes the method's intermediates into a Trace, in the sensor's frame; does nothing where there is no
/// trace.
class Recorder {
 public:
  Recorder(Trace* trace, const LevelFrame& frame) : trace_(trace), frame_(frame) {}

  void low(const std::vector<LowRing>& rings);
  void scan_lines(const std::vector<ScanLine>& lines);
  void candidates(const std::vector<ScanLine>& lines);
  void strands(const std::vector<Strand>& strands);
  void fitted(const std::vector<Fitted>& fitted);

 private:
  [[nodiscard]] Trace::Points& points_named(const char* name);
  [[nodiscard]] Trace::Values& values_named(const char* name);
  void add(Trace::Points& layer, Vec3 p_level, int group);
  void spline(const Fitted& fitted);

  Trace* trace_;
  const LevelFrame& frame_;
};

}  // namespace verge::detect::gradient
