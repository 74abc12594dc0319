// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/file_format.hpp"

namespace verge::fuzz {

std::vector<std::string> seeds() { return files_with_suffix(".bin", faults::bad_inputs_bin()); }

void check(Bytes input) { check_file(input, io::Format::kKitti); }

}  // namespace verge::fuzz
