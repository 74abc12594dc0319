// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/road_width/kerb_return.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace verge::detect::road_width {
namespace {

constexpr double kDeepest_m = 1.5;
constexpr std::array kRadii_m = {0.25, 0.35, 0.5, 0.71, 1.0,  1.4,  2.0, 2.8,
                                 4.0,  5.7,  8.0, 11.3, 16.0, 22.6, 32.0};
constexpr double kBefore_m = 3.2;  // a circle of 32 m has moved out 0.16 m by then
constexpr double kBehind_m = 0.1;
constexpr double kStep_m = 0.1;

/// Points of one stretch of the way as one: slow vehicles see the same place many times.
struct Stretch {
  double along_m = 0.0;
  double outward_m = 0.0;
  Vec2 open{};  ///< Mean of the open ones.
  double count = 0.0;
};

/// Those that are open, or those that are not.
std::vector<Stretch> stretches(std::span<const KerbPoint> points, bool open) {
  constexpr double kLength_m = 0.15;
  std::vector<Stretch> all;
  double begin_m = 0.0;
  for (const KerbPoint& p : points) {
    if (p.open.has_value() != open) continue;
    if (all.empty() || p.along_m >= begin_m + kLength_m) {
      begin_m = p.along_m;
      all.emplace_back();
    }
    Stretch& last = all.back();
    last.along_m += p.along_m;
    last.outward_m += std::min(p.outward_m, kDeepest_m);
    last.open = last.open + p.open.value_or(Vec2{});
    last.count += 1.0;
  }
  for (Stretch& s : all) {
    s.along_m /= s.count;
    s.outward_m /= s.count;
    s.open = (1.0 / s.count) * s.open;
  }
  return all;
}

/// How far a circle has left the kerb that far behind its begin.
double left_m(double behind_m, double radius_m) {
  if (behind_m <= 0.0) return 0.0;
  if (behind_m >= radius_m) return kDeepest_m;
  return std::min(kDeepest_m, radius_m - std::sqrt(radius_m * radius_m - behind_m * behind_m));
}

/// Whether a circle that far behind its begin has turned away from who looks there.
bool is_hidden(double behind_m, double radius_m, Vec2 open) {
  if (behind_m <= 0.0) return false;
  if (behind_m >= radius_m) return true;
  const double forward_m = std::sqrt(radius_m * radius_m - behind_m * behind_m);
  return behind_m * open.x > forward_m * (open.y + left_m(behind_m, radius_m));
}

/// What all points say, and the open ones among them.
struct Sights {
  std::vector<Stretch> seen, open;
};

/// Minus twice the logarithm of how likely the sights are. None can say more than three sigma: some
/// lines lose the kerb before it has turned away.
double misfit(const Sights& sights, double begin_m, double radius_m, double sigma_m) {
  constexpr double kMost = 9.0;
  constexpr double kUneven_m =
      0.03;  // what more points of a stretch do not mend: kerbs are not exactly round
  double sum = 0.0;
  const auto add = [&](const Stretch& s) {
    const double off_m = s.outward_m - left_m(s.along_m - begin_m, radius_m);
    sum += std::min(off_m * off_m / (kUneven_m * kUneven_m + sigma_m * sigma_m / s.count), kMost);
  };
  for (const Stretch& s : sights.seen) add(s);
  for (const Stretch& s : sights.open) {
    if (!is_hidden(s.along_m - begin_m, radius_m, s.open)) add(s);
  }
  return sum;
}

/// Share of the points from `first_m` on that lie on the circle, or as deep as it is beyond it.
double share_on(std::span<const KerbPoint> points, double first_m, double begin_m, double radius_m) {
  constexpr double kNear_m = 0.15;
  double on = 0.0;
  double all = 0.0;
  for (const KerbPoint& p : points) {
    if (p.along_m < first_m) continue;
    const double behind_m = p.along_m - begin_m;
    const double off_m = std::min(p.outward_m, kDeepest_m) - left_m(behind_m, radius_m);
    const bool hidden = p.open && is_hidden(behind_m, radius_m, *p.open);
    all += 1.0;
    on += hidden || std::fabs(off_m) <= kNear_m ? 1.0 : 0.0;
  }
  return all > 0.0 ? on / all : 0.0;
}

}  // namespace

std::optional<KerbReturn> fit_kerb_return(std::span<const KerbPoint> points, double first_m, double sigma_m,
                                          RadiusRange wide_m) {
  if (points.empty()) return std::nullopt;
  const Sights all{stretches(points, false), stretches(points, true)};
  constexpr auto kBegins = static_cast<std::size_t>((kBefore_m + kBehind_m) / kStep_m) + 1;
  std::vector<double> misfits;
  for (const double radius_m : kRadii_m) {
    for (std::size_t i = 0; i < kBegins; ++i)
      misfits.push_back(
          misfit(all, first_m - kBefore_m + kStep_m * static_cast<double>(i), radius_m, sigma_m));
  }
  const auto best = std::min_element(misfits.begin(), misfits.end());
  const double least = *best;
  double sum = 0.0;
  double begin = 0.0;
  double squares = 0.0;
  double wide = 0.0;
  double log_radius = 0.0;
  for (std::size_t k = 0; k < misfits.size(); ++k) {
    const double weight = std::exp(-0.5 * (misfits[k] - least));
    const double before_m = -kBefore_m + kStep_m * static_cast<double>(k % kBegins);
    const double radius_m = kRadii_m.at(k / kBegins);
    sum += weight;
    begin += weight * before_m;
    squares += weight * before_m * before_m;
    log_radius += weight * std::log(radius_m);
    if (radius_m >= wide_m.least && radius_m <= wide_m.most) wide += weight;
  }
  begin /= sum;
  const auto best_index = static_cast<std::size_t>(best - misfits.begin());
  const double best_begin_m = first_m - kBefore_m + kStep_m * static_cast<double>(best_index % kBegins);
  return KerbReturn{
      .begin_m = first_m + begin,
      .sigma_m = std::sqrt(std::max(0.0, squares / sum - begin * begin) + kStep_m * kStep_m / 12.0),
      .radius_m = std::exp(log_radius / sum),
      .wide = wide / sum,
      .share = share_on(points, first_m, best_begin_m, kRadii_m.at(best_index / kBegins))};
}

}  // namespace verge::detect::road_width
