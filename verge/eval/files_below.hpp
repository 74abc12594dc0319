// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

#include "verge/core/error.hpp"

namespace verge::eval {

[[nodiscard]] Error cannot_open(const std::filesystem::path& path, const std::error_code& error);

/// All files in and below a folder, in order of their paths. Fails with kCannotOpen.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> files_below(const std::filesystem::path& folder);

}  // namespace verge::eval
