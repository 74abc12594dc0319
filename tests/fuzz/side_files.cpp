// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/side_files.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

namespace verge::fuzz {
namespace fs = std::filesystem;

SideFiles::SideFiles() {
  const fs::path memory = "/dev/shm";
  const bool in_memory = ::access(memory.c_str(), W_OK) == 0;
  folder_ =
      (in_memory ? memory : fs::temp_directory_path()) / ("verge-side-files-" + std::to_string(::getpid()));
  fs::create_directories(folder_);
}

SideFiles::~SideFiles() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void SideFiles::write(std::string_view below, std::string_view bytes) const {
  const fs::path file = folder_ / below;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace verge::fuzz
