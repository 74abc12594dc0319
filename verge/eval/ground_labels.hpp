// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "verge/core/error.hpp"
#include "verge/eval/ground_score.hpp"
#include "verge/eval/labelled_set.hpp"

namespace verge::eval {

/// A labelled scan with what its labels say is ground. Fails as the readers of scans do, and with kUnusable
/// where labels and points are not equally many or the labels do not tell ground from what stands on it
/// (kerbs alone).
[[nodiscard]] Expected<GroundTruth> read_ground_truth(const LabelledScan& scan);

/// The label files in and below a folder (NAME_lidarseg.bin, NAME.label), by their names. Fails with
/// kCannotOpen, kUnusable where there are none, and kUsage where a name stands in two places.
[[nodiscard]] Expected<std::map<std::string, std::filesystem::path>> find_label_files(
    const std::filesystem::path& folder);

/// What a program's label file says of the points of a scan: its classes are the set's own numbers, those of
/// ground are ground and all others, vegetation too, are not. Fails as read_ground_truth().
[[nodiscard]] Expected<GroundPrediction> read_ground_prediction(const std::filesystem::path& labels,
                                                                const LabelledScan& scan,
                                                                const GroundTruth& truth);

}  // namespace verge::eval
