// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"
#include "verge/detect/detector.hpp"

namespace verge::detect {

/// How a paper's text is taken where it is ambiguous or misprinted.
enum class Reading : std::uint8_t {
  kFixed,  ///< With the misprints put right and the gaps filled (docs/methods.md lists each).
  kPaper,  ///< As printed, where that can run.
};

/// Road boundaries from a multi-line lidar (paper 3: Zhong et al., "Road boundary detection algorithm based
/// on multi-line 3D laser radar", IJEART 3(8), 2017): height gate, four quadrants, gradient by ring,
/// gap-based K, k-means denoising, and a straight line by least squares or a cubic B-spline a side.
class Gradient final : public Detector {
 public:
  struct Config {
    Reading reading = Reading::kFixed;
    double height_max_m = 0.5;

    template <class Self, class Visitor>
    static void fields(Self& self, Visitor&& visit) {
      visit(self.reading,
            {"reading", "", 0, 0, "fixed, or paper: the printed text where it can run", "paper 3"});
      visit(self.height_max_m, {"height_max_m", "m", 0.05, 5.0, "points higher above the road are dropped",
                                "paper 3, II-1 (1); value ours"});
    }
  };

  Gradient();
  /// Throws std::invalid_argument where a value is outside its range.
  explicit Gradient(const Config& config);

  [[nodiscard]] Scene process(const Scan& scan, Trace* trace = nullptr) override;
  [[nodiscard]] Order order() const override { return Order::kIndependent; }

 private:
  Config config_;
};

}  // namespace verge::detect

namespace verge {
template <>
inline constexpr std::array enum_names<detect::Reading> = std::to_array<std::string_view>({"fixed", "paper"});
}  // namespace verge
