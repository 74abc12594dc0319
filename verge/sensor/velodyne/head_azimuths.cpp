// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/head_azimuths.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr int kReach = 3;  // candidates on either side of the likely azimuth
constexpr std::size_t kCandidates = 2 * kReach + 1;
constexpr double kSampleWeight = 2.5e5;  // of a square: a decoded sample is off by 0.002 units
constexpr double kTurnWeight = 1e-2;     // a motor's turn differs by some units from step to step

/// To [-half a turn, half a turn).
double wrapped(double units) { return units - kTurn * std::floor(units / kTurn + 0.5); }

std::uint16_t on_wire(double units) {
  const auto whole = static_cast<std::int64_t>(std::llround(units)) % kTurn;
  return static_cast<std::uint16_t>(whole < 0 ? whole + kTurn : whole);
}

/// A line through all samples of a packet: azimuth at its begin, and the turn of a step.
struct Line {
  double begin = 0.0;
  double turn = 0.0;
};

std::optional<Line> line_through(std::span<const std::vector<HeadSample>> steps, double turn) {
  constexpr double kLeastSpread = 0.02;  // of a step, squared, of all samples: enough for a slope
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  double first = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const HeadSample& sample : steps[i]) {
      if (n == 0.0) first = sample.azimuth;
      const double x = static_cast<double>(i) + sample.share;
      const double y = wrapped(sample.azimuth - first);
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  if (n == 0.0) return std::nullopt;
  const double spread = sxx - sx * sx / n;
  const double slope = spread / n > kLeastSpread ? (sxy - sx * sy / n) / spread : turn;
  return Line{first + (sy - slope * sx) / n, slope};
}

/// What the samples of a step say, about its likely azimuth.
class StepCost {
 public:
  StepCost(std::span<const HeadSample> samples, double line, double turn) {
    double off = 0.0;
    for (const HeadSample& s : samples) off += wrapped(s.azimuth - line - turn * s.share);
    likely_ = std::llround(line + (samples.empty() ? 0.0 : off / static_cast<double>(samples.size())));
    for (const HeadSample& s : samples) {
      const double d = wrapped(s.azimuth - static_cast<double>(likely_));
      n_ += 1.0;
      f_ += s.share;
      ff_ += s.share * s.share;
      d_ += d;
      df_ += d * s.share;
      dd_ += d * d;
    }
  }
  [[nodiscard]] std::int64_t azimuth(std::size_t candidate) const {
    return likely_ + static_cast<std::int64_t>(candidate) - kReach;
  }
  /// Sum of squares of the samples from a + k share.
  [[nodiscard]] double operator()(std::int64_t azimuth, double turn) const {
    const auto a = static_cast<double>(azimuth - likely_);
    return kSampleWeight *
           (dd_ + n_ * a * a + ff_ * turn * turn + 2.0 * (a * turn * f_ - a * d_ - turn * df_));
  }

 private:
  std::int64_t likely_ = 0;
  double n_ = 0.0, f_ = 0.0, ff_ = 0.0, d_ = 0.0, df_ = 0.0, dd_ = 0.0;
};

/// Cheapest way through the candidates of all steps (dynamic programming).
std::vector<std::int64_t> cheapest_way(const std::vector<StepCost>& steps, double turn) {
  std::vector<std::array<std::size_t, kCandidates>> from(steps.size());
  std::array<double, kCandidates> cost{};
  for (std::size_t i = 1; i < steps.size(); ++i) {
    std::array<double, kCandidates> next{};
    next.fill(std::numeric_limits<double>::infinity());
    for (std::size_t a = 0; a < kCandidates; ++a) {
      for (std::size_t b = 0; b < kCandidates; ++b) {
        const auto k = static_cast<double>(steps[i].azimuth(b) - steps[i - 1].azimuth(a));
        double sum =
            cost[a] + steps[i - 1](steps[i - 1].azimuth(a), k) + kTurnWeight * (k - turn) * (k - turn);
        if (i + 1 == steps.size()) sum += steps[i](steps[i].azimuth(b), k);
        if (sum >= next[b]) continue;
        next[b] = sum;
        from[i][b] = a;
      }
    }
    cost = next;
  }
  std::size_t at = 0;
  for (std::size_t b = 1; b < kCandidates; ++b) at = cost[b] < cost[at] ? b : at;
  std::vector<std::int64_t> way(steps.size());
  for (std::size_t i = steps.size(); i-- > 0;) {
    way[i] = steps[i].azimuth(at);
    at = from[i][at];
  }
  return way;
}

}  // namespace

HeadAzimuths fit_azimuths(std::span<const std::vector<HeadSample>> steps, double turn, double begin) {
  const Line line = line_through(steps, turn).value_or(Line{begin, turn});
  std::vector<StepCost> costs;
  costs.reserve(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    costs.emplace_back(steps[i], line.begin + static_cast<double>(i) * line.turn, line.turn);
  }
  HeadAzimuths out{{}, line.turn};
  for (const std::int64_t azimuth : cheapest_way(costs, line.turn)) {
    out.azimuth.push_back(on_wire(static_cast<double>(azimuth)));
  }
  return out;
}

}  // namespace verge::sensor::velodyne
