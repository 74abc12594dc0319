// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/line_fit/kerb_edges.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace verge::detect::line_fit {
namespace {

/// Pieces that lie on one line.
struct Kerb {
  fit::Line line;
  std::vector<std::size_t> pieces{};
  std::size_t returns = 0;
  double lateral_m = 0.0;  // of the piece that it began with
};

bool is_left(const KerbPiece& piece) { return piece.line.centroid.y > 0.0; }

/// How far `other` is from going on where `line` leads: the farther away, the less sure is its direction.
bool leads_to(const KerbPiece& piece, const KerbPiece& other, const KerbConfig& config) {
  constexpr double kTurn = 0.02;  // metres aside for each metre on
  const double gap_m = distance(piece.line.centroid, other.line.centroid);
  return std::fabs(fit::signed_distance(piece.line, other.line.centroid)) <= config.joined_m + kTurn * gap_m;
}

std::vector<Vec2> places_of(std::span<const LayerPoint> points, const std::vector<KerbPiece>& pieces,
                            const std::vector<std::size_t>& chosen) {
  std::vector<Vec2> places;
  for (const std::size_t k : chosen) {
    for (const std::size_t i : pieces[k].points) places.push_back(points[i].place.xy());
  }
  return places;
}

Kerb kerb_from(std::span<const LayerPoint> points, const std::vector<KerbPiece>& pieces, std::size_t seed,
               const KerbConfig& config) {
  Kerb kerb{pieces[seed].line, {}, 0, std::fabs(pieces[seed].line.centroid.y)};
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (is_left(pieces[k]) != is_left(pieces[seed]) || !leads_to(pieces[seed], pieces[k], config)) continue;
    kerb.pieces.push_back(k);
    kerb.returns += pieces[k].points.size();
  }
  const auto fitted = fit::fit_line_robust(places_of(points, pieces, kerb.pieces));
  if (fitted) kerb.line = fitted->line;
  return kerb;
}

/// The one of most returns; of those with half as many or more, the innermost.
std::optional<Kerb> best_kerb(std::span<const LayerPoint> points, const std::vector<KerbPiece>& pieces,
                              bool left, const KerbConfig& config) {
  constexpr double kNearly = 0.5;
  std::vector<Kerb> kerbs;
  for (std::size_t seed = 0; seed < pieces.size(); ++seed) {
    if (is_left(pieces[seed]) == left) kerbs.push_back(kerb_from(points, pieces, seed, config));
  }
  if (kerbs.empty()) return std::nullopt;
  const std::size_t most = std::ranges::max_element(kerbs, {}, &Kerb::returns)->returns;
  std::erase_if(kerbs, [&](const Kerb& kerb) {
    return static_cast<double>(kerb.returns) < kNearly * static_cast<double>(most);
  });
  const auto innermost = std::ranges::min_element(kerbs, {}, &Kerb::lateral_m);
  const auto same = [&](const Kerb& kerb) {
    return std::fabs(kerb.lateral_m - innermost->lateral_m) <= 2.0 * config.joined_m;
  };
  const auto best = std::ranges::max_element(
      kerbs, {}, [&](const Kerb& kerb) { return same(kerb) ? kerb.returns : std::size_t{0}; });
  return *best;
}

std::vector<std::size_t> returns_of(std::span<const LayerPoint> points, const std::vector<bool>& low,
                                    const std::vector<KerbPiece>& pieces, bool left,
                                    const KerbConfig& config) {
  std::vector<std::size_t> returns;
  const auto kerb = best_kerb(points, pieces, left, config);
  if (!kerb) return returns;
  for (const std::size_t k : kerb->pieces)
    returns.insert(returns.end(), pieces[k].points.begin(), pieces[k].points.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 place = points[i].place.xy();
    if (low[i] && (place.y > 0.0) == left &&
        std::fabs(fit::signed_distance(kerb->line, place)) <= 0.5 * config.joined_m)
      returns.push_back(i);
  }
  std::ranges::sort(returns);
  const auto again = std::ranges::unique(returns);
  returns.erase(again.begin(), again.end());
  return returns;
}

}  // namespace

KerbReturns kerb_returns(std::span<const LayerPoint> points, std::span<const Object> objects,
                         const KerbConfig& config) {
  const std::vector<bool> low = low_points(points, objects, config);
  const std::vector<KerbPiece> pieces = kerb_pieces(points, low, config);
  return {returns_of(points, low, pieces, true, config), returns_of(points, low, pieces, false, config)};
}

}  // namespace verge::detect::line_fit
