// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "verge/model/scene.hpp"
#include "verge/model/trace.hpp"
#include "verge/scan/scan.hpp"

namespace verge::detect {

/// Whether a detector remembers.
enum class Order : std::uint8_t {
  kIndependent,  ///< process() may be called from several threads at once, in any order.
  kSequential,   ///< process() must see the scans one by one, in order.
};

/// A method that finds road boundaries. Scan in, Scene out.
class Detector {
 public:
  Detector() = default;
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;
  virtual ~Detector() = default;

  /// What the method says about one scan; with a `trace`, also every intermediate under its paper name.
  /// Defined for every scan: an empty or degenerate one gives a Scene without boundaries.
  [[nodiscard]] virtual Scene process(const Scan& scan, Trace* trace = nullptr) = 0;

  [[nodiscard]] virtual Order order() const = 0;
};

}  // namespace verge::detect
