// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/mount_file.hpp"
#include "apps/verge/settings.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/side_files.hpp"

namespace verge::fuzz {
namespace {

/// What can be read is written as a file that says the same.
void check_settings(const SideFiles& side) {
  app::SettingsRequest request;
  request.config = side.folder() / "fuzz.toml";
  const auto settings = app::Settings::of(request);
  if (!settings) {
    require(!settings.error().what.empty());
    return;
  }
  side.write("again.toml", settings->to_toml());
  request.config = side.folder() / "again.toml";
  const auto again = app::Settings::of(request);
  require(again.has_value() && again->to_toml() == settings->to_toml() && again->hash() == settings->hash());
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string all = app::Settings::of({})->to_toml();
  return {all,
          "method = \"gradient\"\n[gradient]\nheight_max_m = 0.5 # low\n",
          "height_m = 1.84\npitch_deg = -0.5\n",
          "[gradient]\nheight_max_m = nan\n",
          "[gradient]\nreading = \"paper\"\nunknown = 1\n",
          "a = [[[[[[{b = 1}]]]]]]\n",
          "[plot]\n= 1",
          ""};
}

void check(Bytes input) {
  static const SideFiles side;
  side.write("fuzz.toml", std::string_view(reinterpret_cast<const char*>(input.data()), input.size()));
  check_settings(side);
  const auto mount = app::read_mount(side.folder() / "fuzz.toml");
  require(mount.has_value() || !mount.error().what.empty());
}

}  // namespace verge::fuzz
