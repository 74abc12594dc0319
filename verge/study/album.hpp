// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/detect/detector.hpp"
#include "verge/emit/bev_plot.hpp"
#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"
#include "verge/pipeline/run.hpp"
#include "verge/scan/scan.hpp"
#include "verge/study/report.hpp"

// What the pictures of a report share.

namespace verge::study {

/// What a detector makes of a frame whose scan is prepared (pipeline::prepare), with its trace.
void detect_traced(pipeline::Frame& frame, detect::Detector& detector, const std::string& method);

/// The layers of points of these names, and the lines whose names begin with one of `lines`.
[[nodiscard]] Trace only(const Trace& all, std::initializer_list<std::string_view> points,
                         std::initializer_list<std::string_view> lines = {});

/// How far a picture reaches.
struct Reach {
  double ahead_m = 0.0;
  double behind_m = 2.0;
  double side_m = 0.0;
};

/// A bird's-eye picture of a report, heading up. Fails as emit::BevPlot::png().
[[nodiscard]] Expected<Picture> from_above(std::string caption, const emit::BevContent& content,
                                           const Reach& reach);

/// Pictures of one scan, until one of them fails. The scan must live as long.
class Album {
 public:
  explicit Album(const Scan& scan);

  /// Layers of a trace alone.
  void layers(std::string caption, const Trace& trace, const Reach& reach);

  /// The whole scan with what was found in it, and what is true.
  void found(std::string caption, const Scene& scene, const Scene* truth, const Reach& reach);

  /// A picture that was made elsewhere.
  void add(std::string caption, Expected<std::string> png);

  /// All of them in their order; fails as the first one that failed.
  [[nodiscard]] Expected<std::vector<Picture>> finish();

 private:
  void add(Expected<Picture> picture);

  const Scan& scan_;
  Scan bare_;  ///< The same without its points.
  std::vector<Picture> pictures_;
  std::optional<Error> fault_;
};

}  // namespace verge::study
