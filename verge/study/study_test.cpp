// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "verge/core/statistics.hpp"
#include "verge/sim/ready.hpp"
#include "verge/sim/sensors.hpp"
#include "verge/study/engine.hpp"
#include "verge/study/figures.hpp"
#include "verge/study/markup.hpp"
#include "verge/study/part_store.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/plot.hpp"
#include "verge/study/report.hpp"
#include "verge/study/table.hpp"
#include "verge/study/tally_json.hpp"
#include "verge/study/thin.hpp"

namespace verge::study {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A folder that goes with the test.
class StudyFolder : public testing::Test {
 protected:
  StudyFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "verge_study_XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~StudyFolder() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path folder_;
};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// --- Numbers that add up

TEST(Histogram, SaysWhatTheValuesThemselvesSay) {
  const std::vector<double> values = {-0.3, 0.1, 0.2, 0.2, 0.5, 0.04};
  Histogram one;
  Histogram other;
  for (std::size_t i = 0; i < values.size(); ++i) (i % 2 == 0 ? one : other).add(values[i]);
  one += other;
  EXPECT_EQ(one.count(), 6U);
  EXPECT_NEAR(*one.mean(), *mean(values), 1e-12);
  for (const double percent : {0.0, 33.0, 50.0, 95.0, 100.0})
    EXPECT_NEAR(*one.percentile(percent), *percentile(values, percent), 1e-12) << percent;
  EXPECT_NEAR(*one.sizes().percentile(100.0), 0.5, 1e-12);
  EXPECT_NEAR(*one.root_mean_square(), std::sqrt((0.09 + 0.01 + 0.04 + 0.04 + 0.25 + 0.0016) / 6.0), 1e-12);
  EXPECT_FALSE(Histogram().percentile(50.0).has_value());
}

/// A tally that has something in every member.
Tally full_tally() {
  Tally tally;
  tally.scans = 3;
  tally.cells = {{20.0, 0.2, {10, 9, 8, 7, 6, 5}, 0.1 + 0.2, 3}};
  tally.by_range.bins = {{1, 1, 2, 2, 0, 0}};
  tally.by_confidence = {{0.05, {4, 3, 2, 1, 0, 0}}};
  tally.stations = {1, 2, 3, 4, 5, 1.0 / 3.0};
  tally.straight = {5, 4, 3};
  tally.lateral_m.add(-0.017);
  tally.lateral_by_range_m = {Histogram(), tally.lateral_m};
  tally.heading_rad.add(0.0123);
  tally.objects.truth = 2;
  tally.objects.heading_error_rad = {0.1};
  tally.corners.true_corners = 4;
  tally.corners.latency_m = {1.0 / 7.0};
  tally.corners.way_m = 123.4;
  tally.labels.at.push_back({.tolerance_m = 0.3});
  tally.seconds.add(0.0123);
  tally.poorest = {{0.25, 7, 85, "frame \"a\""}};
  return tally;
}

TEST(TallyJson, ComesBackToTheSameBytes) {
  const std::string text = to_json(full_tally());
  const auto back = parse_tally(text);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(to_json(*back), text);
  EXPECT_EQ(back->cells.at(0).f1_sum, 0.1 + 0.2);
  EXPECT_EQ(back->poorest, full_tally().poorest);
  for (const char* bad : {"", "{}", "[1]", "{\"scans\":\"many\"}"})
    EXPECT_FALSE(parse_tally(bad).has_value()) << bad;
}

TEST(Tally, OfPartsIsThatOfTheWhole) {
  Tally sum = full_tally();
  sum += full_tally();
  EXPECT_EQ(sum.scans, 6U);
  EXPECT_EQ(sum.cells.at(0).counts.predicted, 20U);
  EXPECT_EQ(sum.lateral_by_range_m.at(1).count(), 2U);
  EXPECT_EQ(sum.corners.way_m, 246.8);
  EXPECT_EQ(sum.poorest.size(), 2U);
  Tally from_nothing;
  from_nothing += full_tally();
  EXPECT_EQ(to_json(from_nothing), to_json(full_tally()));
}

// --- Parts that are kept

class PartStoreTest : public StudyFolder {
 protected:
  [[nodiscard]] std::optional<Tally> find(const PartKey& key) {
    return store_.find(key, [this](const std::string& text) { warnings_.push_back(text); });
  }
  PartStore store_ = PartStore::open(folder_ / "parts").value();
  std::vector<std::string> warnings_;
  PartKey key_{"a cell 1 gradient", "settings"};
};

TEST_F(PartStoreTest, GivesBackWhatItKeptForTheSameSettingsAlone) {
  EXPECT_FALSE(find(key_).has_value());
  ASSERT_TRUE(store_.keep(key_, full_tally()).has_value());
  EXPECT_EQ(to_json(find(key_).value()), to_json(full_tally()));
  EXPECT_FALSE(find({key_.name, "other settings"}).has_value());
  EXPECT_FALSE(find({"a cell 2 gradient", key_.settings}).has_value());
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(PartStoreTest, SeesEveryCutAndEveryBitThatFlips) {
  ASSERT_TRUE(store_.keep(key_, full_tally()).has_value());
  const auto path = folder_ / "parts" / key_.file_name();
  const std::string whole = bytes_of(path);
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    write(path, whole.substr(0, i));
    EXPECT_FALSE(find(key_).has_value()) << "cut at " << i;
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    write(path, flipped);
    EXPECT_FALSE(find(key_).has_value()) << "flipped at " << i;
  }
  EXPECT_THAT(warnings_.front(), HasSubstr("is damaged, and is made again"));
}

// --- Contestants and suites

TEST(Contestant, IsAMethodWithSettings) {
  const Contestant contestant = contestant_of("gradient:reading=paper,points_min=4");
  EXPECT_EQ(contestant.method, "gradient");
  EXPECT_THAT(settings_text(contestant), HasSubstr("points_min = 4"));
  EXPECT_NE(settings_text(contestant), settings_text(contestant_of("gradient")));
  for (const char* bad : {"gradeint", "gradient:reading", "gradient:reading=other", "gradient:nothing=1"})
    EXPECT_THROW((void)contestant_of(bad), std::invalid_argument) << bad;
}

TEST(Contestant, UsuallyIsEveryMethodThatSaysWhatIsJudgedInEveryReading) {
  std::set<std::string> names;
  for (const Contestant& contestant : usual_contestants({.corners = true})) names.insert(contestant.name);
  for (const detect::Method& method : detect::methods())
    EXPECT_TRUE(names.contains(std::string(method.name)));
  EXPECT_TRUE(names.contains("gradient:reading=paper"));
}

TEST(Suites, ShowFiguresThatThereAreOfCellsThatThereAre) {
  for (const SuiteEntry& entry : suites()) {
    const Suite suite = entry.make({.data = "data"});
    EXPECT_EQ(suite.name, entry.name);
    std::set<std::string> cells;
    for (const Cell& cell : suite.cells) EXPECT_TRUE(cells.insert(cell.name).second) << cell.name;
    for (const Printed& printed : suite.printed) EXPECT_TRUE(cells.contains(printed.cell)) << printed.cell;
    for (const RoadFigure& figure : suite.road_figures)
      EXPECT_TRUE(cells.contains(figure.cell)) << figure.cell;
    Tally tally;
    for (const double tolerance_m : eval::LabelScoreConfig{}.tolerance_m)
      tally.labels.at.push_back({.tolerance_m = tolerance_m});
    std::set<std::string> figures;
    for (const Figure& figure : figures_of(suite, contestant_of("gradient"), tally))
      figures.insert(figure.name);
    for (const Column& column : suite.columns) EXPECT_TRUE(figures.contains(column.figure)) << column.figure;
  }
  EXPECT_THROW((void)suite_named("paper4", {}), std::invalid_argument);
  EXPECT_THROW((void)suite_named("real", {}), std::invalid_argument);
}

TEST(Suites, HaveAsManyFramesAsPaper3) {
  const Suite suite = suite_named("paper3", {});
  std::vector<std::size_t> frames;
  for (const Cell& cell : suite.cells) {
    const auto& drives = std::get<MadeDrives>(cell.scans);
    frames.push_back(drives.drives * drives.scans);
  }
  EXPECT_THAT(frames, testing::ElementsAre(670U, 230U, 80U));
}

// --- The engine

/// Drives of a few scans on a short road, judged for all that can be.
Suite small_suite() {
  Suite suite;
  suite.name = "small";
  suite.title = "A <small> suite";
  suite.about = "What it is.";
  suite.judged = {.boundaries = true, .corners = true, .objects = true};
  suite.cells = {{.name = "short road",
                  .scans = MadeDrives{.make =
                                          [](std::uint64_t drive) {
                                            sim::DriveConfig config;
                                            config.scenario = sim::ready_scenario("right");
                                            config.sensor = sim::sensor_named("hdl32e");
                                            config.noise.seed = drive;
                                            return config;
                                          },
                                      .drives = 2,
                                      .scans = 2}}};
  suite.columns = {{"scans", "scans", 0}, {"f1", "F1"}, {"m1", "M1"}};
  suite.printed = {{"short road", "somebody", {{"f1", 0.5}}}};
  return suite;
}

struct Outcome {
  Expected<Results> results;
  std::size_t scans = 0;
  std::vector<std::string> warnings;
};

Outcome run_small(std::size_t jobs, const std::optional<std::filesystem::path>& keep_in,
                  bool stopped = false) {
  Outcome outcome{Results{}, 0, {}};
  const RunHooks hooks{.progress = [&](std::size_t done, std::size_t) { outcome.scans = done; },
                       .warning = [&](const std::string& text) { outcome.warnings.push_back(text); }};
  const std::atomic<bool> stop{stopped};
  outcome.results = run(small_suite(), {contestant_of("gradient")},
                        {.jobs = jobs, .keep_in = keep_in, .salt = "test"}, hooks, stop);
  return outcome;
}

class Engine : public StudyFolder {};

TEST_F(Engine, MakesTheSameBytesAtAnyNumberOfJobsAndGoesOnWhereItStopped) {
  const Outcome one = run_small(1, std::nullopt);
  ASSERT_TRUE(one.results.has_value());
  EXPECT_EQ(one.scans, 4U);
  const Outcome two = run_small(2, folder_);
  const std::string json = json_report(*one.results, false);
  EXPECT_EQ(json_report(*two.results, false), json);
  EXPECT_EQ(csv_report(*two.results), csv_report(*one.results));

  const Outcome again = run_small(2, folder_);
  EXPECT_EQ(again.scans, 0U);
  EXPECT_EQ(json_report(*again.results, false), json);

  std::vector<std::filesystem::path> parts{std::filesystem::directory_iterator(folder_), {}};
  ASSERT_EQ(parts.size(), 2U);
  write(parts[0], bytes_of(parts[0]).substr(0, 100));
  const Outcome mended = run_small(1, folder_);
  EXPECT_EQ(mended.scans, 2U);
  EXPECT_EQ(mended.warnings.size(), 1U);
  EXPECT_EQ(json_report(*mended.results, false), json);
}

TEST_F(Engine, KeepsNoPartThatIsNotDone) {
  const Outcome stopped = run_small(1, folder_, true);
  ASSERT_TRUE(stopped.results.has_value());
  EXPECT_EQ(stopped.results->parts, 2U);
  EXPECT_EQ(stopped.results->parts_done, 0U);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Engine, SaysWhatCannotBeKept) {
  write(folder_ / "file", "");
  EXPECT_EQ(run_small(1, folder_ / "file" / "parts").results.error().code, ErrorCode::kCannotWrite);
}

TEST(Predictions, OfMadeDrivesAreFoundByCellDriveAndScan) {
  const Suite suite = small_suite();
  const std::vector<std::string> frames = frames_of(suite);
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.front(), frame_of(suite.cells[0], 1, 0));
  Predictions predictions;
  predictions.emplace(frames.front(), Scene{});
  const std::atomic<bool> stop{false};
  const RunHooks hooks{[](std::size_t, std::size_t) {}, [](const std::string&) {}};
  const auto results = run(suite, {contestant_of("file", predictions)}, {}, hooks, stop).value();
  std::size_t absent = 0;
  for (const Tally& tally : results.tallies) absent += tally.absent;
  EXPECT_EQ(absent, frames.size() - 1);
}

