// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "verge/scan/organise.hpp"
#include "verge/scan/scan.hpp"

namespace verge::io {

/// The points of a scan in the input's order, for encoders of messages: times to the nanosecond after
/// `Scan::stamp_ns`, or none where the scan has none.
[[nodiscard]] Cloud wire_points(const Scan& scan);

/// Times of scans where some do not say theirs: these follow the one before by a tenth of a second, the first
/// from 1970 on.
class ScanTimes {
 public:
  [[nodiscard]] std::int64_t of(const Scan& scan);

 private:
  std::int64_t next_ns_ = 0;
};

}  // namespace verge::io
