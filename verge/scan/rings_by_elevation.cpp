// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "verge/core/angle.hpp"
#include "verge/scan/rings.hpp"

namespace verge {
namespace {

// Two hundredths of a degree: a fifth of the least spacing of rings of any sensor on the market.
constexpr double kBin = 0.02 * std::numbers::pi / 180.0;
constexpr std::size_t kBins = 9001;
constexpr std::size_t kBandBins = 20;  // 0.4 degrees
constexpr std::size_t kBroadBins = 50;
constexpr double kBlurMax = 0.1;

// Bin of elevation of each point; kBins for points of range 0.
std::vector<std::uint32_t> bins_of(const Scan& scan) {
  std::vector<std::uint32_t> bins(scan.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    const float planar = std::sqrt(scan.x[i] * scan.x[i] + scan.y[i] * scan.y[i]);
    const auto elevation = static_cast<double>(fast_atan2(scan.z[i], planar));
    bins[i] = static_cast<std::uint32_t>((elevation + 0.5 * std::numbers::pi) / kBin + 0.5);
  }
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i] = scan.range[i] > 0.0F ? std::min<std::uint32_t>(bins[i], kBins - 1) : kBins;
  }
  return bins;
}

std::vector<std::uint32_t> histogram_of(const std::vector<std::uint32_t>& bins) {
  std::vector<std::uint32_t> histogram(kBins + 1, 0);
  for (const std::uint32_t bin : bins) ++histogram[bin];
  histogram.pop_back();
  return histogram;
}

// Sums of three neighbouring bins.
std::vector<std::uint32_t> smoothed(const std::vector<std::uint32_t>& histogram) {
  std::vector<std::uint32_t> sums = histogram;
  for (std::size_t b = 0; b < sums.size(); ++b) {
    if (b > 0) sums[b] += histogram[b - 1];
    if (b + 1 < sums.size()) sums[b] += histogram[b + 1];
  }
  return sums;
}

// Whether a valley lies below a peak by more than counting noise and by half.
bool stands_out(std::uint32_t peak, std::uint32_t valley) {
  const double fall = static_cast<double>(peak) - static_cast<double>(valley);
  const double both = static_cast<double>(peak) + static_cast<double>(valley);
  return peak > valley && 2U * static_cast<std::uint64_t>(valley) <= peak && fall * fall >= 9.0 * both;
}

// Peaks that stand out, told apart by the valleys between them.
struct Profile {
  std::vector<std::size_t> valleys;  // bins; ring r lies from valleys[r - 1] to before valleys[r]
  std::vector<std::size_t> peaks;    // one more than valleys
  double blur = 0.0;                 // mean over the valleys of valley / lower of the two peaks
};

// Walks up the histogram and turns at each peak and valley that stands out. A valley of several equal bins
// counts at its middle.
Profile profile_of(const std::vector<std::uint32_t>& counts) {
  Profile profile;
  std::size_t peak = 0;
  std::size_t valley_first = 0;
  std::size_t valley_last = 0;
  bool falling = false;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (!falling) {
      if (counts[b] > counts[peak]) peak = b;
      if (!stands_out(counts[peak], counts[b])) continue;
      profile.peaks.push_back(peak);
      falling = true;
      valley_first = valley_last = b;
    } else if (counts[b] < counts[valley_first]) {
      valley_first = valley_last = b;
    } else if (counts[b] == counts[valley_first] && valley_last + 1 == b) {
      valley_last = b;
    } else if (stands_out(counts[b], counts[valley_first])) {
      profile.valleys.push_back((valley_first + valley_last + 1) / 2);
      falling = false;
      peak = b;
    }
  }
  if (!falling) profile.peaks.push_back(peak);
  for (std::size_t v = 0; v < profile.valleys.size(); ++v) {
    const std::uint32_t lower = std::min(counts[profile.peaks[v]], counts[profile.peaks[v + 1]]);
    profile.blur += static_cast<double>(counts[profile.valleys[v]]) / static_cast<double>(lower);
  }
  if (!profile.valleys.empty()) profile.blur /= static_cast<double>(profile.valleys.size());
  return profile;
}

// Ring of each bin.
std::vector<std::uint32_t> rings_of(const Profile& profile) {
  std::vector<std::uint32_t> ring(kBins, 0);
  for (std::size_t b = 0, v = 0; b < kBins; ++b) {
    if (v < profile.valleys.size() && b >= profile.valleys[v]) ++v;
    ring[b] = static_cast<std::uint32_t>(v);
  }
  return ring;
}

// Whether half of the points lie far from the peak of their group, so that the groups are no rings.
bool is_broad(const Profile& profile, const std::vector<std::uint32_t>& histogram,
              const std::vector<std::uint32_t>& ring) {
  std::uint64_t far = 0;
  std::uint64_t all = 0;
  for (std::size_t b = 0; b < kBins; ++b) {
    const std::size_t peak = profile.peaks[ring[b]];
    far += (b > peak ? b - peak : peak - b) > kBroadBins ? histogram[b] : 0U;
    all += histogram[b];
  }
  return 2 * far > all;
}

// Equal bands in place of rings, those without points left out.
std::vector<std::uint32_t> bands_of(const std::vector<std::uint32_t>& histogram) {
  std::vector<std::uint32_t> ring(kBins, 0);
  std::uint32_t next = 0;
  for (std::size_t from = 0; from < kBins; from += kBandBins) {
    const std::size_t to = std::min(from + kBandBins, kBins);
    bool used = false;
    for (std::size_t b = from; b < to; ++b) {
      ring[b] = next;
      used = used || histogram[b] > 0;
    }
    if (used) ++next;
  }
  return ring;
}

}  // namespace

RingNumbers rings_by_elevation(const Scan& scan) {
  const std::vector<std::uint32_t> bins = bins_of(scan);
  const std::vector<std::uint32_t> histogram = histogram_of(bins);
  const Profile profile = profile_of(smoothed(histogram));
  std::vector<std::uint32_t> ring = rings_of(profile);
  RingNumbers rings;
  if (is_broad(profile, histogram, ring)) {
    ring = bands_of(histogram);
    rings.clear = false;
    rings.remark = "no rings can be told apart: bands of 0.4 degrees";
  } else if (!profile.valleys.empty()) {
    rings.clear = profile.blur < kBlurMax;
    rings.remark = fmt::format("{}: valleys hold {:.0f} % of peaks", rings.clear ? "clear" : "blurred",
                               100.0 * profile.blur);
  }
  ring.push_back(0);  // points of range 0
  rings.ring_of.resize(bins.size());
  for (std::size_t i = 0; i < bins.size(); ++i) rings.ring_of[i] = ring[bins[i]];
  rings.count = 1U + *std::max_element(ring.begin(), ring.end());
  return rings;
}

}  // namespace verge
