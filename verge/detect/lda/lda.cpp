// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/lda/lda.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "verge/core/field_io.hpp"
#include "verge/detect/lda/edges.hpp"
#include "verge/detect/lda/windows.hpp"
#include "verge/detect/scan_scene.hpp"
#include "verge/scan/mount.hpp"
#include "verge/scan/quadrants.hpp"

namespace verge::detect {
namespace {

using namespace lda;  // NOLINT(google-build-using-namespace): the method's own steps, all of them

/// What was made of one scan line in one region.
struct Classified {
  std::vector<Vec3> edges;   ///< Middles of the windows that are edges.
  std::optional<Vec3> edge;  ///< Where it meets the edge of the road.
};

Classified classified(const QuadrantRing& ring, double height_m, const LdaConfig& config) {
  const std::vector<Window> edges = edge_windows(windows_of(ring, height_m, config), config);
  Classified result{{}, nearest_edge(ring, edges, config)};
  for (const Window& w : edges) result.edges.push_back(ring.points[w.middle]);
  return result;
}

std::vector<Classified> classify(const std::vector<QuadrantRing>& rings, double height_m,
                                 const LdaConfig& config) {
  std::vector<Classified> all;
  for (const QuadrantRing& ring : rings) all.push_back(classified(ring, height_m, config));
  return all;
}

std::vector<SideFit> fit_sides(const std::vector<QuadrantRing>& rings, const std::vector<Classified>& lines,
                               const LdaConfig& config) {
  std::vector<SideFit> sides;
  for (const bool right : {false, true}) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (is_right(rings[i].region) == right && lines[i].edge) places.push_back(*lines[i].edge);
    }
    if (auto side = fit_side(places, right, config)) sides.push_back(*std::move(side));
  }
  return sides;
}

/// The boundaries back in the sensor's frame, numbered from 0.
Scene scene_of(const Scan& scan, const LevelFrame& frame, const std::vector<SideFit>& sides) {
  Scene scene = scene_about(scan);
  for (const SideFit& side : sides) add_boundary(scene, side.boundary, frame);
  return scene;
}

/// Writes the intermediates, in the sensor's frame.
class Recorder {
 public:
  Recorder(Trace& trace, const LevelFrame& frame) : trace_(trace), frame_(frame) {}

  void low(const std::vector<LowRing>& rings) {
    Trace::Points& layer = layer_named("low");
    for (const LowRing& ring : rings) add(layer, ring.points, static_cast<int>(ring.ring));
  }
  void lines(const std::vector<QuadrantRing>& rings, const std::vector<Classified>& lines) {
    Trace::Points windows{"edge windows", {}, {}};
    Trace::Points& candidates = layer_named("candidates");
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const int region = static_cast<int>(rings[i].region);
      add(windows, lines[i].edges, region);
      if (lines[i].edge) add(candidates, {*lines[i].edge}, region);
    }
    trace_.points.push_back(std::move(windows));
  }
  void sides(const std::vector<SideFit>& sides) {
    Trace::Points& clusters = layer_named("clusters");
    for (std::size_t k = 0; k < sides.size(); ++k) {
      add(clusters, sides[k].kept, static_cast<int>(k));
      Trace::Line fit{"fit", {}};
      for (const Vec3 p : sides[k].boundary.points) fit.points.push_back(frame_.to_sensor(p));
      trace_.lines.push_back(std::move(fit));
    }
  }
  void model(const LdaConfig& config) {
    Trace::Values w{"w", {}};
    for (const FeatureName& feature : kFeatureNames) w.values.push_back(config.*feature.value);
    w.values.push_back(config.threshold);
    trace_.values.push_back(std::move(w));
  }

 private:
  [[nodiscard]] Trace::Points& layer_named(const char* name) {
    return trace_.points.emplace_back(Trace::Points{name, {}, {}});
  }
  void add(Trace::Points& layer, const std::vector<Vec3>& points, int group) {
    for (const Vec3 p : points) {
      layer.points.push_back(frame_.to_sensor(p));
      layer.group.push_back(group);
    }
  }

  Trace& trace_;
  const LevelFrame& frame_;
};

}  // namespace

Lda::Lda() = default;
Lda::Lda(const Config& config) : config_(config) {
  check_fields(config_);
  if (config_.window % 2 == 0) throw std::invalid_argument("window: must be odd, to have a middle");
}

Scene Lda::process(const Scan& scan, Trace* trace) {
  const Mount mount = scan.mount ? *scan.mount : estimate_mount(scan).mount;
  const LevelFrame frame(mount);

  const auto low = low_rings(scan, frame, config_);
  const auto rings = split_quadrants(low);
  const auto lines = classify(rings, mount.height_m, config_);  // w^T f > c, and the nearest of each line
  const auto sides = fit_sides(rings, lines, config_);          // line or quadratic
  if (trace != nullptr) {
    Recorder record(*trace, frame);
    record.low(low);
    record.lines(rings, lines);
    record.sides(sides);
    record.model(config_);
  }
  return scene_of(scan, frame, sides);
}

}  // namespace verge::detect