TEST(Predictions, NameScansByLettersThatFilesMayHave) {
  EXPECT_EQ(frame_of({.name = "3 m, 60 km/h", .scans = {}}, 2, 45), "3-m--60-km-h-2-000045");
}

TEST(Thin, LosesTheShareThatWasAskedForAndKeepsRings) {
  const sim::Drive drive(std::get<MadeDrives>(small_suite().cells[0].scans).make(1));
  const Scan whole = drive.scan(0).scan;
  const Scan thinned = thin(whole, 0.3, 1, 0);
  // Binomial: five deviations.
  const auto count = static_cast<double>(whole.size());
  EXPECT_NEAR(static_cast<double>(thinned.size()), 0.7 * count, 5.0 * std::sqrt(0.21 * count));
  EXPECT_EQ(thinned.ring_count(), whole.ring_count());
  EXPECT_EQ(thinned.ring_begin.back(), thinned.size());
  std::size_t in_whole = 0;
  for (std::size_t ring = 0; ring < thinned.ring_count(); ++ring) {
    for (auto [i, end] = thinned.ring(ring); i < end; ++i) {
      while (whole.input_index.at(in_whole) != thinned.input_index[i]) ++in_whole;
      ASSERT_TRUE(in_whole >= whole.ring(ring).first && in_whole < whole.ring(ring).second);
      ASSERT_EQ(thinned.range[i], whole.range[in_whole]);
    }
  }
  EXPECT_EQ(thin(whole, 0.0, 1, 0).size(), whole.size());
  EXPECT_EQ(thin(whole, 1.0, 1, 0).size(), 0U);
}

