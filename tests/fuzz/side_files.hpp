// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

// A folder for targets whose parser opens its files itself.

namespace verge::fuzz {

/// A folder of this process, in memory where the system has such a place, that goes when the process ends.
class SideFiles {
 public:
  SideFiles();
  SideFiles(const SideFiles&) = delete;
  SideFiles& operator=(const SideFiles&) = delete;
  ~SideFiles();

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Writes the file anew, with the folders that it needs.
  void write(std::string_view below, std::string_view bytes) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace verge::fuzz
