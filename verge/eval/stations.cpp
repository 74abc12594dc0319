// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/eval/stations.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "verge/eval/share.hpp"

namespace verge::eval {
namespace {

/// y of the segment at x; none where x is outside it.
std::optional<double> crossing(Vec2 a, Vec2 b, double x) {
  if (x < std::min(a.x, b.x) || x > std::max(a.x, b.x)) return std::nullopt;
  if (a.x == b.x) return std::fabs(a.y) < std::fabs(b.y) ? a.y : b.y;
  return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
}

StationCounts count_station(std::optional<double> predicted, std::optional<double> truth,
                            double tolerance_m) {
  StationCounts counts;
  if (!predicted || !truth) {
    ++(predicted ? counts.extra : truth ? counts.missed : counts.both_absent);
    return counts;
  }
  counts.error_sum_m = std::fabs(*predicted - *truth);
  ++(counts.error_sum_m < tolerance_m ? counts.right : counts.wrong);
  return counts;
}

}  // namespace

StationCounts& StationCounts::operator+=(const StationCounts& more) {
  both_absent += more.both_absent;
  missed += more.missed;
  extra += more.extra;
  right += more.right;
  wrong += more.wrong;
  error_sum_m += more.error_sum_m;
  return *this;
}

std::optional<double> StationCounts::precision() const { return share_of(right, right + wrong + extra); }
std::optional<double> StationCounts::precision_inside() const { return share_of(right, right + wrong); }
std::optional<double> StationCounts::recall() const { return share_of(right, right + missed); }
std::optional<double> StationCounts::mean_error_m() const {
  if (right + wrong == 0) return std::nullopt;
  return error_sum_m / static_cast<double>(right + wrong);
}

std::optional<double> lateral_at(const Scene& scene, Side side, double x) {
  std::optional<double> lateral;
  for (const Boundary& boundary : scene.boundaries) {
    if (boundary.side != side) continue;
    for (std::size_t i = 1; i < boundary.points.size(); ++i) {
      const auto y = crossing(boundary.points[i - 1].xy(), boundary.points[i].xy(), x);
      if (y && (!lateral || std::fabs(*y) < std::fabs(*lateral))) lateral = y;
    }
  }
  return lateral;
}

std::vector<StationCounts> count_stations(const Scene& prediction, const Scene& truth,
                                          const StationConfig& config) {
  std::vector<StationCounts> stations;
  const auto x_of = [&](std::size_t station) { return static_cast<double>(station) * config.step_m; };
  while (x_of(stations.size()) < config.range_m) {
    const double x = x_of(stations.size());
    StationCounts& counts = stations.emplace_back();
    for (const Side side : {Side::kLeft, Side::kRight})
      counts +=
          count_station(lateral_at(prediction, side, x), lateral_at(truth, side, x), config.tolerance_m);
  }
  return stations;
}

void add_stations(std::vector<StationCounts>& sum, const std::vector<StationCounts>& more) {
  if (sum.empty()) sum.resize(more.size());
  assert(sum.size() == more.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

StationCounts pooled(const std::vector<StationCounts>& stations) {
  StationCounts sum;
  for (const StationCounts& counts : stations) sum += counts;
  return sum;
}

}  // namespace verge::eval
