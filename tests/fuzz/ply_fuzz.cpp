// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "tests/fuzz/file_format.hpp"

namespace verge::fuzz {
namespace {

/// Vertices of unequal length: a list stands among their properties.
std::string with_lists() {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty list uchar char "
      "names\n"
      "property float y\nproperty float z\nend_header\n";
  const auto append = [&](float value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    file += bytes;
  };
  for (char n = 0; n < 3; ++n) {
    append(5.0F + static_cast<float>(n));
    file += n;
    file.append(static_cast<std::size_t>(n), 'a');
    append(1.0F);
    append(-1.5F);
  }
  return file;
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> all = files_with_suffix(".ply", faults::bad_inputs_ply());
  all.push_back(with_lists());
  return all;
}

void check(Bytes input) { check_file(input, io::Format::kPly); }

}  // namespace verge::fuzz
