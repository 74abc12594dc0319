// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "verge/core/error.hpp"
#include "verge/study/tally.hpp"

namespace verge::study {

/// A tally as text; read back it is the same, and the same text again.
[[nodiscard]] std::string to_json(const Tally& tally);
/// Fails with kUnusable where the text is none of to_json()'s.
[[nodiscard]] Expected<Tally> parse_tally(std::string_view text);

}  // namespace verge::study