// --- What is told

/// One kerb of 10 m, 3 m to the left: predicted 0.15 m beside it along its first half.
Results closed_form(const std::filesystem::path& folder) {
  std::string table = "frame,side,x,y,z\n";
  for (int i = 0; i <= 20; ++i) table += "a,left," + std::to_string(0.5 * i) + ",3,0\n";
  write(folder / "truth.csv", table);
  Suite suite;
  suite.name = "closed";
  suite.title = "Closed form";
  suite.judged.corners = true;
  suite.cells = {{.name = "a kerb", .scans = LabelledScans{folder}}};
  suite.columns = {
      {"scans", "scans", 0}, {"precision", "precision"}, {"recall", "recall"}, {"f1_at_0.1_m", "F1 at 0.1"}};
  Scene scene;
  scene.boundaries.resize(1);
  scene.boundaries[0].points = {{0.0, 3.15, 0.0}, {5.0, 3.15, 0.0}};
  const std::atomic<bool> stop{false};
  const RunHooks hooks{[](std::size_t, std::size_t) {}, [](const std::string&) {}};
  return run(suite, {contestant_of("program", Predictions{{"a", scene}})}, {}, hooks, stop).value();
}

TEST_F(Engine, ATinySuitesTableIsWhatIsWorkedOutByHand) {
  const Results results = closed_form(folder_);
  // 11 of 21 true points have the line beside them, and the one at 5.5 m is 0.52 m from its end.
  EXPECT_EQ(to_text(tables_of(results).at(0)),
            "case    method   scans  precision  recall  F1 at 0.1\n"
            "a kerb  program      1      1.000   0.524      0.000\n");
  EXPECT_THAT(notes_on(results),
              testing::ElementsAre("program does not report corners: such figures are \"-\"."));
}

