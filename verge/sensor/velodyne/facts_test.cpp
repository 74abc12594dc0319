// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/velodyne/facts.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::sensor::velodyne {
namespace {

constexpr std::array kModels = {Model::kHdl32e,   Model::kVlp16,    Model::kVlp32c,
                                Model::kHdl64eS1, Model::kHdl64eS2, Model::kHdl64eS3};

std::vector<double> elevations_deg(Model model) {
  std::vector<double> out;
  for (const LaserCorrection& laser : facts_of(model).calibration)
    out.push_back(rad_to_deg(laser.elevation_rad));
  std::sort(out.begin(), out.end());
  return out;
}

TEST(VelodyneFacts, EveryLaserOfEveryModelHasItsOwnElevation) {
  for (const Model model : kModels) {
    const std::vector<double> elevations = elevations_deg(model);
    ASSERT_EQ(elevations.size(), facts_of(model).lasers);
    EXPECT_EQ(std::set<double>(elevations.begin(), elevations.end()).size(), elevations.size());
  }
}

TEST(VelodyneFacts, Vlp16LasersAreTwoDegreesApart) {
  const std::vector<double> elevations = elevations_deg(Model::kVlp16);
  for (std::size_t ring = 0; ring < 16; ++ring)
    EXPECT_NEAR(elevations[ring], -15.0 + 2.0 * static_cast<double>(ring), 1e-12);
  // Manual, table 9-1: laser 0 at -15, laser 1 at +1, laser 15 at +15 degrees.
  EXPECT_NEAR(rad_to_deg(facts_of(Model::kVlp16).calibration[1].elevation_rad), 1.0, 1e-12);
}

TEST(VelodyneFacts, Vlp32cReachesFrom25BelowTo15Above) {
  const std::vector<double> elevations = elevations_deg(Model::kVlp32c);
  EXPECT_NEAR(elevations.front(), -25.0, 1e-12);
  EXPECT_NEAR(elevations.back(), 15.0, 1e-12);
  for (const LaserCorrection& laser : facts_of(Model::kVlp32c).calibration) {
    const double column = std::abs(rad_to_deg(laser.azimuth_rad));
    EXPECT_TRUE(std::abs(column - 1.4) < 1e-9 || std::abs(column - 4.2) < 1e-9) << column;
  }
}

TEST(VelodyneFacts, Hdl64eBanksReachAsTheManualSays) {
  for (const Model model : {Model::kHdl64eS1, Model::kHdl64eS2, Model::kHdl64eS3}) {
    const std::vector<double> elevations = elevations_deg(model);
    EXPECT_NEAR(elevations.front(), -24.33, 1e-9);
    EXPECT_NEAR(elevations[31], -8.83, 1e-9);
    EXPECT_NEAR(elevations[32], -8.33, 1e-9);
    EXPECT_NEAR(elevations.back(), 2.0, 0.01);
  }
}

TEST(VelodyneFacts, TheLastShotOfAPacketIsWhereTheManualsHaveIt) {
  const auto last_ns = [](Model model, std::size_t steps) {
    const Facts& facts = facts_of(model);
    return static_cast<std::int64_t>(steps - 1) * facts.step_ns + facts.slot_time_ns.back();
  };
  EXPECT_EQ(last_ns(Model::kHdl32e, 12), 542'592);   // manual, appendix E: 542.592 us
  EXPECT_EQ(last_ns(Model::kVlp16, 12), 1'306'368);  // manual, figure 9-5: 1306.368 us
  EXPECT_EQ(last_ns(Model::kVlp32c, 12), 642'816);   // manual, figure 9-7: 642.816 us
}

TEST(VelodyneFacts, ModelsAreFoundByName) {
  EXPECT_EQ(model_named("vlp32c"), Model::kVlp32c);
  EXPECT_EQ(model_named("hdl64e"), Model::kHdl64eS2);
  EXPECT_EQ(model_named("hdl64e-s3"), Model::kHdl64eS3);
  EXPECT_FALSE(model_named("HDL32E"));
  EXPECT_FALSE(model_named(""));
}

TEST(VelodyneFacts, TheBeamModelHasOneFiringsLasers) {
  const BeamModel vlp16 = beam_model(facts_of(Model::kVlp16));
  EXPECT_EQ(vlp16.lasers.size(), 16U);
  EXPECT_EQ(vlp16.firing_period_ns, 55'296);
  const BeamModel hdl64e = beam_model(facts_of(Model::kHdl64eS2));
  EXPECT_EQ(hdl64e.lasers.size(), 64U);
  EXPECT_EQ(hdl64e.lasers[32].time_ns, hdl64e.lasers[0].time_ns) << "both banks fire together";
  const BeamModel first_series = beam_model(facts_of(Model::kHdl64eS1));
  EXPECT_EQ(first_series.lasers.size(), 4U * 32U) << "three steps of the upper bank, one of the lower";
  EXPECT_EQ(first_series.firing_period_ns, 4 * 32'051);
  EXPECT_EQ(first_series.lasers[0].ring, first_series.lasers[64].ring);
}

}  // namespace
}  // namespace verge::sensor::velodyne
