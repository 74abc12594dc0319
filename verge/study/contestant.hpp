// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "verge/core/field_io.hpp"
#include "verge/detect/registry.hpp"
#include "verge/model/scene.hpp"
#include "verge/study/suite.hpp"

namespace verge::study {

/// What a program found, by frame (eval::frame_stem).
using Predictions = std::map<std::string, Scene, std::less<>>;

/// Who is judged: a method with its settings, or the predictions of any program.
struct Contestant {
  std::string name;
  std::string method;
  std::vector<Setting> settings{};
  detect::Says says{};
  std::shared_ptr<const Predictions> predictions{};  ///< Where they stand, there is no method.
};

/// From METHOD or METHOD:KEY=VALUE,KEY=VALUE, which is also its name. Throws std::invalid_argument where the
/// method does not exist or does not take these settings.
[[nodiscard]] Contestant contestant_of(std::string_view text);

/// Every registered method that says what is judged, and after each its other readings where it has some
/// (reading=paper).
[[nodiscard]] std::vector<Contestant> usual_contestants(const Judged& judged);

/// A program by its predictions. It says corners, or objects, where any of them does.
[[nodiscard]] Contestant contestant_of(std::string name, Predictions predictions);

/// Everything that can change what a method finds, as text.
[[nodiscard]] std::string settings_text(const Contestant& contestant);

/// A detector of its own for each who asks. Only of a method.
[[nodiscard]] std::unique_ptr<detect::Detector> detector_of(const Contestant& contestant);

}  // namespace verge::study