/// Nothing but returns of one ring 10 m ahead, from y = -2 m to 2 m, in the file's own axes.
std::string returns_ahead() {
  std::string bytes;
  for (int i = -20; i <= 20; ++i) {
    for (const float value : {0.1F * static_cast<float>(i), 10.0F, 0.0F, 9.0F, 0.0F}) {
      std::array<char, sizeof value> raw{};
      std::memcpy(raw.data(), &value, sizeof value);
      bytes.append(raw.data(), raw.size());
    }
  }
  return bytes;
}

TEST_F(Engine, ObjectsAreJudgedAgainstTheBoxesThatReturnsHit) {
  write(folder_ / "a.pcd.bin", returns_ahead());
  write(folder_ / "a_boxes.json", R"({"boxes": [
    {"class": "car", "box_xyz_lwh_yaw_lidar": [1, 10, 0, 1.8, 4, 1.5, 0]},
    {"class": "pedestrian", "box_xyz_lwh_yaw_lidar": [-1.2, 10, 0, 0.35, 0.35, 1.7, 0]},
    {"class": "pedestrian", "box_xyz_lwh_yaw_lidar": [-1.7, 10, 0, 0.15, 0.15, 1.7, 0]},
    {"class": "car", "box_xyz_lwh_yaw_lidar": [1, 30, 0, 1.8, 4, 1.5, 0]}]})");
  Scene scene;
  const auto say = [&](ObjectClass type, Vec3 center) {
    scene.objects.push_back({.type = type, .center = center, .size = {4.0, 1.8, 1.5}, .confidence = 1.0});
  };
  say(ObjectClass::kCar, {10.0, -1.0, 0.0});      // the car that was hit
  say(ObjectClass::kCar, {30.0, -1.0, 0.0});      // the one that was not: does not count
  say(ObjectClass::kRoadside, {20.0, 9.0, 0.0});  // nobody draws boxes round these
  say(ObjectClass::kCar, {20.0, -9.0, 0.0});      // wrong
  Suite suite;
  suite.judged = {.boundaries = true, .corners = false, .objects = true};
  suite.cells = {{.name = "boxes", .scans = LabelledScans{.folder = folder_, .boxes = true}}};
  suite.columns = {{"f1", "F1"},
                   {"objects_true", "true", 0},
                   {"objects_predicted", "said", 0},
                   {"objects_precision", "precision"},
                   {"objects_recall", "recall"},
                   {"car_f1", "car F1"}};
  const std::atomic<bool> stop{false};
  const RunHooks hooks{[](std::size_t, std::size_t) {}, [](const std::string&) {}};
  const auto results = run(suite, {contestant_of("program", Predictions{{"a", scene}})}, {}, hooks, stop);
  ASSERT_TRUE(results.has_value()) << to_string(results.error());
  EXPECT_EQ(to_text(tables_of(*results).at(0)),
            "case   method   F1  true  said  precision  recall  car F1\n"
            "boxes  program   -     2     2      0.500   0.500   0.667\n");
  const auto worst = worst_scans(*results, 1);
  ASSERT_TRUE(worst.has_value()) << to_string(worst.error());
  EXPECT_THAT(worst->at(0).caption, HasSubstr("scan a, F1 0.500"));
}

