// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/ibeo/wire_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "verge/core/angle.hpp"
#include "verge/sensor/ibeo/ntp.hpp"

namespace verge::sensor::ibeo {
namespace {

constexpr double kOffLayerRad = deg_to_rad(0.4);
constexpr unsigned kEchoMost = 3;
constexpr double kNtpTickS = 1.0 / 4'294'967'296.0;

/// A whole number nearest to the value, held in what T can say; `altered` is set where it is not.
template <class T>
T held(double value, bool& altered) {
  constexpr double kMost = std::numeric_limits<T>::max();
  const double whole = std::round(value);
  if (whole >= 0.0 && whole <= kMost) return static_cast<T>(whole);
  altered = true;
  return static_cast<T>(whole > kMost ? kMost : 0.0);
}

double elevation_of(const Cloud& cloud, std::size_t i) {
  return std::atan2(static_cast<double>(cloud.z[i]), std::hypot(cloud.x[i], cloud.y[i]));
}

/// The layer whose beam is nearest; none where none is near.
std::optional<std::uint8_t> layer_near(const LuxModel& model, double elevation_rad) {
  std::size_t best = 0;
  for (std::size_t layer = 1; layer < model.layer_elevation_rad.size(); ++layer) {
    const auto off = [&](std::size_t l) { return std::abs(model.layer_elevation_rad[l] - elevation_rad); };
    if (off(layer) < off(best)) best = layer;
  }
  if (!(std::abs(model.layer_elevation_rad[best] - elevation_rad) <= kOffLayerRad)) return std::nullopt;
  return static_cast<std::uint8_t>(best);
}

std::optional<LuxPoint> lux_point(const Cloud& cloud, std::size_t i, const LuxModel& model, bool& altered) {
  const double x = cloud.x[i];
  const double y = cloud.y[i];
  const double z = cloud.z[i];
  const double range_cm = std::round(100.0 * std::sqrt(x * x + y * y + z * z));
  const auto layer = layer_near(model, elevation_of(cloud, i));
  const std::uint8_t echo = cloud.echo.empty() ? std::uint8_t{0} : cloud.echo[i];
  if (!layer || !(range_cm >= 1.0) || range_cm > 65'535.0 || echo > kEchoMost) return std::nullopt;
  const double ticks = std::atan2(y, x) / (2.0 * std::numbers::pi) * model.ticks_per_turn;
  return LuxPoint{
      .layer = *layer,
      .echo = echo,
      .flags = held<std::uint8_t>(cloud.flags.empty() ? 0.0 : cloud.flags[i], altered),
      .angle_ticks = static_cast<std::int16_t>(std::lround(ticks)),
      .range_cm = static_cast<std::uint16_t>(range_cm),
      .pulse_width_cm = held<std::uint16_t>(
          cloud.pulse_width.empty() ? 0.0 : 100.0 * static_cast<double>(cloud.pulse_width[i]), altered)};
}

/// Time of a point after the first, as it is and as the angle tells it.
struct TimedAngle {
  std::int64_t time_ns = 0;
  int ticks = 0;  // to the right of the leftmost point
};

/// How long a scan of that width takes, in ticks of NTP, and how many ticks of angle it is wide.
struct Sweep {
  std::uint64_t ntp_ticks = 0;
  int width = 0;
};

bool gives_back(const std::vector<TimedAngle>& points, const Sweep& sweep) {
  const double lasts_s = static_cast<double>(sweep.ntp_ticks) * kNtpTickS;
  return std::all_of(points.begin(), points.end(), [&](const TimedAngle& p) {
    const double share = static_cast<double>(p.ticks) / sweep.width;
    return std::llround(lasts_s * share * 1e9) == p.time_ns;
  });
}

/// The sweep whose even turning gives every time to the nanosecond: among those of all widths, since the
/// length is in whole ticks of NTP. Where there is none, the times do not go with the angles; then the
/// outermost points'.
Sweep sweep_through(const std::vector<TimedAngle>& points) {
  constexpr int kWidest = 8'192;  // ticks; a sensor sweeps 3200
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  TimedAngle last;
  for (const TimedAngle& p : points) {
    if (p.ticks > last.ticks) last = p;
    if (p.ticks == 0) continue;
    low = std::max(low, (static_cast<double>(p.time_ns) - 0.5) / p.ticks);
    high = std::min(high, (static_cast<double>(p.time_ns) + 0.5) / p.ticks);
  }
  const auto sweep_of = [](double ns_a_tick, int width) {
    return Sweep{static_cast<std::uint64_t>(std::llround(ns_a_tick * width * 1e-9 / kNtpTickS)), width};
  };
  for (int width = last.ticks; low <= high && last.ticks > 0 && width <= kWidest; ++width) {
    const Sweep sweep = sweep_of(0.5 * (low + high), width);
    const double ns_a_tick = static_cast<double>(sweep.ntp_ticks) * kNtpTickS * 1e9 / width;
    if (ns_a_tick >= low && ns_a_tick <= high && gives_back(points, sweep)) return sweep;
  }
  const double slope = last.ticks == 0 ? 0.0 : static_cast<double>(last.time_ns) / last.ticks;
  return sweep_of(std::max(0.0, slope), last.ticks);
}

/// Times and angles of the scan's points from those of the cloud, whose point `indices[k]` is the k-th.
Sweep sweep_of(const Cloud& cloud, const std::vector<std::size_t>& indices, const LuxScan& scan,
               const LuxModel& model) {
  if (cloud.time_s.empty()) {
    const int width = scan.start_angle_ticks - scan.end_angle_ticks;
    const double turn_s = model.rates.empty() ? 0.08 : 1.0 / model.rates.front().rate_hz;
    const double lasts_s = turn_s * width / model.ticks_per_turn;
    return {static_cast<std::uint64_t>(std::llround(lasts_s / kNtpTickS)), width};
  }
  double first_s = std::numeric_limits<double>::infinity();
  for (const std::size_t i : indices) first_s = std::min(first_s, cloud.time_s[i]);
  std::vector<TimedAngle> points;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    points.push_back({std::llround(1e9 * (cloud.time_s[indices[k]] - first_s)),
                      scan.start_angle_ticks - scan.points[k].angle_ticks});
  }
  return sweep_through(points);
}

void set_sweep(LuxScan& scan, std::uint64_t start_ntp, const Sweep& sweep) {
  scan.start_ntp = start_ntp;
  scan.end_ntp = start_ntp + sweep.ntp_ticks;
  scan.end_angle_ticks = static_cast<std::int16_t>(scan.start_angle_ticks - sweep.width);
}

std::uint64_t ntp_since_power_on(std::int64_t ns) {
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  const auto fraction = static_cast<double>(ns % kSecondNs) * 1e-9 / kNtpTickS;
  return (static_cast<std::uint64_t>(ns / kSecondNs) << 32U) + static_cast<std::uint64_t>(fraction);
}

/// Median elevation of each ring's points.
std::map<std::int64_t, double> elevations_of_rings(const Cloud& cloud) {
  std::map<std::int64_t, std::vector<double>> all;
  for (std::size_t i = 0; i < cloud.ring.size(); ++i) all[cloud.ring[i]].push_back(elevation_of(cloud, i));
  std::map<std::int64_t, double> medians;
  for (auto& [ring, elevations] : all) {
    const auto middle = elevations.begin() + static_cast<std::ptrdiff_t>(elevations.size() / 2);
    std::nth_element(elevations.begin(), middle, elevations.end());
    medians[ring] = *middle;
  }
  return medians;
}

/// The layer of each ring, in rising order: of all ways to leave layers out the one whose elevations fit
/// best. Rings beyond the number of layers have none.
std::map<std::int64_t, std::uint8_t> layers_of_rings(const Cloud& cloud, const AlascaModel& model) {
  const std::map<std::int64_t, double> rings = elevations_of_rings(cloud);
  const std::size_t layers = model.layer_elevation_rad.size();
  std::map<std::int64_t, std::uint8_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 1; chosen < 1U << layers; ++chosen) {
    std::map<std::int64_t, std::uint8_t> way;
    double off = 0.0;
    auto ring = rings.begin();
    for (std::size_t layer = 0; layer < layers && ring != rings.end(); ++layer) {
      if ((chosen >> layer & 1U) == 0) continue;
      way[ring->first] = static_cast<std::uint8_t>(layer);
      off += std::abs(ring->second - model.layer_elevation_rad[layer]);
      ++ring;
    }
    const bool all = way.size() == std::min(rings.size(), layers);
    if (!all || off >= least) continue;
    best = std::move(way);
    least = off;
  }
  return best;
}

std::optional<AlascaPoint> alasca_point(const Cloud& cloud, std::size_t i, std::uint8_t layer,
                                        bool& altered) {
  const auto x = code_of_metres(static_cast<double>(cloud.x[i]));
  const auto y = code_of_metres(static_cast<double>(cloud.y[i]));
  const auto z = code_of_metres(static_cast<double>(cloud.z[i]));
  const std::uint8_t echo = cloud.echo.empty() ? std::uint8_t{0} : cloud.echo[i];
  if (!x || !y || !z || (*x == 0 && *y == 0 && *z == 0) || echo > kEchoMost) return std::nullopt;
  std::uint32_t status = cloud.flags.empty() ? 0 : cloud.flags[i];
  if (status > 255 || status == static_cast<std::uint32_t>(AlascaStatus::kInvalid)) {
    status = 0;
    altered = true;
  }
  return AlascaPoint{
      .scanner = 0,
      .layer = layer,
      .echo = echo,
      .status = AlascaStatus{static_cast<std::uint8_t>(status)},
      .x_code = *x,
      .y_code = *y,
      .z_code = *z,
      .pulse_width = held<std::uint16_t>(
          cloud.pulse_width.empty() ? 0.0 : static_cast<double>(cloud.pulse_width[i]), altered)};
}

/// Left and right end of the scan, in steps of 1e-4 rad.
void set_angles(AlascaScan& scan) {
  if (scan.points.empty()) return;
  double left = -std::numbers::pi;
  double right = std::numbers::pi;
  for (const AlascaPoint& point : scan.points) {
    const double angle = std::atan2(metres_of_code(point.y_code), metres_of_code(point.x_code));
    left = std::max(left, angle);
    right = std::min(right, angle);
  }
  scan.start_angle_1e4_rad = static_cast<std::int16_t>(std::lround(1e4 * left));
  scan.end_angle_1e4_rad = static_cast<std::int16_t>(std::lround(1e4 * right));
}

}  // namespace

