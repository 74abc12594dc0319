// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/road_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "verge/core/angle.hpp"
#include "verge/scan/scan.hpp"

namespace verge {
namespace {

constexpr double kCell = 0.5;        // metres: surface counts by area, not by the number of returns
constexpr double kOwnVehicle = 1.5;  // metres: nearer returns are of the vehicle itself
constexpr double kHalfWeight = 6.0;  // metres: surface at this distance counts half
constexpr double kHalfLane = 2.0;    // metres: surface at this lateral distance counts a quarter
constexpr double kHeightMin = 0.2;   // metres: no sensor stands lower
constexpr double kFineBin = 0.05;    // metres: two bins are less than a kerb's height
constexpr std::size_t kLeastCells = 30;

/// One cell of the ground raster: its lowest return in the first pass, the mean of its returns on the plane
/// in the second.
struct Surface {
  Vec3 point;
  double weight = 0.0;
};

/// Square raster around the sensor, as far as the reach, its rows along the heading: where the road is known,
/// a vehicle that stands otherwise on it sees the same cells.
class Raster {
 public:
  explicit Raster(double reach, double heading_rad = 0.0)
      : half_(static_cast<std::size_t>(std::ceil(reach / kCell))),
        reach_(reach),
        along_{std::cos(heading_rad), std::sin(heading_rad)} {}

  [[nodiscard]] std::size_t size() const { return 4 * half_ * half_; }

  /// The cell of (x, y), none where it does not count for the road's plane.
  [[nodiscard]] std::optional<std::size_t> cell(double x, double y) const {
    const double squared = x * x + y * y;
    const bool counts = squared > kOwnVehicle * kOwnVehicle && squared < reach_ * reach_;
    if (!counts) return std::nullopt;
    const std::size_t column = place(dot(along_, {x, y}));
    const std::size_t row = place(cross(along_, {x, y}));
    return row * 2 * half_ + column;
  }

 private:
  /// Cells from the raster's edge.
  [[nodiscard]] std::size_t place(double metres) const {
    return static_cast<std::size_t>(std::floor(metres / kCell) + static_cast<double>(half_));
  }

  std::size_t half_;
  double reach_;
  Vec2 along_;
};

double distance_weight(Vec3 p) {
  const double squared = (p.x * p.x + p.y * p.y) / (kHalfWeight * kHalfWeight);
  return 1.0 / (1.0 + squared);
}

/// The lowest return of each cell: under trees and between cars the road is what lies lowest.
std::vector<Surface> lowest_surface(const Scan& scan, const Raster& raster) {
  constexpr std::uint32_t kNone = UINT32_MAX;
  std::vector<std::uint32_t> lowest(raster.size(), kNone);
  const auto height = [&](std::uint32_t i) { return std::tuple(scan.z[i], scan.x[i], scan.y[i]); };
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    const auto cell = raster.cell(static_cast<double>(scan.x[i]), static_cast<double>(scan.y[i]));
    if (cell && (lowest[*cell] == kNone || height(i) < height(lowest[*cell]))) lowest[*cell] = i;
  }
  std::vector<Surface> surface;
  for (const std::uint32_t i : lowest) {
    if (i != kNone) surface.push_back({scan.point(i), distance_weight(scan.point(i))});
  }
  return surface;
}

/// A return and its cell.
struct Placed {
  Vec3 point;
  std::size_t cell;
};

/// The returns that may count for the plane once it has moved by a few centimetres: looked up once for all
/// iterations.
std::vector<Placed> returns_near(const Scan& scan, const Raster& raster, const RoadPlane& plane,
                                 double near) {
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto cell = raster.cell(static_cast<double>(scan.x[i]), static_cast<double>(scan.y[i]));
    if (cell && std::abs(plane.height_above(scan.point(i))) < near) placed.push_back({scan.point(i), *cell});
  }
  return placed;
}

