// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/lda/edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verge/fit/polynomial.hpp"

namespace verge::detect::lda {
namespace {

constexpr double kSigmaMin = 0.1;  // metres: a bend is no better described by a quadratic than this

std::vector<Vec2> in_plane(const std::vector<Vec3>& places) {
  std::vector<Vec2> plane;
  for (const Vec3 p : places) plane.push_back(p.xy());
  return plane;
}

/// A curve through the places that agree with it.
struct Agreed {
  fit::PolynomialFit fit;
  std::vector<Vec3> places;
};

/// Least squares with rejection: each round leaves places out or is the last.
std::optional<Agreed> fit_agreed(std::vector<Vec3> places, std::size_t degree, const LdaConfig& config) {
  while (static_cast<std::int64_t>(places.size()) >= config.points_min) {
    auto fit = fit::fit_polynomial(in_plane(places), degree);
    if (!fit) return std::nullopt;
    const double most = config.reject_sigma * std::max(fit->residuals.rms_m, kSigmaMin);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (std::abs(fit->residuals.signed_m[i]) <= most) kept.push_back(places[i]);
    }
    if (kept.size() == places.size()) return Agreed{*std::move(fit), std::move(places)};
    places = std::move(kept);
  }
  return std::nullopt;
}

/// Height over forward, as a straight line.
fit::Polynomial heights_of(const std::vector<Vec3>& places) {
  std::vector<Vec2> heights;
  for (const Vec3 p : places) heights.push_back({p.x, p.z});
  const auto line = fit::fit_polynomial(heights, 1);
  return line ? line->curve : fit::Polynomial{0.0, 1.0, {places.front().z}};
}

/// The curve from the rearmost to the foremost place, rear end first.
std::vector<Vec3> sampled(const fit::Polynomial& curve, const std::vector<Vec3>& places, double step) {
  const auto [rear, front] =
      std::minmax_element(places.begin(), places.end(), [](Vec3 a, Vec3 b) { return a.x < b.x; });
  const double length = front->x - rear->x;
  const fit::Polynomial heights = heights_of(places);
  const int n = std::max(1, static_cast<int>(std::ceil(length / step)));
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) {
    const double x = rear->x + length * i / n;
    points.push_back({x, fit::value_at(curve, x), fit::value_at(heights, x)});
  }
  return points;
}

}  // namespace

std::vector<Window> edge_windows(std::span<const Window> windows, const LdaConfig& config) {
  std::vector<Window> edges;
  std::copy_if(windows.begin(), windows.end(), std::back_inserter(edges),
               [&](const Window& w) { return discriminant(w.features, config) > 0.0; });
  return edges;
}

std::optional<Vec3> nearest_edge(const QuadrantRing& ring, std::span<const Window> edges,
                                 const LdaConfig& config) {
  if (edges.empty()) return std::nullopt;
  const auto lateral = [&](const Window& w) { return std::abs(ring.points[w.middle].y); };
  const Window& nearest = *std::ranges::min_element(edges, {}, lateral);
  const auto size = static_cast<std::size_t>(config.window);
  const auto window = std::span(ring.points).subspan(nearest.middle - size / 2, size);
  return Vec3{window.back().x, window.back().y, std::ranges::min_element(window, {}, &Vec3::z)->z};
}

std::optional<SideFit> fit_side(const std::vector<Vec3>& places, bool right, const LdaConfig& config) {
  auto agreed = fit_agreed(places, 2, config);
  auto line = fit_agreed(places, 1, config);
  const bool straight = line && line->fit.residuals.p95_m <= config.line_residual_m &&
                        (!agreed || line->places.size() >= agreed->places.size());
  if (straight) agreed = std::move(line);
  if (!agreed) return std::nullopt;
  SideFit side;
  side.boundary.side = right ? Side::kRight : Side::kLeft;
  side.boundary.model = straight ? Model::kLine : Model::kPolyline;
  side.boundary.kind = BoundaryKind::kUnknown;
  side.boundary.confidence =
      static_cast<double>(agreed->places.size()) / (static_cast<double>(places.size()) + 3.0);
  side.boundary.points = sampled(agreed->fit.curve, agreed->places, config.sample_step_m);
  side.kept = std::move(agreed->places);
  return side;
}

}  // namespace verge::detect::lda
