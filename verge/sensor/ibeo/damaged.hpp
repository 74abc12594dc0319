// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "verge/core/error.hpp"

namespace verge::sensor::ibeo {

/// The error of a message that cannot be used. `what` has no numbers in it, so that messages can be counted
/// by it.
inline Unexpected damaged(std::uint64_t at, std::string what, std::string got = {}, std::string need = {}) {
  return Unexpected(Error{
      ErrorCode::kDamaged, {}, fmt::format("{}", at), std::move(what), std::move(got), std::move(need)});
}

}  // namespace verge::sensor::ibeo
