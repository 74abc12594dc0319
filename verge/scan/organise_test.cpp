// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/scan/organise.hpp"

#include <gtest/gtest.h>

namespace verge {
namespace {

TEST(Organise, EmptyCloudGivesEmptyScan) {
  const Organised organised = organise({});
  EXPECT_EQ(organised.scan.size(), 0U);
  EXPECT_EQ(organised.scan.ring_count(), 0U);
}

}  // namespace
}  // namespace verge
