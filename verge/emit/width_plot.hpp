// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"

namespace verge::emit {

/// The road's width from scan to scan, as a corner detector's trace tells it (values "L": the road's length
/// on each line, first to last): the lengths, and where the trace has them the two comparisons of paper 1
/// with their thresholds ("first comparison", "second comparison": the value, then the threshold), and K with
/// K_thres ("K": likewise) over the scans in corner-candidate state ("CCS": 0 or 1). A corner is marked where
/// it is first said. Scans without "L" leave a gap.
class WidthPlot {
 public:
  /// The next scan. Keeps a dozen numbers of it.
  void add(const Scene& scene, const Trace& trace);

  /// Scans that were added, those without a length among them; whether any had one.
  [[nodiscard]] std::size_t size() const { return scans_.size(); }
  [[nodiscard]] bool has_lengths() const;
  /// Begins anew behind the last scan; corners that were said stay said.
  void clear();

  /// The picture as PNG: 1200 pixels wide. Fails with kLimit where memory does not suffice.
  [[nodiscard]] Expected<std::string> png() const;

 private:
  struct Compared {
    double value = 0.0;
    double threshold = 0.0;
  };
  struct Row {
    std::vector<double> lengths_m;
    std::optional<Compared> first{}, second{}, k{};
    bool candidate = false;
    std::vector<CornerSide> corners;  // new ones
  };
  static std::optional<Compared> compared(const Trace& trace, const char* name);

  std::string first_frame_, last_frame_;
  std::vector<Row> scans_;
  std::set<int> said_;

  friend class WidthPainter;
};

}  // namespace verge::emit
