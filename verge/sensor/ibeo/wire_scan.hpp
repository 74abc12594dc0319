// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "verge/scan/organise.hpp"
#include "verge/sensor/ibeo/alasca_xt.hpp"
#include "verge/sensor/ibeo/lux.hpp"

// The inverse of cloud_of(): points to what the sensor would have sent.

namespace verge::sensor::ibeo {

/// What became of the points of a cloud; the next two add up to the first.
struct EncodedPoints {
  std::uint64_t points = 0;
  std::uint64_t encoded = 0;
  /// Not near the cone of a layer or no such layer, range 0 or beyond the wire, an echo beyond 3, not finite.
  std::uint64_t not_on_wire = 0;
  std::uint64_t altered = 0;  ///< Of the encoded ones: a pulse width or flags that the wire cannot say.

  friend bool operator==(const EncodedPoints&, const EncodedPoints&) = default;
};

/// A scan of a LUX, and what became of the points.
struct WireLuxScan {
  LuxScan scan;
  EncodedPoints counts;
};

/// The scan that cloud_of() makes these points of, in their order: the layer whose cone is nearest (within
/// 0.4 degrees), the nearest tick and centimetre, echo, pulse width in centimetres, flags. Start and end
/// angle and time are the outermost points'; where the times go evenly with the angle, as in clouds that were
/// decoded, they are such that decoding gives every time back to the nanosecond. A cloud without times lasts
/// as long as the model's slowest rate says. Without a `stamp_ns` the scan starts `since_power_on_ns` after a
/// sensor was switched on that nobody has told the time; a stamp has to lie in 1970 to 2036.
[[nodiscard]] WireLuxScan scan_of(const Cloud& cloud, std::optional<std::int64_t> stamp_ns,
                                  const LuxModel& model, std::int64_t since_power_on_ns = 0);

/// A scan of an ALASCA XT, and what became of the points.
struct WireAlascaScan {
  AlascaScan scan;
  EncodedPoints counts;
};

/// The same for an ALASCA XT: coordinates to their codes, status = flags. Layers are the cloud's rings where
/// there are four of them, else the layers whose elevations are nearest to the rings', in their order. The
/// message has no times of points.
[[nodiscard]] WireAlascaScan scan_of(const Cloud& cloud, const AlascaModel& model);

}  // namespace verge::sensor::ibeo
