// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "verge/core/error.hpp"
#include "verge/eval/labelled_set.hpp"
#include "verge/scan/organise.hpp"

namespace verge::eval {

/// A scan as it lies in its file, and the class of each of its points.
struct LabelledCloud {
  Cloud cloud;
  std::vector<std::uint32_t> labels;
};

/// The class of each point, from a file of kNuscenes, kSemanticKitti (whose upper 16 bits, the instance, go)
/// or kKerbLabels. Fails as io::Input does, and with kUnusable where labels and points are not equally many.
[[nodiscard]] Expected<std::vector<std::uint32_t>> read_labels(LabelFormat format,
                                                               const std::filesystem::path& path,
                                                               std::size_t points);

/// A scan and its labels in one of these formats. Fails as the reader of the scan does, and as read_labels().
[[nodiscard]] Expected<LabelledCloud> read_labelled_cloud(LabelFormat format,
                                                          const std::filesystem::path& scan,
                                                          const std::filesystem::path& labels);

}  // namespace verge::eval
