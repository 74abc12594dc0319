// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"

namespace verge {
namespace {

TEST(Names, EveryValueOfAnEnumIsFoundByItsName) {
  for (const std::string_view name : enum_names<BoundaryKind>) {
    const auto value = value_named<BoundaryKind>(name);
    ASSERT_TRUE(value.has_value());
    EXPECT_EQ(name_of(*value), name);
  }
  EXPECT_FALSE(value_named<BoundaryKind>("kerb").has_value());
}

TEST(Trace, LayersAreFoundByName) {
  Trace trace;
  trace.points.push_back({"candidates", {{1.0, 2.0, 0.0}}, {0}});
  trace.values.push_back({"K", {2.0}});
  ASSERT_NE(trace.find_points("candidates"), nullptr);
  EXPECT_EQ(trace.find_points("candidates")->points.front().y, 2.0);
  EXPECT_EQ(trace.find_values("K")->values.front(), 2.0);
  EXPECT_EQ(trace.find_points("none"), nullptr);
  EXPECT_EQ(trace.find_line("none"), nullptr);
}

}  // namespace
}  // namespace verge
