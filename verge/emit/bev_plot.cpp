// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/emit/bev_plot.hpp"

#include <stdexcept>
#include <utility>

#include "verge/core/atomic_file.hpp"
#include "verge/core/field_io.hpp"
#include "verge/emit/bev_furniture.hpp"
#include "verge/emit/bev_layers.hpp"
#include "verge/emit/bev_objects.hpp"
#include "verge/emit/bev_theme.hpp"

namespace verge::emit {

BevPlot::BevPlot(const Config& config) : config_(config) {
  check_fields(config);
  if (!(config.height_max_m > config.height_min_m)) {
    throw std::invalid_argument("height_max_m must be above height_min_m");
  }
}

Expected<std::string> BevPlot::png(const BevContent& content) const {
  const int size = static_cast<int>(config_.size_px);
  const BevView view(config_);
  Canvas canvas(size, size, kGround);
  const HeightScale scale(content.scan, config_);
  Legend legend;
  Legend steps;
  draw_rings(canvas, view);
  draw_scan(canvas, view, scale, content, config_.ceiling_m);
  if (content.trace != nullptr) draw_trace(canvas, view, scale, *content.trace, Depth::kUnder, steps);
  draw_objects(canvas, view, content.scene, legend);
  draw_boundaries(canvas, view, content.scene, legend);
  draw_corners(canvas, view, content.scene, legend);
  if (content.truth != nullptr) {
    draw_true_objects(canvas, view, *content.truth, legend);
    draw_truth(canvas, view, *content.truth, legend);
  }
  if (content.trace != nullptr) draw_trace(canvas, view, scale, *content.trace, Depth::kOver, steps);
  draw_vehicle(canvas, view);
  draw_ring_labels(canvas, view);
  legend.insert(legend.end(), steps.begin(), steps.end());
  draw_legend(canvas, view, std::move(legend));
  draw_caption(canvas, view, content);
  draw_scale_bar(canvas, view);
  draw_colour_bar(canvas, view, config_, content.scan.mount.has_value());
  return canvas.png();
}

Expected<void> BevPlot::write(const std::filesystem::path& target, const BevContent& content) const {
  return png(content).and_then([&](const std::string& bytes) { return write_file(target, bytes); });
}

}  // namespace verge::emit
