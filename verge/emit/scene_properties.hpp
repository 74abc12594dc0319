// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "verge/model/scene.hpp"

namespace verge::emit {

/// Length in metres to 0.1 mm, angle in radians or share to 1e-4: what outputs write, so that their bytes do
/// not show the last bits of an arithmetic. Never -0. Not finite: assert. From 2e11 on the value as it is.
[[nodiscard]] double rounded(double value);

/// What a boundary is apart from its points: id, side, model, kind, confidence.
[[nodiscard]] nlohmann::ordered_json properties_of(const Boundary& boundary);

/// Likewise of what stands at a place of its own, without that place.
[[nodiscard]] nlohmann::ordered_json properties_of(const Opening& opening);
[[nodiscard]] nlohmann::ordered_json properties_of(const Corner& corner);
[[nodiscard]] nlohmann::ordered_json properties_of(const Junction& junction);
[[nodiscard]] nlohmann::ordered_json properties_of(const Object& object);

/// height_m and state, where the boundary has them.
void add_point_properties(nlohmann::ordered_json& properties, const Boundary& boundary);

/// method, version and config_hash, where they are known.
void add_origin(nlohmann::ordered_json& properties, const Scene& scene);

/// The text of a JSON value on one line. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& value);

}  // namespace verge::emit
