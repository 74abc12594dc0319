// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/number_range.hpp"

#include <string>

#include <fmt/core.h>

namespace verge::app {

CLI::Validator finite_range(double least, double greatest) {
  const std::string range = fmt::format("{:g} to {:g}", least, greatest);
  const auto refuse = [=](const std::string& text) {
    double value = 0.0;
    const bool passes = CLI::detail::lexical_cast(text, value) && value >= least && value <= greatest;
    return passes ? std::string() : fmt::format("'{}' is not a number from {}", text, range);
  };
  return {refuse, range};
}

}  // namespace verge::app
