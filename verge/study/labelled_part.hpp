// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verge/study/parts.hpp"

namespace verge::study {

/// see_again() of a labelled set.
[[nodiscard]] Expected<Seen> see_labelled_again(const LabelledScans& set, const ScanScore& wanted,
                                                const Contestant& contestant);

}  // namespace verge::study