TEST_F(Engine, CsvAndJsonSayTheFiguresOfTheTable) {
  const Results results = closed_form(folder_);
  EXPECT_THAT(csv_report(results), HasSubstr("cell,condition,value,method,scans,"));
  EXPECT_THAT(csv_report(results), HasSubstr("\r\na kerb,,,program,1,0,0,21,0,1,0.52381,"));
  EXPECT_THAT(json_report(results, false), HasSubstr("\"recall\": 0.52381"));
  EXPECT_THAT(json_report(results, false), Not(HasSubstr("times")));
  EXPECT_THAT(json_report(results, true), HasSubstr("\"times\""));
}

TEST_F(Engine, TheWorstScansOfADriveAreSeenAgain) {
  const Outcome outcome = run_small(2, std::nullopt);
  const auto pictures = worst_scans(*outcome.results, 1);
  ASSERT_TRUE(pictures.has_value());
  ASSERT_EQ(pictures->size(), 1U);
  EXPECT_EQ(pictures->at(0).png.substr(1, 3), "PNG");
  EXPECT_THAT(pictures->at(0).caption, HasSubstr("gradient: short road, drive "));
  const std::string html = html_report(*outcome.results, {{"Worst scans", "about", *pictures}}, false);
  EXPECT_THAT(html, HasSubstr("A &lt;small&gt; suite"));
  EXPECT_THAT(html, HasSubstr("gradient does not report corners"));
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,iVBOR"));
  EXPECT_THAT(html, HasSubstr("somebody"));
  EXPECT_THAT(html, HasSubstr("Worst scans"));
}

