// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "verge/emit/record_reader.hpp"
#include "verge/model/scene.hpp"

namespace verge::emit {

/// Reads a record's openings, corners, junctions, objects and road, those that are there, into the scene.
void read_parts(RecordReader& reader, const nlohmann::json& record, const Place& root, Scene& scene);

}  // namespace verge::emit
