// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/registry.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

#include "verge/detect/gradient/gradient.hpp"
#include "verge/detect/lda/lda.hpp"
#include "verge/detect/line_fit/line_fit.hpp"
#include "verge/detect/road_width/road_width.hpp"

namespace verge::detect {
namespace {

template <class Type>
std::vector<FieldRow> fields_of(std::span<const Setting> overrides) {
  return field_rows(config_of<typename Type::Config>(overrides));
}

template <class Type>
std::unique_ptr<Detector> make_of(std::span<const Setting> overrides) {
  return std::make_unique<Type>(config_of<typename Type::Config>(overrides));
}

template <class Type>
constexpr Method entry(std::string_view name, Order order, std::string_view summary,
                       std::string_view citation, Says says = {}) {
  return {name, summary, citation, order, says, &fields_of<Type>, &make_of<Type>};
}

/// One line a method: this is all that a new one adds here.
constexpr std::array kMethods{
    entry<Gradient>(
        "gradient", Order::kIndependent,
        "steps by gradient along the rings in four quadrants, k-means, and a line or B-spline a side",
        "Zhong et al., Road boundary detection algorithm based on multi-line 3D laser radar, "
        "IJEART 3(8), 2017"),
    entry<Lda>(
        "lda", Order::kIndependent,
        "paper 3's baseline, reconstructed: a linear discriminant of windows along the rings, and a line "
        "or quadratic a side",
        "Liu, Tang, Ren, J. Huazhong Univ. of Sci. and Tech. (Nat. Sci.), 2011, as Zhong et al. 2017 "
        "name it (the text is not to be found)"),
    entry<LineFit>(
        "line_fit", Order::kIndependent,
        "road edges and objects on four layers: kerbs, Hough lines, least squares, Theil-Sen, k-means",
        "Duan, Valentyna, Road edge detection based on lidar laser, ICCAIS 2015",
        Says{.boundaries = true, .corners = false, .objects = true}),
    entry<RoadWidth>("road_width", Order::kSequential,
                     "the road's width on four lines from scan to scan, and corners where it widens",
                     "Liu, Feng, Li, Zhang, Corner detection for intelligent vehicles based on a four-layer "
                     "radar",
                     Says{.boundaries = false, .corners = true}),
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method& method_named(std::string_view name) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(),
                                  [&](const Method& method) { return method.name == name; });
  if (found != kMethods.end()) return *found;
  std::vector<std::string_view> names;
  for (const Method& method : kMethods) names.push_back(method.name);
  const std::string_view near = nearest_word(name, names);
  throw std::invalid_argument(near.empty()
                                  ? fmt::format("unknown method '{}' (see: verge methods)", name)
                                  : fmt::format("unknown method '{}' (did you mean '{}'?)", name, near));
}

std::unique_ptr<Detector> make(std::string_view name, const std::vector<Setting>& overrides) {
  return method_named(name).make(overrides);
}

}  // namespace verge::detect
