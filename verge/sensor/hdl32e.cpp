// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/sensor/hdl32e.hpp"

#include "verge/sensor/velodyne/facts.hpp"

namespace verge::sensor {

BeamModel hdl32e() { return velodyne::beam_model(velodyne::facts_of(velodyne::Model::kHdl32e)); }

}  // namespace verge::sensor
