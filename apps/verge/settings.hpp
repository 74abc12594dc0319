// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/core/field_io.hpp"
#include "verge/scan/mount.hpp"

namespace verge::app {

/// Where settings come from: the defaults, then a configuration file, then --set, each over the one before.
struct SettingsRequest {
  std::optional<std::string> method;            ///< --method.
  std::optional<std::filesystem::path> config;  ///< --config FILE.toml.
  std::optional<std::filesystem::path> mount;   ///< --mount FILE.toml.
  std::vector<std::string> set;                 ///< --set SECTION.KEY=VALUE.
};

/// The settings of one run, checked.
class Settings {
 public:
  /// Fails with kUsage and the place (FILE:LINE:COL) of a key that is unknown or a value that does not fit.
  [[nodiscard]] static Expected<Settings> of(const SettingsRequest& request);

  [[nodiscard]] const std::string& method() const { return method_; }
  [[nodiscard]] const MountHint& mount_hint() const { return mount_hint_; }
  /// What was set in a section, in order.
  [[nodiscard]] std::vector<Setting> section(std::string_view name) const;

  /// Everything in effect as a TOML file that --config takes back.
  [[nodiscard]] std::string to_toml() const;
  /// 16 hexadecimal digits that change with everything that can change a result.
  [[nodiscard]] std::string hash() const;

 private:
  Settings() = default;
  [[nodiscard]] Expected<void> read_config(const std::filesystem::path& file);
  [[nodiscard]] Expected<void> apply(std::string_view assignment);

  std::string method_;
  MountHint mount_hint_;
  std::map<std::string, std::vector<Setting>, std::less<>> sections_;
};

/// The sections that a configuration file may have: one a method, mount_estimate and plot.
[[nodiscard]] std::vector<std::string_view> section_names();

/// The fields of a section with settings applied. Throws std::invalid_argument as set_field(), and where
/// there is no such section.
[[nodiscard]] std::vector<FieldRow> section_rows(std::string_view section,
                                                 const std::vector<Setting>& settings = {});

}  // namespace verge::app
