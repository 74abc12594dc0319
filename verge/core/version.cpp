// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/version.hpp"

namespace verge {

std::string_view version() { return VERGE_VERSION; }

}  // namespace verge
