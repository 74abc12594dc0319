// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace verge {

/// The release that this library is, as "0.1.0".
[[nodiscard]] std::string_view version();

}  // namespace verge
