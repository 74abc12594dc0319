// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "verge/scan/rings.hpp"

namespace verge {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTurn = 2.0F * kPi;

// a in [0, 2 pi), for a within three turns of it.
float to_turn(float a) {
  a -= kTurn * std::floor(a / kTurn);
  return a < kTurn ? a : 0.0F;
}

// The same step in [-pi, pi].
float to_step(float a) { return a > kPi ? a - kTurn : (a < -kPi ? a + kTurn : a); }

// Indices of the points that are returns: the others say nothing of how the sensor turned.
std::vector<std::uint32_t> returns_of(const Scan& scan) {
  std::vector<std::uint32_t> returns;
  returns.reserve(scan.size());
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    if (scan.range[i] > 0.0F) returns.push_back(i);
  }
  return returns;
}

// +1 where the points run counter-clockwise from one to the next, -1 where clockwise, 0 where neither.
int direction_of(const Scan& scan, const std::vector<std::uint32_t>& returns) {
  constexpr float kNear = 0.2F;  // neighbours in a ring stand closer than this but for gaps
  std::size_t forward = 0;
  std::size_t backward = 0;
  for (std::size_t k = 1; k < returns.size(); ++k) {
    const float step = to_step(scan.azimuth[returns[k]] - scan.azimuth[returns[k - 1]]);
    forward += step > 0.0F && step < kNear ? 1U : 0U;
    backward += step < 0.0F && step > -kNear ? 1U : 0U;
  }
  if (10 * forward > 9 * returns.size()) return 1;
  if (10 * backward > 9 * returns.size()) return -1;
  return 0;
}

