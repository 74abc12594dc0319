// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace verge::faults {

/// Watches what `new` gives out in this program.
class MemoryMeter {
 public:
  MemoryMeter();
  /// The most bytes that were out at one time since this meter began, beyond those that were out then.
  [[nodiscard]] std::size_t peak() const;

 private:
  std::size_t before_;
};

}  // namespace verge::faults
