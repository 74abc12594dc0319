// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/faults/bad_inputs.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "verge/io/source.hpp"

// What the targets of formats with one scan a file share.

namespace verge::fuzz {

/// The valid files with that suffix, and the bad ones.
[[nodiscard]] std::vector<std::string> files_with_suffix(const std::string& suffix,
                                                         const std::vector<faults::BadInput>& bad);

/// Decodes the input as that format, twice: the same comes out, points are finite, and every one is accounted
/// for.
void check_file(Bytes input, io::Format format);

}  // namespace verge::fuzz
