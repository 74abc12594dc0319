// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/settings.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "apps/verge/mount_file.hpp"
#include "apps/verge/toml_file.hpp"
#include "verge/core/hash.hpp"
#include "verge/detect/registry.hpp"
#include "verge/emit/bev_plot.hpp"

namespace verge::app {
namespace {

constexpr std::string_view kMountSection = "mount_estimate";
constexpr std::string_view kPlotSection = "plot";

Error usage_error(std::string file, std::string where, std::string what) {
  return {ErrorCode::kUsage, std::move(file), std::move(where), std::move(what), {}, {}};
}

/// Why the section does not take these settings; none if it does.
std::optional<std::string> objection(std::string_view section, const std::vector<Setting>& settings) {
  try {
    (void)section_rows(section, settings);
    return std::nullopt;
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

std::optional<std::string> kind_objection(const TomlEntry& entry) {
  for (const FieldRow& row : section_rows(entry.section)) {
    if (row.info.name == entry.key) return kind_misfit(entry, row);
  }
  return std::nullopt;
}

/// What is wrong with a key of a configuration file, and where.
std::optional<Error> fault_of(const TomlEntry& entry, const std::string& file) {
  if (auto unknown = objection(entry.section, {})) return usage_error(file, entry.key_where, *unknown);
  if (entry.key.empty()) return std::nullopt;
  if (auto kind = kind_objection(entry)) return usage_error(file, entry.value_where, *kind);
  auto refused = objection(entry.section, {{entry.key, entry.value}});
  if (!refused) return std::nullopt;
  const bool known_key = refused->starts_with(entry.key + ":");
  return usage_error(file, known_key ? entry.value_where : entry.key_where, *refused);
}

/// What was estimated and what was given both change results.
std::string plain_dump_of(const MountHint& hint) {
  const auto text = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string("estimated");
  };
  return fmt::format("mount = {} {} {} {}\n", text(hint.height_m), text(hint.pitch_rad), text(hint.roll_rad),
                     text(hint.forward_rad));
}

}  // namespace

std::vector<std::string_view> section_names() {
  std::vector<std::string_view> names;
  for (const detect::Method& method : detect::methods()) names.push_back(method.name);
  names.push_back(kMountSection);
  names.push_back(kPlotSection);
  return names;
}

std::vector<FieldRow> section_rows(std::string_view section, const std::vector<Setting>& settings) {
  if (section == kMountSection) return field_rows(config_of<MountConfig>(settings));
  if (section == kPlotSection) return field_rows(config_of<emit::BevPlot::Config>(settings));
  for (const detect::Method& method : detect::methods()) {
    if (method.name == section) return method.fields(settings);
  }
  const auto names = section_names();
  const std::string_view near = nearest_word(section, names);
  throw std::invalid_argument(
      near.empty() ? fmt::format("unknown section '{}' (known: {})", section, fmt::join(names, ", "))
                   : fmt::format("unknown section '{}' (did you mean '{}'?)", section, near));
}

std::vector<Setting> Settings::section(std::string_view name) const {
  const auto found = sections_.find(name);
  return found == sections_.end() ? std::vector<Setting>{} : found->second;
}

Expected<void> Settings::read_config(const std::filesystem::path& file) {
  const auto entries = read_toml(file);
  if (!entries) return Unexpected(entries.error());
  for (const TomlEntry& entry : *entries) {
    if (entry.section.empty() && entry.key == "method" && entry.kind == TomlKind::kText) {
      method_ = entry.value;
      continue;
    }
    if (entry.section.empty()) {
      return Unexpected(usage_error(file.string(), entry.key_where,
                                    fmt::format("unknown key '{}' (known here: method, and the sections {})",
                                                entry.key, fmt::join(section_names(), ", "))));
    }
    if (auto fault = fault_of(entry, file.string())) return Unexpected(*std::move(fault));
    if (!entry.key.empty()) sections_[entry.section].push_back({entry.key, entry.value});
  }
  return {};
}

Expected<void> Settings::apply(std::string_view assignment) {
  const std::string place = fmt::format("--set {}", assignment);
  const std::size_t equals = assignment.find('=');
  const std::size_t dot = assignment.substr(0, equals).find('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos) {
    return Unexpected(usage_error(place, {}, "is not SECTION.KEY=VALUE, as in gradient.height_max_m=0.4"));
  }
  const std::string section(assignment.substr(0, dot));
  const Setting setting{std::string(assignment.substr(dot + 1, equals - dot - 1)),
                        std::string(assignment.substr(equals + 1))};
  if (auto refused = objection(section, {setting})) return Unexpected(usage_error(place, {}, *refused));
  sections_[section].push_back(setting);
  return {};
}

Expected<Settings> Settings::of(const SettingsRequest& request) {
  Settings settings;
  settings.method_ = detect::methods().front().name;
  if (request.config) {
    if (auto read = settings.read_config(*request.config); !read) return Unexpected(read.error());
  }
  if (request.method) settings.method_ = *request.method;
  for (const std::string& assignment : request.set) {
    if (auto applied = settings.apply(assignment); !applied) return Unexpected(applied.error());
  }
  if (request.mount) {
    auto hint = read_mount(*request.mount);
    if (!hint) return Unexpected(hint.error());
    settings.mount_hint_ = *hint;
  }
  try {
    (void)detect::method_named(settings.method_);
  } catch (const std::invalid_argument& error) {
    return Unexpected(usage_error("--method", {}, error.what()));
  }
  return settings;
}

std::string Settings::to_toml() const {
  std::string text = fmt::format(
      "# verge's settings in effect; give them back with --config FILE.toml\n\nmethod = \"{}\"\n\n", method_);
  text += verge::to_toml(method_, section_rows(method_, section(method_)));
  for (const std::string_view name : section_names()) {
    const bool is_method =
        std::ranges::any_of(detect::methods(), [&](const auto& m) { return m.name == name; });
    if (!is_method) text += verge::to_toml(name, section_rows(name, section(name)));
  }
  return text;
}

std::string Settings::hash() const {
  const std::string text = plain_dump(method_, section_rows(method_, section(method_))) +
                           plain_dump(kMountSection, section_rows(kMountSection, section(kMountSection))) +
                           plain_dump_of(mount_hint_);
  return fmt::format("{:016x}", fnv1a(text));
}

}  // namespace verge::app
