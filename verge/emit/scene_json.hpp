// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "verge/core/error.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// The scene as one line of JSON, without the newline: {"schema": 1, "frame": ..., "boundaries": [...], ...}.
///
/// The bytes depend on the scene alone: keys always in the same order; coordinates and heights rounded to
/// 0.1 mm, confidence, completeness and angles to 1e-4, ties away from zero, -0 written as 0. `stamp_ns` is
/// null where unknown. Left out are: openings, corners, junctions, objects, road and health where there are
/// none, height_m and state where a boundary has none, what a corner or object does not know, and an empty
/// method, version or config_hash. Bytes of a name that are not UTF-8 become U+FFFD.
/// A number that is not finite is the caller's bug (assert).
[[nodiscard]] std::string to_json_line(const Scene& scene);

/// A scene from a line of JSON: to_json_line's own, or another program's. Needed are only "frame" (text, or a
/// whole number) and either "boundaries", each with its "points" as [x, y] or [x, y, z, ...], or bare
/// "points" that belong to no line: each of those becomes a boundary of one point. "points" wins where both
/// are there. Absent or null are: z and the rest as in a default Boundary, confidence 1. The other parts of a
/// Scene may be missing; an opening needs its ends, a corner its position, a junction its center, an object
/// its center and size. Unknown keys are skipped; of a key that stands twice the last counts.
///
/// Fails with kUnusable, and `where` = "LINE:COLUMN" with the column in bytes, counted from 1: where the bad
/// value begins, or the last byte read where the text is not JSON. Also bad: a schema other than 1, an
/// unknown spelling, a confidence outside 0..1, a negative size, heights or states not as many as the points.
[[nodiscard]] Expected<Scene> parse_scene(std::string_view line, std::size_t line_number = 1);

}  // namespace verge::emit