WireLuxScan scan_of(const Cloud& cloud, std::optional<std::int64_t> stamp_ns, const LuxModel& model,
                    std::int64_t since_power_on_ns) {
  WireLuxScan out;
  LuxScan& scan = out.scan;
  scan.ticks_per_turn = model.ticks_per_turn;
  out.counts.points = cloud.x.size();
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    bool altered = false;
    const auto point = lux_point(cloud, i, model, altered);
    if (!point) continue;
    scan.points.push_back(*point);
    indices.push_back(i);
    out.counts.altered += altered ? 1U : 0U;
  }
  out.counts.encoded = indices.size();
  out.counts.not_on_wire = out.counts.points - out.counts.encoded;
  if (!scan.points.empty()) {
    const auto [right, left] = std::minmax_element(
        scan.points.begin(), scan.points.end(),
        [](const LuxPoint& a, const LuxPoint& b) { return a.angle_ticks < b.angle_ticks; });
    scan.start_angle_ticks = left->angle_ticks;
    scan.end_angle_ticks = right->angle_ticks;
  }
  const std::uint64_t start_ntp = stamp_ns ? ntp_of(*stamp_ns) : ntp_since_power_on(since_power_on_ns);
  set_sweep(scan, start_ntp, sweep_of(cloud, indices, scan, model));
  return out;
}

WireAlascaScan scan_of(const Cloud& cloud, const AlascaModel& model) {
  WireAlascaScan out;
  out.counts.points = cloud.x.size();
  const std::map<std::int64_t, std::uint8_t> layers = layers_of_rings(cloud, model);
  for (std::size_t i = 0; i < cloud.ring.size(); ++i) {
    const auto layer = layers.find(cloud.ring[i]);
    bool altered = false;
    const auto point = layer == layers.end() ? std::nullopt : alasca_point(cloud, i, layer->second, altered);
    if (!point) continue;
    out.scan.points.push_back(*point);
    out.counts.altered += altered ? 1U : 0U;
  }
  out.counts.encoded = out.scan.points.size();
  out.counts.not_on_wire = out.counts.points - out.counts.encoded;
  set_angles(out.scan);
  return out;
}

}  // namespace verge::sensor::ibeo
