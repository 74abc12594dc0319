// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/gradient/boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "verge/core/statistics.hpp"
#include "verge/fit/path.hpp"

namespace verge::detect::gradient {
namespace {

std::vector<Vec2> feet_of(const Strand& strand) {
  std::vector<Vec2> feet;
  for (const Candidate& c : strand.points) feet.push_back(c.foot.xy());
  return feet;
}

/// Share of the whole length at each point, 0 at the first and 1 at the last.
std::vector<double> shares_of(const std::vector<Vec2>& points) {
  std::vector<double> share = fit::arc_lengths(points);
  const double whole = share.back();
  for (double& s : share) s = whole > 0.0 ? s / whole : 0.0;
  return share;
}

/// A strand's values at any share of its length.
class Profile {
 public:
  explicit Profile(const Strand& strand) : strand_(strand), share_(shares_of(feet_of(strand))) {}

  struct At {
    double z;
    double height;
    PointState state;
  };
  [[nodiscard]] At at(double share) const {
    const auto upper = std::lower_bound(share_.begin() + 1, share_.end() - 1, share);
    const auto i = static_cast<std::size_t>(upper - share_.begin());
    const double width = share_[i] - share_[i - 1];
    const double t = width > 0.0 ? std::clamp((share - share_[i - 1]) / width, 0.0, 1.0) : 0.0;
    const Candidate& a = strand_.points[i - 1];
    const Candidate& b = strand_.points[i];
    constexpr double kAtEnd = 0.02;
    const bool between = t > kAtEnd && t < 1.0 - kAtEnd;
    return {a.foot.z + t * (b.foot.z - a.foot.z), a.height_m + t * (b.height_m - a.height_m),
            strand_.bridged[i - 1] && between ? PointState::kBridged : PointState::kVisible};
  }

 private:
  const Strand& strand_;
  std::vector<double> share_;
};

std::size_t scan_lines_missed(const Strand& strand) {
  std::size_t missed = 0;
  for (std::size_t i = 1; i < strand.points.size(); ++i) {
    if (strand.bridged[i - 1]) continue;
    const auto a = static_cast<std::ptrdiff_t>(strand.points[i - 1].ring);
    const auto b = static_cast<std::ptrdiff_t>(strand.points[i].ring);
    missed += static_cast<std::size_t>(std::max<std::ptrdiff_t>(std::abs(a - b) - 1, 0));
  }
  return missed;
}

double confidence_of(const Strand& strand) {
  const auto n = static_cast<double>(strand.points.size());
  const double support = n / (n + static_cast<double>(scan_lines_missed(strand)) + 3.0);
  return strand.obstacle ? 0.5 * support : support;
}

/// A wall where high returns stand above it or the step itself is higher than a kerb.
BoundaryKind kind_of(const Strand& strand, const GradientConfig& config) {
  std::vector<double> height;
  for (const Candidate& c : strand.points) height.push_back(c.height_m);
  const bool high = median(height).value_or(0.0) > config.rise_max_m;
  return strand.obstacle || high ? BoundaryKind::kWall : BoundaryKind::kCurb;
}

Fitted fitted(const Strand& strand, Curve curve, const GradientConfig& config) {
  Boundary b;
  b.side = strand.right ? Side::kRight : Side::kLeft;
  b.model = curve.model;
  b.kind = kind_of(strand, config);
  b.confidence = confidence_of(strand);
  const Profile profile(strand);
  const std::vector<double> share = shares_of(curve.points);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Profile::At here = profile.at(share[i]);
    b.points.push_back({curve.points[i].x, curve.points[i].y, here.z});
    b.height_m.push_back(here.height);
    b.state.push_back(here.state);
  }
  return {std::move(b), std::move(curve)};
}

}  // namespace

std::vector<Fitted> fit_boundaries(const std::vector<Strand>& strands, const GradientConfig& config) {
  std::vector<Fitted> out;
  for (const Strand& strand : strands) {
    if (auto curve = fit_curve(feet_of(strand), config))
      out.push_back(fitted(strand, *std::move(curve), config));
  }
  return out;
}

std::optional<Fitted> fit_side_as_printed(const std::vector<Vec3>& points, bool right,
                                          const GradientConfig& config) {
  std::vector<Vec2> plane;
  double height = 0.0;
  for (const Vec3 p : points) {
    plane.push_back(p.xy());
    height += p.z / static_cast<double>(points.size());
  }
  auto curve = fit_curve_as_printed(plane, config);
  if (!curve) return std::nullopt;
  Boundary b;
  b.side = right ? Side::kRight : Side::kLeft;
  b.model = curve->model;
  b.kind = BoundaryKind::kCurb;
  b.confidence = 0.5;  // the paper has no measure of it
  for (const Vec2 p : curve->points) b.points.push_back({p.x, p.y, height});
  return Fitted{std::move(b), *std::move(curve)};
}

}  // namespace verge::detect::gradient
