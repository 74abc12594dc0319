// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "apps/verge/console.hpp"
#include "apps/verge/signals.hpp"
#include "verge/core/error.hpp"
#include "verge/study/suite.hpp"

namespace verge::app {

/// Writes what another program is to be run on: the scans of a suite's made drives as FOLDER/scans/FRAME.pcd,
/// each without its motion, and what is true of them as FOLDER/truth.jsonl. Predictions by these frames are
/// judged by the same suite. Fails with kUsage where the suite is of labelled sets, and as the writers of
/// scans and Scenes do; a signal ends it after the scan under way.
[[nodiscard]] Expected<void> write_suite_scans(const study::Suite& suite, const std::filesystem::path& folder,
                                               Console& console, const Signals& signals);

}  // namespace verge::app
