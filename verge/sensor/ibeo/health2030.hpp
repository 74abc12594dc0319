// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::sensor::ibeo {

/// Errors and warnings of a LUX or LD-MRS, as in a message of type 0x2030.
struct LuxHealth {
  std::uint16_t error_1 = 0;
  std::uint16_t error_2 = 0;
  std::uint16_t warning_1 = 0;
  std::uint16_t warning_2 = 0;
  std::array<std::uint16_t, 4> reserved{};

  friend bool operator==(const LuxHealth&, const LuxHealth&) = default;
};

/// The registers in the body of a message. Fails with kDamaged where its size is not 16.
[[nodiscard]] Expected<LuxHealth> decode_health(Bytes body, std::uint64_t at = 0);
[[nodiscard]] std::vector<std::byte> encode_health(const LuxHealth& health);

/// What the set bits mean, errors before warnings; bits without a meaning are left out. 0x0100 and 0x0200 of
/// error register 1 both say that the receiver is too warm or too cold: drivers disagree on which is which.
[[nodiscard]] std::vector<std::string_view> troubles_of(const LuxHealth& health);

}  // namespace verge::sensor::ibeo