/// The mean of each cell's returns near the plane: unlike the lowest one it is not drawn down by noise.
template <class Weight>
std::vector<Surface> mean_surface(const std::vector<Placed>& placed, std::size_t cells,
                                  const RoadPlane& plane, double near, const Weight& weight) {
  struct Sum {
    Vec3 sum;
    double count = 0.0;
  };
  std::vector<Sum> sums(cells);
  for (const Placed& p : placed) {
    if (!(std::abs(plane.height_above(p.point)) < near)) continue;
    sums[p.cell].sum = sums[p.cell].sum + p.point;
    sums[p.cell].count += 1.0;
  }
  std::vector<Surface> surface;
  for (const Sum& s : sums) {
    if (!(s.count > 0.0)) continue;
    const Vec3 mean = (1.0 / s.count) * s.sum;
    surface.push_back({mean, weight(mean)});
  }
  return surface;
}

/// Up direction in the sensor's frame of a sensor with that pitch and roll.
Vec3 up_of(double pitch, double roll) {
  return {-std::sin(pitch), std::cos(pitch) * std::sin(roll), std::cos(pitch) * std::cos(roll)};
}

/// The angles to try: around `centre`, or the known one alone.
std::vector<double> angles(std::optional<double> known, double centre, double reach, double step) {
  if (known) return {*known};
  std::vector<double> out;
  const int n = static_cast<int>(std::ceil(reach / step - 1e-9));
  for (int i = -n; i <= n; ++i) out.push_back(centre + i * step);
  return out;
}

/// A tilt and height, and the weight of the surface that agrees with it.
struct Vote {
  double pitch = 0.0;
  double roll = 0.0;
  double height = 0.0;
  double weight = -1.0;
};

/// The height that most surface agrees on for one tilt (two neighbouring bins, so that no edge splits the
/// road).
Vote vote_height(const std::vector<Surface>& surface, double pitch, double roll, double bin,
                 double height_max) {
  const Vec3 up = up_of(pitch, roll);
  std::vector<double> histogram(static_cast<std::size_t>(height_max / bin) + 2, 0.0);
  for (const Surface& s : surface) {
    const double height = -dot(up, s.point);
    if (height >= kHeightMin && height < height_max)
      histogram[static_cast<std::size_t>(height / bin)] += s.weight;
  }
  Vote best;
  for (std::size_t i = 0; i + 1 < histogram.size(); ++i) {
    const double weight = histogram[i] + histogram[i + 1];
    if (weight > best.weight) best = {pitch, roll, static_cast<double>(i + 1) * bin, weight};
  }
  return best;
}

/// Coarse search over all tilts, then finer ones around the winner, down to bins that tell a road from its
/// sidewalk.
Vote vote(const std::vector<Surface>& surface, const MountHint& hint, const MountConfig& config) {
  Vote best;
  const auto search = [&](double reach, double step, double bin) {
    const Vote around = best;
    best = {};
    for (const double pitch : angles(hint.pitch_rad, around.pitch, reach, step)) {
      for (const double roll : angles(hint.roll_rad, around.roll, reach, step)) {
        const Vote vote = vote_height(surface, pitch, roll, bin, config.height_max_m);
        if (vote.weight > best.weight) best = vote;
      }
    }
  };
  const double coarse = deg_to_rad(3.0);
  search(config.tilt_max_rad, coarse, 0.2);
  search(coarse, deg_to_rad(1.0), 0.1);
  search(deg_to_rad(1.0), deg_to_rad(0.25), kFineBin);
  return best;
}

RoadPlane plane_of(double pitch, double roll, double height) {
  const Vec3 up = up_of(pitch, roll);
  return {-height / up.z, -up.x / up.z, -up.y / up.z, 0.0};
}

/// The plane again with what the hint fixes: the slopes and offset that belong to the known angles and
/// height.
RoadPlane with_hint(RoadPlane plane, const MountHint& hint) {
  if (hint.roll_rad) plane.slope_y = -std::tan(*hint.roll_rad);
  if (hint.pitch_rad) plane.slope_x = std::tan(*hint.pitch_rad) * std::hypot(1.0, plane.slope_y);
  if (hint.height_m)
    plane.offset = -*hint.height_m * std::hypot(1.0, std::hypot(plane.slope_x, plane.slope_y));
  return plane;
}

using Matrix3 = std::array<std::array<double, 3>, 3>;

