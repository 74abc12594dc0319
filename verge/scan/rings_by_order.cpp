// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "verge/scan/rings.hpp"

namespace verge {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kTurn = 2.0F * kPi;

// The same angle in [0, 2 pi), for one within a turn of it.
float to_turn(float a) { return a < 0.0F ? a + kTurn : (a >= kTurn ? a - kTurn : a); }

// The same step in [-pi, pi].
float to_step(float a) { return a > kPi ? a - kTurn : (a < -kPi ? a + kTurn : a); }

// The points that are returns, in the input's order; the others say nothing of how the sensor turned.
// Azimuths count in the direction in which the points run, so that they rise but for the ends of rings.
struct Track {
  std::vector<std::uint32_t> index;
  std::vector<float> azimuth;  // in [-pi, pi]
};

Track track_of(const Scan& scan) {
  std::vector<std::uint32_t> index(scan.size());
  std::iota(index.begin(), index.end(), 0U);
  if (std::find(scan.range.begin(), scan.range.end(), 0.0F) != scan.range.end()) {
    std::erase_if(index, [&scan](std::uint32_t i) { return scan.range[i] == 0.0F; });
  }
  std::vector<float> azimuth(index.size());
  for (std::size_t k = 0; k < index.size(); ++k) azimuth[k] = scan.azimuth[index[k]];
  return {.index = std::move(index), .azimuth = std::move(azimuth)};
}

// Turns the azimuths so that they rise. False where the points run neither way.
bool set_direction(Track& track) {
  constexpr float kNear = 0.2F;  // neighbours in a ring stand closer than this but for gaps
  std::uint32_t forward = 0;
  std::uint32_t backward = 0;
  const float* const azimuth = track.azimuth.data();
  for (std::size_t k = 1; k < track.azimuth.size(); ++k) {
    const float step = to_step(azimuth[k] - azimuth[k - 1]);
    forward += static_cast<std::uint32_t>(step > 0.0F && step < kNear);
    backward += static_cast<std::uint32_t>(step < 0.0F && step > -kNear);
  }
  if (10 * static_cast<std::size_t>(forward) > 9 * track.azimuth.size()) return true;
  for (float& a : track.azimuth) a = -a;
  return 10 * static_cast<std::size_t>(backward) > 9 * track.azimuth.size();
}

float sine_of_elevation(const Scan& scan, std::uint32_t i) { return scan.z[i] / scan.range[i]; }

// Within the arc of `width` from `from` on, the azimuth that most of the steps in elevation from one ring to
// the next reach across.
float steepest_azimuth(const Scan& scan, const Track& track, float from, float width) {
  constexpr std::size_t kBins = 256;
  constexpr float kRiseMax = 0.02F;  // more than that is a jump of range, not of ring
  const auto bin_of = [width](float at) {
    return static_cast<std::size_t>(std::clamp(at / width, 0.0F, 1.0F) * static_cast<float>(kBins));
  };
  std::array<double, kBins + 2> rises{};  // first as changes from bin to bin
  for (std::size_t k = 1; k < track.azimuth.size(); ++k) {
    const float end = to_turn(track.azimuth[k] - from);
    const float begin = end - to_step(track.azimuth[k] - track.azimuth[k - 1]);
    if (begin >= width || begin >= end) continue;
    const float rise = sine_of_elevation(scan, track.index[k]) - sine_of_elevation(scan, track.index[k - 1]);
    const auto bounded = static_cast<double>(std::clamp(rise, -kRiseMax, kRiseMax));
    rises[bin_of(begin)] += bounded;
    rises[bin_of(end) + 1] -= bounded;
  }
  std::partial_sum(rises.begin(), rises.end(), rises.begin());
  const auto steepest = std::max_element(rises.begin(), rises.end(),
                                         [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  const auto bin = static_cast<float>(steepest - rises.begin());
  return to_step(from + width * (bin + 0.5F) / static_cast<float>(kBins));
}

// The azimuth from which every ring starts: it lies in the gap between the last point and the first.
std::optional<float> seam_of(const Scan& scan, const Track& track, Seam seam) {
  constexpr float kSlack = 0.01F;
  const float from = track.azimuth.back() - kSlack;
  const float width = to_turn(track.azimuth.front() + kSlack - from);
  if (width > kPi) return std::nullopt;  // rings that overlap themselves, or no rings
  for (const float usual : {0.0F, kPi}) {
    if (to_turn(usual - from) <= width) return usual;
  }
  if (seam == Seam::kUsual) return std::nullopt;
  return steepest_azimuth(scan, track, from, width);
}

// Counts the turns: a ring ends where the azimuth falls back towards the seam.
RingNumbers count_turns(const Scan& scan, const Track& track, float seam) {
  constexpr float kFall = 0.5F;
  constexpr float kJitter = 0.03F;  // a point just past the seam may be followed by one just before it
  RingNumbers rings{.ring_of = std::vector<std::uint32_t>(scan.size()), .count = 1};
  std::uint32_t ring = 0;
  std::uint32_t run = 0;  // first point not yet numbered; points that are no returns go with those before
  float before = to_turn(track.azimuth.front() - seam);
  for (std::size_t k = 1; k < track.azimuth.size(); ++k) {
    const float here = to_turn(track.azimuth[k] - seam);
    const bool ends = here < before - kFall;
    const bool back = here > before + kTurn - kJitter && ring > 0;
    before = here;
    if (!ends && !back) continue;
    std::fill(rings.ring_of.begin() + run, rings.ring_of.begin() + track.index[k], ring);
    run = track.index[k];
    ring = ends ? ring + 1 : ring - 1;
    rings.count = std::max<std::size_t>(rings.count, ring + 1);
  }
  std::fill(rings.ring_of.begin() + run, rings.ring_of.end(), ring);
  return rings;
}

// Mean and spread of the sine of elevation over each ring's returns.
struct Elevation {
  double mean = 0.0;
  double deviation = 0.0;
  double count = 0.0;
};

std::vector<Elevation> elevations_of(const Scan& scan, const Track& track, const RingNumbers& rings) {
  constexpr std::size_t kStride = 8;  // a sample will do; a ring that it misses does not count
  std::vector<Elevation> sums(rings.count);
  for (std::size_t k = 0; k < track.index.size(); k += kStride) {
    const std::uint32_t i = track.index[k];
    const auto sine = static_cast<double>(sine_of_elevation(scan, i));
    Elevation& sum = sums[rings.ring_of[i]];
    sum.mean += sine;
    sum.deviation += sine * sine;
    sum.count += 1.0;
  }
  std::erase_if(sums, [](const Elevation& sum) { return sum.count == 0.0; });
  for (Elevation& sum : sums) {
    sum.mean /= sum.count;
    sum.deviation = std::sqrt(std::max(0.0, sum.deviation / sum.count - sum.mean * sum.mean));
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
  Track track = track_of(scan);
  if (track.index.size() < kRingsMin * kReturnsMin || !set_direction(track)) return std::nullopt;
  const auto start = seam_of(scan, track, seam);
  if (!start) return std::nullopt;
  RingNumbers rings = count_turns(scan, track, *start);
  if (rings.count < kRingsMin || track.index.size() < kReturnsMin * rings.count) return std::nullopt;
  if (!are_rings(elevations_of(scan, track, rings))) return std::nullopt;
  return rings;
}

}  // namespace verge
