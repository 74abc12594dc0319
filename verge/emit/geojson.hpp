// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "verge/core/atomic_file.hpp"
#include "verge/core/error.hpp"
#include "verge/core/pose.hpp"
#include "verge/emit/geo.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// Scenes as one GeoJSON FeatureCollection (RFC 7946), a feature a part and a line of text a feature, with
/// the JSON line's keys as properties, "part" (boundary, opening, corner, junction, object, road), and
/// stamp_ns a second time as text (stamp_ns_text), since many readers hold numbers only up to 2^53. Health
/// and the road's widths stand in the JSON lines alone.
///
/// Frame: with an origin, WGS 84 as [longitude, latitude] to 1e-9 degrees; else metres to 0.1 mm as [x, y], x
/// forward and y left, which the collection's member "coordinate_frame" says ("crs" is no longer allowed).
/// Where the first scan has a pose, its sensor frame at that pose is the local frame (the origin's, where
/// there is one), and later scans are moved into it by their poses; a later scan without a pose has no place,
/// and its features have the geometry null. Where the first scan has none, every scan stands at the origin.
///
/// Geometry: LineString of a boundary (Point for one point; null for none) and across an opening, Point of a
/// corner and a junction's center, Polygon of an object's footprint and of the road. A line across the
/// antimeridian is cut into a MultiLineString there; of a polygon across it the outline is given so. Memory
/// does not grow with the number of scenes. Errors and when the bytes appear: as SceneWriter.
class GeoJsonWriter {
 public:
  /// Throws std::invalid_argument where the origin is outside its ranges.
  [[nodiscard]] static Expected<GeoJsonWriter> open(const std::filesystem::path& target,
                                                    const std::optional<GeoOrigin>& origin = {});

  [[nodiscard]] Expected<void> write(const Scene& scene, const std::optional<Pose>& T_world_sensor = {});

  /// Call once, after the last scene. Valid JSON even without any.
  [[nodiscard]] Expected<void> finish();

 private:
  GeoJsonWriter(AtomicFile file, const std::optional<GeoOrigin>& origin);
  [[nodiscard]] Expected<void> put(const std::string& text);
  [[nodiscard]] std::optional<Pose> place(const std::optional<Pose>& T_world_sensor) const;

  AtomicFile file_;
  std::optional<GeoOrigin> origin_;
  std::optional<Pose> T_local_world_;  ///< Of the first scan; none where it had no pose.
  bool begun_ = false;
  bool has_feature_ = false;
};

}  // namespace verge::emit
