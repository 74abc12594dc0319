// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "verge/study/suite_list.hpp"

namespace verge::study {

Suite paper2_real_suite(const SuiteRequest& request) {
  if (request.data.empty()) {
    throw std::invalid_argument(
        "suite paper2-real needs the labelled sets: set VERGE_DATA or give --data FOLDER");
  }
  Suite suite;
  suite.name = "paper2-real";
  suite.title = "Paper 2 on real scans";
  suite.about =
      "Four rings of a denser scanner stand in for the LUX's layers (no road recording of one is public). "
      "Boundaries within 20 m against labels, right within 0.3 m, as in suite real; objects within 50 m "
      "against "
      "boxes that at least three returns of these rings hit, found where footprints overlap by half or more. "
      "Nothing was tuned on these scans.";
  suite.judged = {.boundaries = true, .corners = false, .objects = true};
  suite.cells = {
      {.name = "SemanticKITTI 00 (HDL-64E)", .scans = LabelledScans{request.data / "semantickitti"}},
      {.name = "nuScenes (HDL-32E)", .scans = LabelledScans{request.data / "nuscenes-hdl32" / "labelled"}},
      {.name = "nuScenes n015, boxes",
       .scans = LabelledScans{.folder = request.data / "nuscenes-hdl32" / "raw", .boxes = true}}};
  suite.columns = {{"scans", "scans", 0},
                   {"precision", "precision"},
                   {"recall", "recall"},
                   {"kerb_recall", "kerb recall"},
                   {"rmse_m", "RMSE m"},
                   {"judged", "judged"},
                   {"objects_true", "objects", 0},
                   {"objects_predicted", "said", 0},
                   {"objects_precision", "obj. precision"},
                   {"objects_recall", "obj. recall"},
                   {"objects_iou", "IoU"},
                   {"objects_heading_mean_deg", "heading deg", 1},
                   {"car_f1", "car F1"},
                   {"person_f1", "person F1"}};
  return suite;
}

}  // namespace verge::study
