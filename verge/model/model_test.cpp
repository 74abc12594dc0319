// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"

namespace verge {
namespace {

template <class Enum>
void expect_every_name_is_found() {
  for (const std::string_view name : enum_names<Enum>) {
    const auto value = value_named<Enum>(name);
    ASSERT_TRUE(value.has_value());
    EXPECT_EQ(name_of(*value), name);
  }
}

TEST(Names, EveryValueOfAnEnumIsFoundByItsName) {
  expect_every_name_is_found<BoundaryKind>();
  expect_every_name_is_found<CornerSide>();
  expect_every_name_is_found<JunctionType>();
  expect_every_name_is_found<ObjectClass>();
  expect_every_name_is_found<ObjectShape>();
  EXPECT_FALSE(value_named<BoundaryKind>("kerb").has_value());
}

TEST(Names, TheLastValueOfEachEnumHasTheLastName) {
  EXPECT_EQ(name_of(CornerSide::kBoth), enum_names<CornerSide>.back());
  EXPECT_EQ(name_of(JunctionType::kDeadEnd), enum_names<JunctionType>.back());
  EXPECT_EQ(name_of(ObjectClass::kUnknown), enum_names<ObjectClass>.back());
  EXPECT_EQ(name_of(ObjectShape::kL), enum_names<ObjectShape>.back());
}

TEST(Trace, LayersAreFoundByName) {
  Trace trace;
  trace.points.push_back({"candidates", {{1.0, 2.0, 0.0}}, {0}});
  trace.values.push_back({"K", {2.0}});
  ASSERT_NE(trace.find_points("candidates"), nullptr);
  EXPECT_EQ(trace.find_points("candidates")->points.front().y, 2.0);
  EXPECT_EQ(trace.find_values("K")->values.front(), 2.0);
  trace.rasters.push_back({"squares", 1, 2, {0.0F, 255.0F}, {"y", "m", 3.0, -0.1}, {"x", "m", 9.0, -0.1}});
  ASSERT_NE(trace.find_raster("squares"), nullptr);
  EXPECT_EQ(trace.find_raster("squares")->values.back(), 255.0F);
  EXPECT_EQ(trace.find_raster("none"), nullptr);
  EXPECT_EQ(trace.find_points("none"), nullptr);
  EXPECT_EQ(trace.find_line("none"), nullptr);
}

}  // namespace
}  // namespace verge
