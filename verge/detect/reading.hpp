// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "verge/core/fields.hpp"

namespace verge::detect {

/// How a paper's text is taken where it is misprinted, ambiguous or silent.
enum class Reading : std::uint8_t {
  kFixed,  ///< Misprints put right and gaps filled; docs/methods.md lists each.
  kPaper,  ///< As printed, where that can run.
};

}  // namespace verge::detect

namespace verge {
template <>
inline constexpr std::array enum_names<detect::Reading> = std::to_array<std::string_view>({"fixed", "paper"});
}  // namespace verge
