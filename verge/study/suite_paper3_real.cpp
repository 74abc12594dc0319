// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "verge/study/suite_list.hpp"

// Paper 3's table on labelled real scans. Which of them show a junction was told by eye: within 20 m of all
// scans of SemanticKITTI 00 a road forks off behind; the nuScenes drive comes out of a bend and passes the
// mouth of a driveway, and from its tenth scan on there is road alone, as on all scans of the VLP-16.

namespace verge::study {

Suite paper3_real_suite(const SuiteRequest& request) {
  if (request.data.empty()) {
    throw std::invalid_argument(
        "suite paper3-real needs the labelled sets: set VERGE_DATA or give --data FOLDER");
  }
  constexpr std::size_t kFirstStraight = 9;
  const auto nuscenes = request.data / "nuscenes-hdl32" / "labelled";
  Suite suite;
  suite.name = "paper3-real";
  suite.title = "Paper 3: success of real scans";
  suite.about =
      "Success as in suite paper3, against labels: at least 90 % of the true points within 20 m are found "
      "within 0.2 m and nothing that can be judged is more than 0.5 m off (minimum deviation), or 0.5 m and "
      "1 m (larger deviation); of the VLP-16 set, which labels kerb points alone, only the first condition "
      "counts. low and high bound the share with 95 % (Wilson). Precision, recall and F1 at "
      "0.3 m. The settings of gradient were chosen on the scans at even places.";
  suite.cells = {{.name = "straight: nuScenes HDL-32E",
                  .scans = LabelledScans{.folder = nuscenes, .first = kFirstStraight}},
                 {.name = "straight: VLP-16 kerb labels",
                  .scans = LabelledScans{.folder = request.data / "vlp16-kerb-labels"}},
                 {.name = "junction: nuScenes HDL-32E",
                  .scans = LabelledScans{.folder = nuscenes, .last = kFirstStraight - 1}},
                 {.name = "junction: SemanticKITTI 00",
                  .scans = LabelledScans{.folder = request.data / "semantickitti"}}};
  suite.columns = {{"scans", "scans", 0},
                   {"success", "success"},
                   {"success_low", "low"},
                   {"success_high", "high"},
                   {"minimum", "min.", 0},
                   {"larger", "larger", 0},
                   {"failed", "failed", 0},
                   {"precision", "precision"},
                   {"recall", "recall"},
                   {"kerb_recall", "kerb recall"},
                   {"f1", "F1"},
                   {"rmse_m", "RMSE m"}};
  suite.road_figures = hdl32_figures("straight: nuScenes HDL-32E", "junction: nuScenes HDL-32E");
  return suite;
}

}  // namespace verge::study
