// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "verge/io/recording.hpp"

namespace verge::faults {

/// Whether of each kind ("messages", "packets", ...) what was received is the sum of what became of it.
[[nodiscard]] inline bool add_up(const std::vector<io::Counter>& counters) {
  std::map<std::string, std::uint64_t> received;
  std::map<std::string, std::uint64_t> sums;
  for (const io::Counter& counter : counters) {
    const std::string kind = counter.name.substr(0, counter.name.find(' '));
    (counter.name == kind + " received" ? received : sums)[kind] += counter.count;
  }
  return received == sums;
}

}  // namespace verge::faults