// Paper 1's Fig. 2 and 3 and its lengths over time, of a method that says corners; of others there are none.
TEST(CornerPictures, ShowADrivePastACorner) {
  Suite suite = suite_named("paper1", {.drives = 1, .scans = 120});
  Results results{.suite = suite, .contestants = {contestant_of("gradient")}, .tallies = {}};
  EXPECT_TRUE(corner_pictures(results)->empty());
  results.contestants.push_back(contestant_of("road_width:reading=fixed"));
  const auto pictures = corner_pictures(results);
  ASSERT_TRUE(pictures.has_value());
  ASSERT_EQ(pictures->size(), 5U);
  EXPECT_THAT(pictures->at(1).caption, HasSubstr("entering a corner"));
  EXPECT_THAT(pictures->at(4).caption, HasSubstr("width from scan to scan"));
}

// Paper 2's figures, where line_fit is judged.
TEST(EdgeGalleries, ShowEachFigureOfAScanOfEachCell) {
  Results results{.suite = suite_named("paper2", {.drives = 1, .scans = 2}),
                  .contestants = {contestant_of("gradient")},
                  .tallies = {}};
  EXPECT_TRUE(edge_galleries(results)->empty());
  results.contestants.push_back(contestant_of("line_fit:reading=paper"));
  const auto galleries = edge_galleries(results);
  ASSERT_TRUE(galleries.has_value());
  ASSERT_EQ(galleries->size(), results.suite.cells.size());
  std::string captions;
  for (const Picture& picture : galleries->front().pictures) {
    EXPECT_EQ(picture.png.substr(1, 3), "PNG");
    captions += picture.caption + '\n';
  }
  for (const char* figure : {"Fig. 5, 14:", "Fig. 12:", "Fig. 13:", "Fig. 15a", "Fig. 15b:", "Fig. 15c:",
                             "Fig. 16a:", "Fig. 16b:", "Fig. 17:", "Fig. 18:", "By default:"})
    EXPECT_THAT(captions, HasSubstr(figure));
}

TEST(EdgePictures, LeaveOutWhatAScanHasTooLittleFor) {
  Scan scan;
  scan.mount = Mount{0.5, 0.0, 0.0, 0.0};
  scan.ring_begin = {0};
  const auto pictures = edge_pictures(scan, nullptr);
  ASSERT_TRUE(pictures.has_value());
  EXPECT_EQ(pictures->size(), 10U) << "all but the three rasters";
}

