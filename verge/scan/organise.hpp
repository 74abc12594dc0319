// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/fields.hpp"
#include "verge/scan/scan.hpp"

namespace verge {

/// A cloud as a file stores it: points in the file's order, already in x forward, y left, z up. Optional
/// columns are empty.
struct Cloud {
  std::vector<float> x{}, y{}, z{};
  std::vector<float> intensity{};
  std::vector<std::int64_t> ring{};  ///< As the source numbers its rings: any integers, in any order.
  std::vector<double> time_s{};      ///< Seconds; since the Unix epoch where beyond 1e8, else relative.
  std::vector<std::uint8_t> echo{};
  std::vector<float> pulse_width{};
  std::vector<std::uint32_t> flags{};
  std::vector<std::uint32_t> label{};
};

/// Where the rings of a scan came from.
enum class RingSource : std::uint8_t {
  kField,       ///< A ring, channel, line or row field.
  kKittiOrder,  ///< Points stand ring by ring, each turning once (KITTI): a ring ends where the azimuth
                ///< wraps.
  kElevation,   ///< Groups of equal elevation.
};
template <>
inline constexpr std::array enum_names<RingSource> =
    std::to_array<std::string_view>({"ring field", "order of the points", "elevation"});

/// Scan and one line on what was done.
struct Organised {
  Scan scan;
  RingSource source = RingSource::kField;
  std::string note;  ///< For example "64 rings from the order of the points, 12 of 121004 points dropped (not
                     ///< finite)".
};

/// Puts a cloud in rings: by its ring field if it has one, else by the order of the points where they stand
/// ring by ring, else by elevation. Every column must be empty or as long as x.
///
/// Rings are ordered by median elevation, whatever the field's numbers; a ring without returns stays beside
/// its neighbour by number. Points that are not finite or lie beyond 1e5 m are dropped and counted; points of
/// range 0 stay. Equal azimuths go by z, x, y, intensity and the other columns, and only then by the input's
/// order, so that where rings are known (or found by elevation) nothing but input_index depends on the
/// input's order. stamp_ns and time_offset_ns come from time_s, counted from the earliest point; times that
/// are not finite or more than 4.29 s apart are left out, and the note says so. Defined for every cloud; an
/// empty one has no rings.
[[nodiscard]] Organised organise(Cloud cloud);

/// The ring of each point.
[[nodiscard]] std::vector<std::uint32_t> ring_of_points(const Scan& scan);

/// Indices of the scan's points in the order of the input; a scan without input_index keeps its own order.
[[nodiscard]] std::vector<std::uint32_t> input_order(const Scan& scan);

/// The points back in the input's order, bit for bit (dropped ones are missing), with the scan's own ring
/// numbers; times to the nanosecond. A scan without input_index keeps its own order.
[[nodiscard]] Cloud flatten(const Scan& scan);

}  // namespace verge
