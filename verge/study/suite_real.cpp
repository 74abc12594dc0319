// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>
#include <string>

#include "verge/study/suite_list.hpp"

namespace verge::study {
namespace {

struct Set {
  const char* name;
  const char* folder;  // within the folder of the data
};

constexpr const char* kHdl32 = "nuScenes HDL-32E";
constexpr std::array kSets = {Set{"SemanticKITTI 00", "semantickitti"},
                              Set{kHdl32, "nuscenes-hdl32/labelled"},
                              Set{"VLP-16 kerb labels", "vlp16-kerb-labels"}};

}  // namespace

// Of the set's 14 scans the first ones pass the mouth of a side street, whose kerbs both round into it in
// sight at place 2; from the tenth on the road is straight, and at place 11 it is so as far as is seen.
std::vector<RoadFigure> hdl32_figures(const std::string& straight, const std::string& junction) {
  return {{"a straight road, HDL-32E", straight, 0, 11, false},
          {"a junction, HDL-32E", junction, 0, 2, true}};
}

Suite real_suite(const SuiteRequest& request) {
  if (request.data.empty())
    throw std::invalid_argument("suite real needs the labelled sets: set VERGE_DATA or give --data FOLDER");
  Suite suite;
  suite.name = "real";
  suite.title = "Labelled scans";
  suite.about =
      "Boundaries within 20 m against labels, right within 0.3 m, by the definitions of the sets' own "
      "scorer. The "
      "settings of gradient were chosen on the scans at even places, those at odd places are given apart; "
      "they are the "
      "same streets a moment later.";
  for (const Set& set : kSets) {
    suite.cells.push_back({set.name, LabelledScans{request.data / set.folder, false}});
    suite.cells.push_back({std::string(set.name) + ", odd", LabelledScans{request.data / set.folder, true}});
  }
  suite.columns = {{"scans", "scans", 0}, {"precision", "precision"},     {"recall", "recall"},
                   {"f1", "F1"},          {"macro_f1", "macro F1"},       {"kerb_recall", "kerb recall"},
                   {"rmse_m", "RMSE m"},  {"f1_at_0.1_m", "F1 at 0.1 m"}, {"judged", "judged"}};
  suite.road_figures = hdl32_figures(kHdl32, kHdl32);
  return suite;
}

}  // namespace verge::study
