// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/mount_file.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/core.h>

#include "apps/verge/toml_file.hpp"
#include "verge/core/angle.hpp"
#include "verge/core/field_io.hpp"

namespace verge::app {
namespace {

struct Key {
  std::string_view name;
  double min;
  double max;
  std::optional<double> MountHint::*field;
  bool is_angle;
};

constexpr std::array kKeys{
    Key{"height_m", 0.05, 50.0, &MountHint::height_m, false},
    Key{"pitch_deg", -85.0, 85.0, &MountHint::pitch_rad, true},
    Key{"roll_deg", -85.0, 85.0, &MountHint::roll_rad, true},
    Key{"forward_deg", -180.0, 180.0, &MountHint::forward_rad, true},
};

const Key* key_named(std::string_view name) {
  for (const Key& key : kKeys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

std::string unknown_key(std::string_view name) {
  std::array<std::string_view, kKeys.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kKeys[i].name;
  const std::string_view near = nearest_word(name, names);
  if (!near.empty()) return fmt::format("unknown key '{}' (did you mean '{}'?)", name, near);
  return fmt::format("unknown key '{}' (known: height_m, pitch_deg, roll_deg, forward_deg)", name);
}

std::optional<double> number_of(const TomlEntry& entry) {
  if (entry.kind != TomlKind::kWhole && entry.kind != TomlKind::kNumber) return std::nullopt;
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(entry.value.data(), entry.value.data() + entry.value.size(), value);
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

}  // namespace

Expected<MountHint> read_mount(const std::filesystem::path& file) {
  const auto entries = read_toml(file);
  if (!entries) return Unexpected(entries.error());
  MountHint hint;
  for (const TomlEntry& entry : *entries) {
    const Key* key = entry.section.empty() ? key_named(entry.key) : nullptr;
    if (key == nullptr) {
      const std::string name = entry.section.empty() ? entry.key : entry.section;
      return Unexpected({ErrorCode::kUsage, file.string(), entry.key_where, unknown_key(name), {}, {}});
    }
    const auto value = number_of(entry);
    const bool fits = value && *value >= key->min && *value <= key->max;  // false for NaN
    if (!fits) {
      return Unexpected({ErrorCode::kUsage, file.string(), entry.value_where,
                         fmt::format("{} is out of range", key->name), entry.value,
                         fmt::format("{} to {}", key->min, key->max)});
    }
    hint.*(key->field) = key->is_angle ? deg_to_rad(*value) : *value;
  }
  return hint;
}

std::string to_text(const Mount& mount) {
  // -0.0 would look like a finding.
  const auto deg = [](double rad) { return std::round(rad_to_deg(rad) * 10.0) / 10.0 + 0.0; };
  return fmt::format("height {:.2f} m, pitch {:.1f} deg, roll {:.1f} deg, forward {:.1f} deg", mount.height_m,
                     deg(mount.pitch_rad), deg(mount.roll_rad), deg(mount.forward_rad));
}

}  // namespace verge::app
