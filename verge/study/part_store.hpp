// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "verge/core/error.hpp"
#include "verge/study/tally.hpp"

namespace verge::study {

/// What a part is: its name for people, and everything that its result depends on.
struct PartKey {
  std::string name;
  std::string settings;

  /// The name in letters, digits and dashes, then 16 digits that change with the settings.
  [[nodiscard]] std::string file_name() const;
};

/// Parts that are done, as files of a folder; or nowhere.
class PartStore {
 public:
  PartStore() = default;
  /// Makes the folder. Fails with kCannotWrite.
  [[nodiscard]] static Expected<PartStore> open(const std::filesystem::path& folder);

  /// None where it is not kept, or what is kept is damaged; then `warning` hears so in a line.
  [[nodiscard]] std::optional<Tally> find(const PartKey& key,
                                          const std::function<void(const std::string&)>& warning) const;
  /// The file appears whole or not at all. Fails with kCannotWrite.
  [[nodiscard]] Expected<void> keep(const PartKey& key, const Tally& tally) const;

 private:
  std::optional<std::filesystem::path> folder_;
};

}  // namespace verge::study
