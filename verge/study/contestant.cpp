// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/contestant.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace verge::study {
namespace {

Setting setting_of(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw std::invalid_argument(fmt::format("'{}' is not KEY=VALUE, as in gradient:reading=paper", text));
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

bool has_printed_reading(const detect::Method& method) {
  for (const FieldRow& row : method.fields({})) {
    if (row.info.name == "reading")
      return std::ranges::find(row.choices, std::string_view("paper")) != row.choices.end();
  }
  return false;
}

}  // namespace

Contestant contestant_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  const detect::Method& method = detect::method_named(text.substr(0, colon));
  Contestant contestant{std::string(text), std::string(method.name), {}, method.says};
  std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    contestant.settings.push_back(setting_of(rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  (void)method.make(contestant.settings);  // what does not fit throws now, not after an hour
  return contestant;
}

std::vector<Contestant> usual_contestants() {
  std::vector<Contestant> contestants;
  for (const detect::Method& method : detect::methods()) {
    contestants.push_back(contestant_of(method.name));
    if (has_printed_reading(method))
      contestants.push_back(contestant_of(fmt::format("{}:reading=paper", method.name)));
  }
  return contestants;
}

Contestant contestant_of(std::string name, Predictions predictions) {
  detect::Says says;
  for (const auto& [frame, scene] : predictions) {
    says.corners = says.corners || !scene.corners.empty();
    says.objects = says.objects || !scene.objects.empty();
  }
  return {std::move(name), {}, {}, says, std::make_shared<const Predictions>(std::move(predictions))};
}

std::string settings_text(const Contestant& contestant) {
  assert(!contestant.predictions);
  return plain_dump(contestant.method, detect::method_named(contestant.method).fields(contestant.settings));
}

std::unique_ptr<detect::Detector> detector_of(const Contestant& contestant) {
  return detect::make(contestant.method, contestant.settings);
}

}  // namespace verge::study
