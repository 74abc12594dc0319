// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/file_format.hpp"

namespace verge::fuzz {

std::vector<std::string> seeds() { return files_with_suffix(".csv", faults::bad_inputs_csv()); }

void check(Bytes input) { check_file(input, io::Format::kCsv); }

}  // namespace verge::fuzz
