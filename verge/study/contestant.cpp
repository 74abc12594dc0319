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

bool says_any(const detect::Says& says, const Judged& judged) {
  return (says.boundaries && judged.boundaries) || (says.corners && judged.corners) ||
         (says.objects && judged.objects);
}

/// All but the usual one, which every method's own name stands for.
std::vector<std::string> other_readings(const detect::Method& method) {
  std::vector<std::string> others;
  for (const FieldRow& row : method.fields({})) {
    if (row.info.name != "reading") continue;
    for (const std::string_view choice : row.choices) {
      if (choice != row.value) others.emplace_back(choice);
    }
  }
  return others;
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

std::vector<Contestant> usual_contestants(const Judged& judged) {
  std::vector<Contestant> contestants;
  for (const detect::Method& method : detect::methods()) {
    if (!says_any(method.says, judged)) continue;
    contestants.push_back(contestant_of(method.name));
    for (const std::string& reading : other_readings(method))
      contestants.push_back(contestant_of(fmt::format("{}:reading={}", method.name, reading)));
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
