// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "verge/core/log.hpp"
#include "verge/io/file/decoded.hpp"
#include "verge/io/input.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// LAS 1.0 to 1.4 (ASPRS), point formats 0 to 10, not compressed, as one scan. x, y, z are taken as they are,
/// metres: LAS files have world coordinates in some projection, which is not read.
///
/// Where the first point is farther than 10 km from 0 in any axis, an origin (the first point, rounded to
/// whole metres) is taken off all coordinates in double precision, since a Cloud has floats; it is the
/// translation of T_world_sensor, and a note says it. Intensity as stored (0..65535), return number less 1 as
/// echo, classification as label, GPS time where the format has one (absolute where the header says so, with
/// a stamp; else relative). The user data are the ring in files that write_las() made, and in no others: no
/// other writer is known to do so. Points marked as withheld are left out and counted in a note; colours
/// are not read, which a note says, nor are waveforms and extra bytes. In LAS 1.0 the whole byte of the class
/// is the label, and nothing marks a point as withheld.
///
/// Fails with kUnusable (no LAS, compressed, a version or format that is not known, sizes that do not fit the
/// file), kDamaged (0 points), kLimit.
[[nodiscard]] Expected<Decoded> read_las(Input& input);

/// The scan as LAS 1.4, point format 6, ring by ring, atomically; the same bytes for the same scan (the date
/// of creation is left 0). Coordinates in the sensor's frame in steps of 0.1 mm, ring in the user data, label
/// as classification, echo as return number, time (where the scan has any) as adjusted standard GPS time with
/// a stamp and as seconds from the first point without.
///
/// LAS has 16 bits of intensity: intensities up to 1 are multiplied by 65535, up to 255 by 257, up to 65535
/// by 1; what is beyond or below is held at the ends. What the format has no room for is told to `log`:
/// labels above 255 become class 0, echoes above 14 return 15, and pulse widths and flags are left out. Fails
/// with kUsage where the scan has more than 256 rings or 2^31 steps of coordinates do not reach (214 km), and
/// with kCannotWrite.
[[nodiscard]] Expected<void> write_las(const std::filesystem::path& path, const Scan& scan,
                                       const Log& log = {});

}  // namespace verge::io
