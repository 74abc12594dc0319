// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/eval/label_edges.hpp"
#include "verge/scan/organise.hpp"

namespace verge::eval {

/// Rings by the cloud's ring numbers, upwards, each in order of azimuth; points within 0.5 m of the sensor
/// (the vehicle) are left out. One label a point.
[[nodiscard]] std::vector<LabelledRing> rings_by_number(const Cloud& cloud,
                                                        std::span<const std::uint32_t> labels);

/// Rings by the order of the points, as KITTI stores them: one ends where the azimuth, counted from straight
/// ahead, jumps back by more than half a turn. Rings of ten points or fewer are left out. One label a point.
[[nodiscard]] std::vector<LabelledRing> rings_by_order(const Cloud& cloud,
                                                       std::span<const std::uint32_t> labels);

/// The truth of a scan and its labels. Fails as the readers of scans do, and with kUnusable where labels and
/// points are not equally many.
[[nodiscard]] Expected<LabelledTruth> read_nuscenes_truth(const std::filesystem::path& scan,
                                                          const std::filesystem::path& labels, double gap_m);
[[nodiscard]] Expected<LabelledTruth> read_kitti_truth(const std::filesystem::path& scan,
                                                       const std::filesystem::path& labels, double gap_m);
/// Of labels of kerbs alone: the labelled points, joined to their neighbours.
[[nodiscard]] Expected<LabelledTruth> read_kerb_label_truth(const std::filesystem::path& scan,
                                                            const std::filesystem::path& labels);

}  // namespace verge::eval