double determinant(const Matrix3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Solution of m x = v by Cramer's rule; none where m is singular.
std::optional<std::array<double, 3>> solve(const Matrix3& m, const std::array<double, 3>& v) {
  const double d = determinant(m);
  if (!(std::abs(d) > 1e-9)) return std::nullopt;
  std::array<double, 3> x{};
  for (std::size_t c = 0; c < 3; ++c) {
    Matrix3 replaced = m;
    for (std::size_t r = 0; r < 3; ++r) replaced[r][c] = v[r];
    x[c] = determinant(replaced) / d;
  }
  return x;
}

/// One step of iteratively reweighted least squares with Tukey's biweight: surface farther than `scale` from
/// the plane does not count.
RoadPlane reweighted(const std::vector<Surface>& surface, const RoadPlane& plane, const MountHint& hint,
                     double scale) {
  Matrix3 normal{};
  std::array<double, 3> right{};
  const std::array<bool, 3> fixed{hint.height_m.has_value(), hint.pitch_rad.has_value(),
                                  hint.roll_rad.has_value()};
  for (const Surface& s : surface) {
    const double residual = plane.height_above(s.point);
    const double u = 1.0 - (residual / scale) * (residual / scale);
    if (!(u > 0.0)) continue;
    const std::array<double, 3> row{1.0, s.point.x, s.point.y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) normal[i][j] += s.weight * u * u * row[i] * row[j];
      right[i] += s.weight * u * u * row[i] * residual;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!fixed[i]) continue;
    for (std::size_t j = 0; j < 3; ++j) normal[i][j] = normal[j][i] = i == j ? 1.0 : 0.0;
    right[i] = 0.0;
  }
  const auto step = solve(normal, right);
  if (!step) return plane;
  return with_hint({plane.offset + (*step)[0], plane.slope_x + (*step)[1], plane.slope_y + (*step)[2], 0.0},
                   hint);
}

double inlier_share(const std::vector<Surface>& surface, const RoadPlane& plane, double inlier) {
  double on = 0.0;
  double all = 0.0;
  for (const Surface& s : surface) {
    all += s.weight;
    if (std::abs(plane.height_above(s.point)) < inlier) on += s.weight;
  }
  return all > 0.0 ? on / all : 0.0;
}

}  // namespace

std::optional<RoadPlane> find_road_plane(const Scan& scan, const MountHint& hint, const MountConfig& config) {
  const Raster raster(config.reach_m);
  const std::vector<Surface> lowest = lowest_surface(scan, raster);
  if (lowest.size() < kLeastCells) return std::nullopt;
  const Vote best = vote(lowest, hint, config);
  if (best.weight <= 0.0) return std::nullopt;

  RoadPlane plane = with_hint(plane_of(best.pitch, best.roll, best.height), hint);
  // The biweight's width narrows to less than a kerb's height, so that the sidewalk has no say in the end.
  const double width = 1.5 * config.inlier_m;
  for (const double factor : {2.0, 1.5, 1.0, 1.0, 1.0})
    plane = reweighted(lowest, plane, hint, factor * width);
  plane.inlier_share = inlier_share(lowest, plane, width);
  return plane;
}

RoadPlane refine_along_road(const Scan& scan, RoadPlane plane, double heading_rad, const MountHint& hint,
                            const MountConfig& config) {
  const Raster raster(config.reach_m, heading_rad);
  const Vec2 across{-std::sin(heading_rad), std::cos(heading_rad)};
  const auto weight = [&](Vec3 p) {
    const double lateral = dot(across, p.xy()) / kHalfLane;
    return 1.0 / ((1.0 + lateral * lateral) * (1.0 + lateral * lateral));
  };
  const double width = 1.5 * config.inlier_m;
  const std::vector<Placed> placed = returns_near(scan, raster, plane, 5.0 * width);
  for (const double factor : {3.0, 2.0, 1.5, 1.0, 1.0, 1.0}) {
    const auto surface = mean_surface(placed, raster.size(), plane, factor * width, weight);
    plane = reweighted(surface, plane, hint, factor * width);
  }
  return plane;
}

}  // namespace verge
