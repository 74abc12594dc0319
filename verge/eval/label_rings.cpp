// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/label_rings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "verge/eval/kerb_tables.hpp"
#include "verge/eval/label_files.hpp"

namespace verge::eval {
namespace {

namespace fs = std::filesystem;

Vec3 point_of(const Cloud& cloud, std::size_t i) { return {cloud.x[i], cloud.y[i], cloud.z[i]}; }

bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Azimuth from straight ahead, counter-clockwise, in [0, 2 pi).
double turn_of(Vec3 p) {
  const double azimuth = std::atan2(p.y, p.x);
  return azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth;
}

}  // namespace

std::vector<LabelledRing> rings_by_number(const Cloud& cloud, std::span<const std::uint32_t> labels) {
  constexpr double kVehicle_m = 0.5;
  std::vector<std::size_t> order;
  std::vector<double> azimuth(cloud.x.size());
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const Vec3 p = point_of(cloud, i);
    azimuth[i] = std::atan2(p.y, p.x);
    if (is_finite(p) && std::hypot(p.x, p.y) > kVehicle_m) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return azimuth[a] < azimuth[b]; });
  std::map<std::int64_t, LabelledRing> rings;
  for (const std::size_t i : order) {
    LabelledRing& ring = rings[cloud.ring[i]];
    ring.points.push_back(point_of(cloud, i));
    ring.labels.push_back(labels[i]);
  }
  std::vector<LabelledRing> out;
  for (auto& [number, ring] : rings) out.push_back(std::move(ring));
  return out;
}

std::vector<LabelledRing> rings_by_order(const Cloud& cloud, std::span<const std::uint32_t> labels) {
  constexpr std::size_t kFewest = 10;
  std::vector<LabelledRing> rings(1);
  std::optional<double> last;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const Vec3 p = point_of(cloud, i);
    if (!is_finite(p)) continue;
    const double turn = turn_of(p);
    if (last && turn - *last < -std::numbers::pi) rings.emplace_back();
    last = turn;
    rings.back().points.push_back(p);
    rings.back().labels.push_back(labels[i]);
  }
  std::erase_if(rings, [](const LabelledRing& ring) { return ring.points.size() <= kFewest; });
  return rings;
}

Expected<LabelledTruth> read_nuscenes_truth(const fs::path& scan, const fs::path& labels, double gap_m) {
  const auto both = read_labelled_cloud(LabelFormat::kNuscenes, scan, labels);
  if (!both) return Unexpected(both.error());
  return find_label_edges(rings_by_number(both->cloud, both->labels), LabelScheme::kNuscenes, gap_m);
}

Expected<LabelledTruth> read_kitti_truth(const fs::path& scan, const fs::path& labels, double gap_m) {
  const auto both = read_labelled_cloud(LabelFormat::kSemanticKitti, scan, labels);
  if (!both) return Unexpected(both.error());
  return find_label_edges(rings_by_order(both->cloud, both->labels), LabelScheme::kSemanticKitti, gap_m);
}

Expected<LabelledTruth> read_kerb_label_truth(const fs::path& scan, const fs::path& labels) {
  constexpr std::uint32_t kKerb = 1;
  const auto both = read_labelled_cloud(LabelFormat::kKerbLabels, scan, labels);
  if (!both) return Unexpected(both.error());
  std::vector<Vec2> kerb;
  for (std::size_t i = 0; i < both->labels.size(); ++i) {
    const Vec3 p = point_of(both->cloud, i);
    if (both->labels[i] == kKerb && is_finite(p)) kerb.push_back(p.xy());
  }
  return truth_of_kerb_points(kerb);
}

}  // namespace verge::eval
