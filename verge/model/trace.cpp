// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/model/trace.hpp"

namespace verge {
namespace {

template <class Layer>
const Layer* find(const std::vector<Layer>& layers, std::string_view name) {
  for (const Layer& layer : layers) {
    if (layer.name == name) return &layer;
  }
  return nullptr;
}

}  // namespace

const Trace::Points* Trace::find_points(std::string_view name) const { return find(points, name); }
const Trace::Line* Trace::find_line(std::string_view name) const { return find(lines, name); }
const Trace::Values* Trace::find_values(std::string_view name) const { return find(values, name); }
const Trace::Raster* Trace::find_raster(std::string_view name) const { return find(rasters, name); }

}  // namespace verge
