// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "verge/core/error.hpp"
#include "verge/scan/mount.hpp"

namespace verge::app {

/// What a mount file says: a TOML file with any of height_m, pitch_deg, roll_deg, forward_deg (signs as in
/// Mount). Fails with kUsage and the place of an unknown key or a value out of range.
[[nodiscard]] Expected<MountHint> read_mount(const std::filesystem::path& file);

/// "height 1.84 m, pitch 0.3 deg, roll -0.2 deg, forward 1.2 deg".
[[nodiscard]] std::string to_text(const Mount& mount);

}  // namespace verge::app
