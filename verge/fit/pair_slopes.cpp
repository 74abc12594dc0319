// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/fit/pair_slopes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "verge/core/random.hpp"
#include "verge/core/statistics.hpp"

namespace verge::fit {
namespace {

constexpr int kMostRounds =
    60;  // of drawing bounds together: each halves what lies between them, or how far they are

/// Bounds keep so far from the slopes that they are made of: far more than rounding, and nothing to users.
double margin_at(double slope) { return 1e-9 * std::max(1.0, std::abs(slope)); }

/// Merges the sorted runs from[begin .. middle) and from[middle .. end); how many pairs stood in the wrong
/// order.
template <class Value>
std::size_t merge(std::span<const Value> from, std::size_t begin, std::size_t middle, std::size_t end,
                  std::span<Value> to) {
  std::size_t wrong = 0;
  std::size_t left = begin;
  std::size_t right = middle;
  std::size_t out = begin;
  while (left < middle && right < end) {  // arithmetic instead of branches, which could not be foreseen
    const std::size_t take_right = from[right] < from[left] ? 1 : 0;
    to[out++] = from[left + take_right * (right - left)];
    wrong += take_right * (middle - left);
    right += take_right;
    left += 1 - take_right;
  }
  const auto rest = std::ranges::copy(from.subspan(left, middle - left), to.subspan(out).begin()).out;
  std::ranges::copy(from.subspan(right, end - right), rest);
  return wrong;
}

/// Sorts; how many pairs stood in the wrong order.
template <class Value>
std::size_t merge_sort(std::vector<Value>& values) {
  std::vector<Value> merged(values.size());
  std::size_t wrong = 0;
  for (std::size_t width = 1; width < values.size(); width *= 2) {
    for (std::size_t begin = 0; begin < values.size(); begin += 2 * width) {
      const std::size_t middle = std::min(begin + width, values.size());
      const std::size_t end = std::min(middle + width, values.size());
      wrong += merge(std::span<const Value>(values), begin, middle, end, std::span(merged));
    }
    values.swap(merged);
  }
  return wrong;
}

/// In ascending order of x, then y.
std::vector<Vec2> in_order(std::span<const Vec2> points) {
  std::vector<Vec2> sorted(points.begin(), points.end());
  std::ranges::sort(sorted, [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return sorted;
}

}  // namespace

PairSlopes::PairSlopes(std::span<const Vec2> points, double min_step_m)
    : min_step_m_(min_step_m), points_(in_order(points)) {
  assert(min_step_m > 0.0);
  if (points_.empty()) return;
  middle_ = std::midpoint(points_.front().x, points_.back().x);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t j = i + 1; j < points_.size() && !has_slope({i, j}); ++j) too_near_.emplace_back(i, j);
  }
  size_ = points_.size() * (points_.size() - 1) / 2 - too_near_.size();
  if (points_.size() <= kHeldPoints) held_ = all_slopes();
}

bool PairSlopes::has_slope(Pair pair) const {
  return points_[pair.second].x - points_[pair.first].x >= min_step_m_;
}

double PairSlopes::slope_of(Pair pair) const {
  const Vec2 d = points_[pair.second] - points_[pair.first];
  return d.y / d.x;
}

std::vector<double> PairSlopes::all_slopes() const {
  std::vector<double> slopes;
  slopes.reserve(size_);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t j = i + 1; j < points_.size(); ++j) {
      if (has_slope({i, j})) slopes.push_back(slope_of({i, j}));
    }
  }
  return slopes;
}

/// x counts from the middle of all, so that rounding is least.
double PairSlopes::projected(std::size_t i, double slope) const {
  return points_[i].y - slope * (points_[i].x - middle_);
}

PairSlopes::Sweep PairSlopes::sweep_from(double slope) const {
  Sweep sweep{.at = {slope, 0}, .order = std::vector<Projected>(points_.size())};
  for (std::size_t i = 0; i < points_.size(); ++i) sweep.order[i] = {projected(i, slope), i};
  const auto wrong = [&](Pair p) { return sweep.order[p.second].value < sweep.order[p.first].value; };
  const auto near = static_cast<std::size_t>(std::ranges::count_if(too_near_, wrong));
  sweep.at.below = merge_sort(sweep.order) - near;
  return sweep;
}

/// By insertion: O(n) and the number of pairs whose slope is passed, each of which is told to `pass` until
/// that says that it has enough. Then the sweep is of no more use.
template <class Pass>
void PairSlopes::move(Sweep& sweep, double slope, Pass pass) const {
  const bool up = slope > sweep.at.slope;
  std::size_t passed = 0;
  for (Projected& p : sweep.order) p.value = projected(p.index, slope);
  for (std::size_t k = 1; k < sweep.order.size(); ++k) {
    const Projected moving = sweep.order[k];
    std::size_t to = k;
    for (; to > 0 && sweep.order[to - 1].value > moving.value; --to) {
      const std::size_t other = sweep.order[to - 1].index;
      const Pair pair = up ? Pair{other, moving.index} : Pair{moving.index, other};
      sweep.order[to] = sweep.order[to - 1];
      if (!has_slope(pair)) continue;
      ++passed;
      if (!pass(pair)) return;
    }
    sweep.order[to] = moving;
  }
  sweep.at = {slope, up ? sweep.at.below + passed : sweep.at.below - passed};
}