// Within the arc of `width` from `from` on (in the turn's direction), the azimuth that most of the steps in
// elevation from one ring to the next reach across.
float steepest_azimuth(const Scan& scan, const std::vector<std::uint32_t>& returns, float sign, float from,
                       float width) {
  constexpr std::size_t kBins = 256;
  constexpr float kRiseMax = 0.02F;  // more than that is a jump of range, not of ring
  const auto bin_of = [width](float at) {
    return static_cast<std::size_t>(std::clamp(at / width, 0.0F, 1.0F) * static_cast<float>(kBins));
  };
  std::array<double, kBins + 2> rises{};  // first as changes from bin to bin
  for (std::size_t k = 1; k < returns.size(); ++k) {
    const std::uint32_t a = returns[k - 1];
    const std::uint32_t b = returns[k];
    const float end = to_turn(sign * (scan.azimuth[b] - from));
    const float begin = end - sign * to_step(scan.azimuth[b] - scan.azimuth[a]);
    if (begin >= width || begin >= end) continue;
    const float rise = scan.z[b] / scan.range[b] - scan.z[a] / scan.range[a];
    const auto bounded = static_cast<double>(std::clamp(rise, -kRiseMax, kRiseMax));
    rises[bin_of(begin)] += bounded;
    rises[bin_of(end) + 1] -= bounded;
  }
  std::partial_sum(rises.begin(), rises.end(), rises.begin());
  const auto steepest = std::max_element(rises.begin(), rises.end(),
                                         [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  const auto bin = static_cast<float>(steepest - rises.begin());
  return from + sign * width * (bin + 0.5F) / static_cast<float>(kBins);
}

// The azimuth from which every ring starts: it lies in the gap between the last point and the first.
std::optional<float> seam_of(const Scan& scan, const std::vector<std::uint32_t>& returns, float sign,
                             Seam seam) {
  constexpr float kSlack = 0.01F;
  const float last = scan.azimuth[returns.back()];
  const float width = to_turn(sign * (scan.azimuth[returns.front()] - last) + 2.0F * kSlack);
  if (width > kPi) return std::nullopt;  // rings that overlap themselves, or no rings
  const float from = last - sign * kSlack;
  for (const float usual : {0.0F, kPi}) {
    if (to_turn(sign * (usual - from)) <= width) return usual;
  }
  if (seam == Seam::kUsual) return std::nullopt;
  return steepest_azimuth(scan, returns, sign, from, width);
}

// Counts the turns: a ring ends where the azimuth falls back towards the seam.
RingNumbers count_turns(const Scan& scan, const std::vector<std::uint32_t>& returns, float sign, float seam) {
  constexpr float kFall = 0.5F;
  constexpr float kJitter = 0.03F;  // a point just past the seam may be followed by one just before it
  RingNumbers rings{.ring_of = std::vector<std::uint32_t>(scan.size(), 0), .count = 0, .remark = {}};
  std::uint32_t ring = 0;
  std::uint32_t next = 0;
  float before = 0.0F;
  for (const std::uint32_t i : returns) {
    const float here = to_turn(sign * (scan.azimuth[i] - seam));
    std::fill(rings.ring_of.begin() + next, rings.ring_of.begin() + i, ring);  // no returns in between
    if (here < before - kFall) ++ring;
    if (here > before + kTurn - kJitter && ring > 0) --ring;
    rings.ring_of[i] = ring;
    rings.count = std::max<std::size_t>(rings.count, ring + 1);
    before = here;
    next = i + 1;
  }
  std::fill(rings.ring_of.begin() + next, rings.ring_of.end(), ring);
  return rings;
}

// Mean and spread of the sine of elevation over each ring's returns.
struct Elevation {
  double mean = 0.0;
  double deviation = 0.0;
};

std::vector<Elevation> elevations_of(const Scan& scan, const std::vector<std::uint32_t>& returns,
                                     const RingNumbers& rings) {
  std::vector<Elevation> sums(rings.count);
  std::vector<double> count(rings.count, 0.0);
  for (const std::uint32_t i : returns) {
    const double sine = static_cast<double>(scan.z[i] / scan.range[i]);
    Elevation& sum = sums[rings.ring_of[i]];
    sum.mean += sine;
    sum.deviation += sine * sine;
    count[rings.ring_of[i]] += 1.0;
  }
  for (std::size_t r = 0; r < sums.size(); ++r) {
    sums[r].mean /= count[r];
    sums[r].deviation = std::sqrt(std::max(0.0, sums[r].deviation / count[r] - sums[r].mean * sums[r].mean));
  }
  return sums;
}

// Whether the turns are rings: thin in elevation against the whole, and going steadily up or down.
bool are_rings(const std::vector<Elevation>& turns) {
  std::vector<double> spread(turns.size());
  std::transform(turns.begin(), turns.end(), spread.begin(), [](const Elevation& e) { return e.deviation; });
  const auto middle = spread.begin() + static_cast<std::ptrdiff_t>(spread.size() / 2);
  std::nth_element(spread.begin(), middle, spread.end());
  std::size_t up = 0;
  double climb = 0.0;
  for (std::size_t r = 1; r < turns.size(); ++r) {
    up += turns[r].mean > turns[r - 1].mean ? 1U : 0U;
    climb += std::fabs(turns[r].mean - turns[r - 1].mean);
  }
  const std::size_t steady = std::max(up, turns.size() - 1 - up);
  return 8.0 * *middle < climb && 10 * steady >= 9 * (turns.size() - 1);
}

}  // namespace

std::optional<RingNumbers> rings_by_order(const Scan& scan, Seam seam) {
  constexpr std::size_t kRingsMin = 4;
  constexpr std::size_t kReturnsMin = 16;  // a ring, on average
  const std::vector<std::uint32_t> returns = returns_of(scan);
  if (returns.size() < kRingsMin * kReturnsMin) return std::nullopt;
  const int direction = direction_of(scan, returns);
  if (direction == 0) return std::nullopt;
  const auto sign = static_cast<float>(direction);
  const auto start = seam_of(scan, returns, sign, seam);
  if (!start) return std::nullopt;
  RingNumbers rings = count_turns(scan, returns, sign, *start);
  if (rings.count < kRingsMin || returns.size() < kReturnsMin * rings.count) return std::nullopt;
  if (!are_rings(elevations_of(scan, returns, rings))) return std::nullopt;
  return rings;
}

}  // namespace verge
