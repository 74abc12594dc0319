// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verge/io/input.hpp"
#include "verge/io/source.hpp"
#include "verge/scan/organise.hpp"

namespace verge::io {

/// A scan, and what was done to get it.
struct DecodedScan {
  Organised organised;
  Format format = Format::kKitti;
  std::vector<std::string> notes;  ///< Of the reader, one line each.
};

/// The one scan that the input holds. `forced`: the format is not guessed; `bin`: see sniff(). A coordinate
/// that is a denormal number counts as not finite: no sensor says it. Fails as sniff() and the format's
/// reader do, and with kDamaged where no point can be used.
[[nodiscard]] Expected<DecodedScan> decode_input(Input& input, std::optional<Format> forced,
                                                 std::optional<Format> bin = std::nullopt);

}  // namespace verge::io