// Paper 3's figures, of the scans that the suite names.
TEST(BoundaryGalleries, ShowAStraightFrameAndACorner) {
  Results results{
      .suite = suite_named("paper3", {}), .contestants = {contestant_of("road_width")}, .tallies = {}};
  EXPECT_TRUE(boundary_galleries(results)->empty()) << "nobody says boundaries";
  results.contestants = {contestant_of("gradient"), contestant_of("gradient:reading=paper"),
                         contestant_of("lda")};
  const auto galleries = boundary_galleries(results);
  ASSERT_TRUE(galleries.has_value());
  std::vector<std::string> figures;
  for (const Gallery& gallery : *galleries) {
    EXPECT_THAT(gallery.about, testing::ContainsRegex("^Scan (straight|corner)-[12]-"));
    for (const Picture& picture : gallery.pictures) {
      EXPECT_EQ(picture.png.substr(1, 3), "PNG");
      figures.push_back(picture.caption.substr(0, picture.caption.find(',')));
    }
  }
  EXPECT_THAT(figures, testing::ElementsAre(
                           "Fig. 2: gradient", "Fig. 2: gradient", "Fig. 6: boundaries by gradient",
                           "Fig. 6: boundaries by gradient:reading=paper", "Fig. 6: boundaries by lda",
                           "Fig. 3: gradient", "Fig. 3: gradient", "Fig. 4: gradient",
                           "Fig. 4: gradient:reading=paper", "Fig. 7: boundaries by gradient",
                           "Fig. 7: boundaries by gradient:reading=paper", "Fig. 7: boundaries by lda"));
}

TEST_F(Engine, ALabelledSetWithoutTheScanHasNoGallery) {
  write(folder_ / "a.pcd.bin", returns_ahead());
  std::filesystem::create_directories(folder_ / "lidarseg");
  Suite suite;
  suite.cells = {{.name = "set", .scans = LabelledScans{folder_}}};
  suite.road_figures = {{.title = "beyond", .cell = "set", .scan = 7},
                        {.title = "of no cell", .cell = "another", .scan = 0}};
  const auto galleries =
      boundary_galleries({.suite = suite, .contestants = {contestant_of("gradient")}, .tallies = {}});
  ASSERT_TRUE(galleries.has_value());
  EXPECT_TRUE(galleries->empty());
}

TEST(Plot, LeavesOutWhatIsNotFiniteAndIsEmptyWithoutAPoint) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Plot plot;
  plot.title = "a < b";
  plot.series = {{"one", {{0.0, kNan}, {1.0, 0.5}, {2.0, 1.0}}}};
  const std::string svg = to_svg(plot, "p");
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, HasSubstr("aria-labelledby=\"p-title p-about\""));
  plot.series = {{"one", {{kNan, 1.0}}}};
  EXPECT_EQ(to_svg(plot, "p"), "");
}

TEST(Plot, WhatIsHighestLiesBelowATick) {
  Plot plot;
  plot.series = {{"one", {{10.0, 0.5}, {20.0, 0.95}}}};
  EXPECT_THAT(to_svg(plot, "p"), HasSubstr(">1</text>"));
}

TEST(Plot, NumbersNamesThatDoNotStandBesideEachOther) {
  Plot plot;
  plot.series = {{"one", {{0.0, 0.5}, {1.0, 1.0}}}};
  plot.x_names = {"near", "far"};
  EXPECT_THAT(to_svg(plot, "p"), HasSubstr(">near</text>"));
  EXPECT_THAT(to_svg(plot, "p"), Not(HasSubstr(">2</text>")));
  plot.x_names = {"near", std::string(60, 'o')};
  EXPECT_THAT(to_svg(plot, "p"), HasSubstr(">2</text>"));
  EXPECT_THAT(to_svg(plot, "p"), HasSubstr(">" + std::string(60, 'o') + "</text>"));  // below
}

TEST(Markup, Base64IsThatOfTheStandard) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
      {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"\xff\xff\xff", "////"}};
  for (const auto& [bytes, text] : cases) EXPECT_EQ(base64(bytes), text);
}

}  // namespace
}  // namespace verge::study
