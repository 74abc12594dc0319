// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/hdl32e.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "verge/core/angle.hpp"

namespace verge::sensor {
namespace {

TEST(Hdl32e, AnglesAreThoseOfTheManualToAHundredthOfADegree) {
  // The manual's table, "Laser Firing Sequence", as printed (it rounds -26.667 and -6.667 up).
  const std::vector<double> printed = {-30.67, -9.33, -29.33, -8.00, -28.00, -6.66, -26.66, -5.33,
                                       -25.33, -4.00, -24.00, -2.67, -22.67, -1.33, -21.33, 0.00,
                                       -20.00, 1.33,  -18.67, 2.67,  -17.33, 4.00,  -16.00, 5.33,
                                       -14.67, 6.67,  -13.33, 8.00,  -12.00, 9.33,  -10.67, 10.67};
  const BeamModel model = hdl32e();
  ASSERT_EQ(model.lasers.size(), printed.size());
  for (std::size_t j = 0; j < printed.size(); ++j) {
    EXPECT_NEAR(rad_to_deg(model.lasers[j].elevation_rad), printed[j], 0.0101) << "laser " << j;
  }
}

TEST(Hdl32e, ElevationsAreFourThirdsOfADegreeApart) {
  std::vector<double> elevations;
  for (const Laser& laser : hdl32e().lasers) elevations.push_back(rad_to_deg(laser.elevation_rad));
  std::sort(elevations.begin(), elevations.end());
  for (std::size_t i = 1; i < elevations.size(); ++i) {
    EXPECT_NEAR(elevations[i] - elevations[i - 1], 4.0 / 3.0, 0.011);
  }
}

TEST(Hdl32e, EvenLasersAreTheLowerBankAndOddLasersTheUpper) {
  const std::vector<Laser> lasers = hdl32e().lasers;
  for (std::size_t j = 0; j < lasers.size(); ++j) {
    EXPECT_EQ(lasers[j].ring, j % 2 == 0 ? j / 2 : 16 + (j - 1) / 2) << "laser " << j;
  }
}

TEST(Hdl32e, TheLastLaserFires35712NanosecondsAfterTheFirst) {
  EXPECT_EQ(hdl32e().lasers.front().time_ns, 0);
  EXPECT_EQ(hdl32e().lasers.back().time_ns, 35'712);
}

TEST(Hdl32e, ARevolutionAtTenHertzTakes2170Firings) {
  const BeamModel model = hdl32e();
  EXPECT_EQ(revolution_ns(model), 100'000'000);
  EXPECT_EQ(revolution_ns(model) / model.firing_period_ns, 2170);
  EXPECT_NEAR(rad_to_deg(azimuth_step_rad(model)), 0.16589, 5e-6);
}

TEST(Hdl32e, MeasuresNearly700000TimesASecond) {
  const BeamModel model = hdl32e();
  const double shots_per_second =
      static_cast<double>(model.lasers.size()) * 1e9 / static_cast<double>(model.firing_period_ns);
  EXPECT_NEAR(shots_per_second, 694'444.4, 0.1);
}

}  // namespace
}  // namespace verge::sensor
