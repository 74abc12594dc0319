// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/detect/registry.hpp"

#include <set>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

namespace verge::detect {
namespace {

TEST(Registry, every_method_says_what_it_is_and_is_made_in_the_order_it_declares) {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name << " stands twice";
    EXPECT_FALSE(method.summary.empty());
    EXPECT_FALSE(method.citation.empty());
    EXPECT_EQ(make(method.name)->order(), method.order);
  }
  EXPECT_THAT(names, testing::Contains("gradient"));
}

TEST(Registry, every_field_has_a_meaning_a_source_and_a_default_within_its_range) {
  for (const Method& method : methods()) {
    std::set<std::string_view> keys;
    for (const FieldRow& row : method.fields({})) {
      EXPECT_TRUE(keys.insert(row.info.name).second) << row.info.name << " stands twice";
      EXPECT_FALSE(row.info.meaning.empty()) << row.info.name;
      EXPECT_FALSE(row.info.source.empty()) << row.info.name;
      const std::vector<Setting> same{{std::string(row.info.name), row.value}};
      EXPECT_NO_THROW((void)method.make(same)) << row.info.name;
    }
  }
}

TEST(Registry, an_override_shows_in_the_fields) {
  const std::vector<Setting> overrides{{"height_max_m", "0.4"}};
  for (const FieldRow& row : method_named("gradient").fields(overrides)) {
    if (row.info.name == "height_max_m") {
      EXPECT_EQ(row.value, "0.4");
    }
  }
}

std::string refusal(std::string_view method, const std::vector<Setting>& overrides) {
  try {
    (void)make(method, overrides);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Registry, what_does_not_fit_is_refused_with_advice) {
  EXPECT_THAT(refusal("gradeint", {}), testing::HasSubstr("did you mean 'gradient'?"));
  EXPECT_THAT(refusal("x", {}), testing::HasSubstr("verge methods"));
  EXPECT_THAT(refusal("gradient", {{"heigth_max_m", "0.4"}}),
              testing::HasSubstr("did you mean 'height_max_m'?"));
  EXPECT_THAT(refusal("gradient", {{"height_max_m", "50"}}), testing::HasSubstr("need 0.05 to "));
}

}  // namespace
}  // namespace verge::detect
