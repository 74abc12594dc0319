// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/field_io.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace verge {

enum class Shade : std::uint8_t { kLight, kDark };
template <>
inline constexpr std::array enum_names<Shade> = std::to_array<std::string_view>({"light", "dark"});

namespace {

struct Config {
  double height_max_m = 0.5;
  std::int64_t count = 3;
  bool strict = false;
  Shade shade = Shade::kDark;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(self.height_max_m, {"height_max_m", "m", 0.0, 5.0, "higher points are dropped", "ours"});
    visit(self.count, {"count", "1", 1, 10, "how many", "table 2"});
    visit(self.strict, {"strict", "", 0, 0, "whether to be strict", "ours"});
    visit(self.shade, {"shade", "", 0, 0, "how dark", "ours"});
  }
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEST(FieldIo, every_type_is_set_from_text) {
  const std::vector<Setting> settings{
      {"height_max_m", "0.25"}, {"count", "+7"}, {"strict", "true"}, {"shade", "light"}};
  const auto config = config_of<Config>(settings);
  EXPECT_EQ(config.height_max_m, 0.25);
  EXPECT_EQ(config.count, 7);
  EXPECT_TRUE(config.strict);
  EXPECT_EQ(config.shade, Shade::kLight);
}

TEST(FieldIo, text_that_does_not_fit_names_key_and_range_and_changes_nothing) {
  Config config;
  const auto set = [&config](std::string_view key, std::string_view text) {
    return message_of([&] { set_field(config, key, text); });
  };
  EXPECT_EQ(set("height_max_m", "5.01"), "height_max_m: '5.01' does not fit (need 0 to 5 m)");
  EXPECT_EQ(set("shade", "red"), "shade: 'red' does not fit (need light or dark)");
  EXPECT_EQ(set("strict", "yes"), "strict: 'yes' does not fit (need true or false)");
  for (const auto* text : {"", "nan", "inf", "-0.1", "0,4", "0.4 ", "0.4m", "0x1"}) {
    EXPECT_THAT(set("height_max_m", text), testing::HasSubstr("height_max_m")) << text;
  }
  for (const auto* text : {"0", "11", "2.5", "99999999999999999999"}) {
    EXPECT_THAT(set("count", text), testing::HasSubstr("1 to 10")) << text;
  }
  EXPECT_EQ(plain_dump("c", field_rows(config)), plain_dump("c", field_rows(Config{})));
}

TEST(FieldIo, unknown_key_suggests_the_nearest_or_lists_them_all) {
  Config config;
  EXPECT_EQ(message_of([&] { set_field(config, "heigth_max_m", "1"); }),
            "unknown key 'heigth_max_m' (did you mean 'height_max_m'?)");
  EXPECT_EQ(message_of([&] { set_field(config, "zzzzzzzz", "1"); }),
            "unknown key 'zzzzzzzz' (known: height_max_m, count, strict, shade)");
}

TEST(FieldIo, check_fields_finds_a_value_that_the_program_put_out_of_range) {
  EXPECT_NO_THROW(check_fields(Config{}));
  Config high;
  high.height_max_m = 6.0;
  EXPECT_THROW(check_fields(high), std::invalid_argument);
  Config nan;
  nan.height_max_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_fields(nan), std::invalid_argument);
  Config shade;
  shade.shade = static_cast<Shade>(7);
  EXPECT_THROW(check_fields(shade), std::invalid_argument);
}

RC_GTEST_PROP(FieldIo, any_value_reads_back_exactly_from_its_row, (double share, bool strict)) {
  RC_PRE(std::isfinite(share));
  Config config;
  config.height_max_m = 5.0 * std::abs(std::sin(share));
  config.count = *rc::gen::inRange<std::int64_t>(1, 11);
  config.strict = strict;
  Config again;
  for (const FieldRow& row : field_rows(config)) set_field(again, row.info.name, row.value);
  RC_ASSERT(again.height_max_m == config.height_max_m);
  RC_ASSERT(again.count == config.count);
  RC_ASSERT(again.strict == config.strict);
}

TEST(FieldIo, toml_carries_meaning_unit_range_and_source) {
  const std::string toml = to_toml("demo", field_rows(Config{}));
  EXPECT_THAT(toml, testing::StartsWith("[demo]\n"
                                        "# higher points are dropped\n"
                                        "# unit m; range 0 to 5; source: ours\n"
                                        "height_max_m = 0.5\n"));
  EXPECT_THAT(toml, testing::HasSubstr("\nshade = \"dark\"\n"));
  EXPECT_THAT(toml, testing::HasSubstr("\nstrict = false\n"));
}

TEST(FieldIo, table_has_one_line_a_field_with_aligned_columns) {
  const std::string table = to_table(field_rows(Config{}));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_THAT(table, testing::HasSubstr("height_max_m  0.5      m     0 to 5         higher points"));
}

TEST(FieldIo, nearest_word_is_none_where_nothing_is_near) {
  constexpr std::array<std::string_view, 2> kWords{"gradient", "surface"};
  EXPECT_EQ(nearest_word("gradeint", kWords), "gradient");
  EXPECT_EQ(nearest_word("x", kWords), "");
}

}  // namespace
}  // namespace verge