/// Moves there, and draws the bound that it makes.
void PairSlopes::look_at(Sweep& sweep, Band& band, double probe, Ranks ranks) const {
  if (probe <= band.low.slope || probe >= band.high.slope) return;
  move(sweep, probe, [](Pair) { return true; });
  if (sweep.at.below <= ranks.first) band.low = sweep.at;
  if (sweep.at.below > ranks.last) band.high = sweep.at;
}

/// From a slope drawn by chance for the first rank, and from there to where the other bound should be: as far
/// as that one missed, and three standard deviations of how slopes drawn by chance lie between.
void PairSlopes::start(Sweep& sweep, Band& band, Ranks ranks) const {
  std::vector<double> drawn = sample(points_.size(), 0);
  const double count = static_cast<double>(drawn.size());
  const double all = static_cast<double>(size_);
  const auto drawn_at = [&](double share) {
    return value_at_rank(drawn, std::round(std::clamp(share, 0.0, 1.0) * (count - 1.0)));
  };
  const double share = static_cast<double>(ranks.first) / all;
  const double first = drawn_at(share);
  sweep = sweep_from(first - margin_at(first));
  look_at(sweep, band, sweep.at.slope, ranks);
  const double miss = share - static_cast<double>(sweep.at.below) / all;
  const double away = std::copysign(1.0, miss);
  const double second =
      drawn_at(share + miss + away * (3.0 * std::sqrt(std::abs(miss) / count) + 2.0 / count));
  look_at(sweep, band, second + away * margin_at(second), ranks);
}

/// Bounds where the ranks should lie if slopes were spread evenly between those there are; and in the middle,
/// where that was not so.
void PairSlopes::narrow(Sweep& sweep, Band& band, Ranks ranks) const {
  const Band before = band;
  const double inside = static_cast<double>(before.inside());
  const double width = before.high.slope - before.low.slope;
  const double spare = 0.02 * inside;
  const double first = static_cast<double>(ranks.first - before.low.below) - spare;
  const double last = static_cast<double>(ranks.last - before.low.below) + spare;
  look_at(sweep, band, before.low.slope + width * first / inside, ranks);
  look_at(sweep, band, before.low.slope + width * last / inside, ranks);
  if (2 * band.inside() > before.inside())
    look_at(sweep, band, std::midpoint(band.low.slope, band.high.slope), ranks);
}

/// The slopes in the band; of more than kCollectPerPoint for each point, which is where they are all the
/// same, the first ones.
std::vector<double> PairSlopes::slopes_in(Sweep& sweep, const Band& band) const {
  const std::size_t most = std::min(band.inside(), kCollectPerPoint * points_.size());
  if (sweep.at.slope != band.high.slope) move(sweep, band.low.slope, [](Pair) { return true; });
  const double other = sweep.at.slope == band.high.slope ? band.low.slope : band.high.slope;
  std::vector<double> slopes;
  slopes.reserve(most);
  move(sweep, other, [&](Pair pair) {
    slopes.push_back(slope_of(pair));
    return slopes.size() < most;
  });
  return slopes;
}

double PairSlopes::at(double position) {
  assert(size_ > 0 && position >= 0.0 && position <= static_cast<double>(size_ - 1));
  if (!held_.empty()) return value_at_rank(held_, position);
  const Ranks ranks{static_cast<std::size_t>(position), static_cast<std::size_t>(std::ceil(position))};
  const auto [lowest, highest] = std::ranges::minmax(points_, {}, &Vec2::y);
  const double steepest = 1.0 + 2.0 * (highest.y - lowest.y) / min_step_m_;
  Band band{{-steepest, 0}, {steepest, size_}};
  Sweep sweep;
  start(sweep, band, ranks);
  const std::size_t enough = kCollectPerPoint * points_.size();
  const auto tied = [&] { return band.high.slope - band.low.slope <= 4.0 * margin_at(band.low.slope); };
  for (int i = 0; i < kMostRounds && band.inside() > enough && !tied(); ++i) narrow(sweep, band, ranks);
  std::vector<double> slopes = slopes_in(sweep, band);
  if (slopes.empty()) return band.low.slope;  // coordinates so large that rounding has taken all differences
  if (band.inside() > slopes.size()) return slopes.front();
  return value_at_rank(slopes, position - static_cast<double>(band.low.below));
}

std::optional<double> PairSlopes::median() {
  if (size_ == 0) return std::nullopt;
  return at(0.5 * static_cast<double>(size_ - 1));
}

std::vector<double> PairSlopes::sample(std::size_t count, std::uint64_t seed) const {
  if (size_ == 0) return {};
  RandomSequence random(seed);
  std::vector<double> slopes(count);
  const auto pick_one = [&](const std::vector<double>& from) { return from[random.below(from.size())]; };
  if (size_ < too_near_.size()) {  // most draws would be in vain
    const std::vector<double> all = all_slopes();
    std::ranges::generate(slopes, [&] { return pick_one(all); });
    return slopes;
  }
  const auto draw = [&] {
    const auto [i, j] = std::minmax({random.below(points_.size()), random.below(points_.size())});
    return Pair{i, j};
  };
  for (double& slope : slopes) {
    Pair pair = draw();
    while (!has_slope(pair)) pair = draw();
    slope = slope_of(pair);
  }
  return slopes;
}

}  // namespace verge::fit
