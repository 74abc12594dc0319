// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// The rows that paper 2 prints of its recording (Fig. 4 and 12): 27, of 26 points. What they prove of the
// sensor, and which of them are misprinted.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/core/angle.hpp"
#include "verge/io/file/csv.hpp"
#include "verge/io/test_files.hpp"

namespace verge::io {
namespace {

struct Row {
  int number = 0;
  int level = 0;
  double distance_m = 0.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  [[nodiscard]] double elevation_deg() const { return rad_to_deg(std::atan2(z, std::hypot(x, y))); }
  /// |p| and D agree to half a centimetre: D has steps of a centimetre.
  [[nodiscard]] bool is_consistent() const { return std::fabs(std::hypot(x, y, z) - distance_m) <= 0.005; }
};

const std::vector<Row> kRows = {
    {21, 1, 14.5800, 11.1689, 9.3718, 0.0},     {22, 0, 14.3000, 11.1121, 8.9984, -0.1987},
    {23, 1, 14.4000, 11.1909, 9.0622, 0.0},     {24, 0, 13.8000, 10.8759, 8.5753, -0.1945},
    {25, 1, 14.1200, 11.1267, 8.6931, 0.0},     {26, 0, 13.9800, 11.1638, 8.4126, -0.1952},
    {27, 1, 14.1100, 11.2687, 8.4916, 0.0},     {28, 0, 14.0900, 11.3979, 8.2811, -0.1967},
    {29, 1, 15.1900, 12.2890, 8.8285, 0.0},     {30, 0, 14.2100, 11.6390, 8.1487, -0.1984},
    {31, 1, 15.4000, 12.6395, 8.8503, 0.0},     {32, 2, 16.2300, 13.3743, 9.1919, 0.2266},
    {33, 3, 16.2900, 13.4198, 9.2232, 0.4548},  // Fig. 12 numbers from 33 what Fig. 4 numbers from 32
    {33, 2, 16.2300, 13.3743, 9.1919, 0.2266},  {36, 2, 16.5900, 13.8328, 9.1557, 0.2316},
    {40, 2, 16.9500, 14.2941, 9.1063, 0.2367},  {44, 2, 16.5800, 14.1354, 8.6622, 0.2315},
    {45, 2, 20.5500, 17.5200, 10.7963, 0.2669}, {49, 2, 16.3900, 14.1207, 8.3177, 0.2288},
    {50, 2, 20.3100, 17.4980, 10.3071, 0.2836}, {54, 2, 20.1300, 17.4751, 9.9879, 0.2811},
    {59, 2, 20.0100, 17.4569, 9.7764, 0.2794},  {64, 2, 19.8900, 17.4364, 9.5658, 0.2777},
    {68, 2, 19.7700, 17.4135, 9.3566, 0.2760},  {72, 2, 19.7300, 17.4591, 9.1857, 0.2755},
    {76, 2, 19.8000, 17.4230, 8.8735, 0.2737},  {80, 2, 19.8900, 17.7596, 8.9516, 0.2777}};

std::string text_of(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += std::to_string(row.number) + "," + std::to_string(row.level) + "," +
            std::to_string(row.distance_m) + "," + std::to_string(row.x) + "," + std::to_string(row.y) + "," +
            std::to_string(row.z) + "\n";
  }
  return text;
}

}  // namespace

TEST(Paper2Rows, AreATableThatIsRead) {
  const std::string text = text_of(kRows);
  Input input = Input::of(testing::bytes_of(text), "fig4.csv");
  const auto decoded = read_csv(input);
  ASSERT_TRUE(decoded) << to_string(decoded.error());
  ASSERT_EQ(decoded->cloud.x.size(), 27U);
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    EXPECT_FLOAT_EQ(decoded->cloud.y[i], static_cast<float>(kRows[i].y)) << kRows[i].number;
    EXPECT_EQ(decoded->cloud.ring[i], kRows[i].level) << kRows[i].number;
  }
}

TEST(Paper2Rows, AgreeWithTheirDistancesButForFiveDigits) {
  std::vector<int> wrong;
  for (const Row& row : kRows) {
    if (!row.is_consistent()) wrong.push_back(row.number);
  }
  EXPECT_THAT(wrong, ::testing::ElementsAre(24, 29, 31, 45, 76));
}

// A1.2: what single digits put right.
TEST(Paper2Rows, AreConsistentOnceTheDigitsArePutRight) {
  for (const Row& row : {Row{24, 0, 13.93, 10.9759, 8.5753, -0.1945}, Row{29, 1, 15.19, 12.2890, 8.9285, 0.0},
                         Row{31, 1, 15.43, 12.6395, 8.8503, 0.0}, Row{45, 2, 20.55, 17.5200, 10.7363, 0.2869},
                         Row{76, 2, 19.60, 17.4230, 8.9735, 0.2737}})
    EXPECT_TRUE(row.is_consistent()) << row.number;
}

// Levels 0.8 degrees apart, level 1 straight ahead: the frame of the recording, not of the sensor's housing.
TEST(Paper2Rows, TellTheElevationsOfTheLevels) {
  for (const Row& row : kRows) {
    if (!row.is_consistent()) continue;
    EXPECT_NEAR(row.elevation_deg(), -0.8 + 0.8 * row.level, 0.01) << row.number;
  }
}

// P2-27.
TEST(Paper2Rows, HaveTwoEchoesOfTwoShots) {
  const auto azimuth_deg = [](const Row& row) { return rad_to_deg(std::atan2(row.y, row.x)); };
  const auto row_of = [](int number) {
    return *std::ranges::find_if(kRows, [&](const Row& row) { return row.number == number; });
  };
  EXPECT_NEAR(azimuth_deg(row_of(44)), 31.5, 0.01);
  EXPECT_NEAR(azimuth_deg(row_of(45)), 31.5, 0.2);  // its y is misprinted
  EXPECT_NEAR(azimuth_deg(row_of(49)), azimuth_deg(row_of(50)), 0.01);
  EXPECT_GT(row_of(50).distance_m, row_of(49).distance_m + 3.0);
}

}  // namespace verge::io
