// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/labelled_part.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "verge/eval/label_score.hpp"
#include "verge/eval/label_success.hpp"
#include "verge/pipeline/stages.hpp"
#include "verge/study/box_score.hpp"
#include "verge/study/labelled_feed.hpp"

namespace verge::study {
namespace fs = std::filesystem;
namespace {

constexpr double kPoorAt_m = 0.3;

double seconds_to_detect(pipeline::Frame& frame, detect::Detector& detector, const Contestant& contestant) {
  const auto begin = std::chrono::steady_clock::now();
  pipeline::detect_on(frame, detector,
                      {.mount_hint = {}, .mount_config = {}, .method = contestant.name, .config_hash = {}});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What a method finds on a set, by frame; none where it was stopped. Times and damage go into the tally.
Expected<std::optional<Predictions>> predict(std::span<const eval::LabelledScan> known,
                                             const Contestant& contestant, const PartHooks& hooks,
                                             Tally& tally) {
  const auto detector = detector_of(contestant);
  LabelledFeed feed(scan_folders(known), hooks.warning);
  Predictions predictions;
  while (true) {
    if (hooks.stop.load()) return std::optional<Predictions>();
    auto frame = feed.next();
    if (!frame) return Unexpected(std::move(frame).error());
    if (!*frame) break;
    const double detect_s = seconds_to_detect(**frame, *detector, contestant);
    tally.seconds.add((*frame)->times.mount_s + detect_s);
    predictions.insert_or_assign(eval::frame_stem((*frame)->scan.frame), std::move((*frame)->scene));
    hooks.scan_done();
  }
  tally.damaged = feed.damaged();
  return predictions;
}

double f1_of(const eval::LabelScore& score) {
  const auto at = std::ranges::find(score.at, kPoorAt_m, &eval::ToleranceScore::tolerance_m);
  return at == score.at.end() ? 0.0 : eval::figures_of(score, *at).f1;
}

/// Adds what the labels of the scans say of the predictions.
Expected<void> add_scores(const LabelledScans& set, std::span<const eval::LabelledScan> known,
                          const Predictions& predictions, Tally& tally) {
  for (std::size_t i = set.odd_only ? 1 : 0; i < known.size(); i += set.odd_only ? 2 : 1) {
    if (i < set.first || i > set.last) continue;
    const auto truth = eval::read_labelled_truth(known[i], kLabelGap_m);
    if (!truth) return Unexpected(truth.error());
    const auto found = predictions.find(known[i].frame);
    const Scene* prediction = found == predictions.end() ? nullptr : &found->second;
    const eval::LabelScore score = eval::score(*truth, prediction, {});
    tally.labels += score;
    if (const auto deviation = eval::deviation_of(*truth, prediction)) tally.labelled.count(*deviation);
    ++tally.scans;
    tally.absent += score.absent;
    if (!known[i].scan.empty()) note_poorest(tally, {f1_of(score), 0, i, known[i].frame});
  }
  return {};
}

/// A prepared scan, read on its own. Fails as io::open() and where there is none in the file.
Expected<pipeline::Frame> frame_of(const fs::path& file) {
  LabelledFeed feed({file}, [](const std::string&) {});
  auto frame = feed.next();
  if (!frame) return Unexpected(std::move(frame).error());
  if (!*frame)
    return Unexpected(Error{ErrorCode::kUnusable, file.string(), {}, "has no scan that can be read", {}, {}});
  return **std::move(frame);
}

double f1_of(const eval::ObjectScore& score) {
  const auto all = static_cast<double>(score.predicted + score.truth);
  return all > 0.0 ? 2.0 * static_cast<double>(score.matched) / all : 1.0;
}

/// Adds how the objects were found that boxes are drawn round.
Expected<void> add_box_scores(std::span<const eval::LabelledScan> known, const Predictions& predictions,
                              Tally& tally) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    auto truth = eval::read_labelled_truth(known[i], kLabelGap_m);
    if (!truth) return Unexpected(std::move(truth).error());
    const auto frame = frame_of(known[i].scan);
    if (!frame) return Unexpected(frame.error());
    const auto found = predictions.find(known[i].frame);
    const bool is_absent = found == predictions.end();
    const eval::ObjectScore score =
        score_boxes(is_absent ? Scene{} : found->second, boxed_truth(std::move(truth->objects), frame->scan));
    tally.objects += score;
    ++tally.scans;
    tally.absent += is_absent ? 1U : 0U;
    note_poorest(tally, {f1_of(score), 0, i, known[i].frame});
  }
  return {};
}

/// What the labels say: boxes, or boundaries on the road below the sensor.
Scene scene_of(const eval::LabelledTruth& truth, bool boxes, const Scan& scan) {
  if (boxes) return boxed_truth(truth.objects, scan);
  const double height_m = scan.mount ? -scan.mount->height_m : 0.0;
  Scene scene;
  scene.frame = truth.frame;
  for (const eval::Segment& segment : truth.segments) {
    Boundary boundary;
    boundary.points = {{segment.a.x, segment.a.y, height_m}, {segment.b.x, segment.b.y, height_m}};
    scene.boundaries.push_back(std::move(boundary));
  }
  return scene;
}

}  // namespace

Expected<std::vector<eval::LabelledScan>> known_scans(const LabelledScans& set) {
  return set.boxes ? eval::find_boxed_scans(set.folder) : eval::find_labelled_scans(set.folder);
}

Expected<std::optional<Tally>> judge_labelled(const LabelledScans& set,
                                              std::span<const eval::LabelledScan> known,
                                              const Contestant& contestant, const PartHooks& hooks) {
  Tally tally;
  std::optional<Predictions> found;
  if (!contestant.predictions) {
    auto predicted = predict(known, contestant, hooks, tally);
    if (!predicted) return Unexpected(std::move(predicted).error());
    if (!*predicted) return std::optional<Tally>();
    found = *std::move(predicted);
  }
  const Predictions& predictions = contestant.predictions ? *contestant.predictions : *found;
  const auto added =
      set.boxes ? add_box_scores(known, predictions, tally) : add_scores(set, known, predictions, tally);
  if (!added) return Unexpected(added.error());
  return tally;
}

Expected<Seen> see_labelled_again(const LabelledScans& set, const ScanScore& wanted,
                                  const Contestant& contestant) {
  const auto known = known_scans(set);
  if (!known) return Unexpected(known.error());
  const auto truth = eval::read_labelled_truth(known->at(wanted.scan), kLabelGap_m);
  if (!truth) return Unexpected(truth.error());
  const auto detector = contestant.predictions ? nullptr : detector_of(contestant);
  LabelledFeed feed(scan_folders(*known), [](const std::string&) {});
  while (true) {
    auto frame = feed.next();
    if (!frame) return Unexpected(std::move(frame).error());
    if (!*frame) break;
    const bool wanted_here = eval::frame_stem((*frame)->scan.frame) == wanted.frame;
    if (detector && (wanted_here || detector->order() == detect::Order::kSequential))
      (void)seconds_to_detect(**frame, *detector, contestant);
    if (!wanted_here) continue;
    if (contestant.predictions && contestant.predictions->contains(wanted.frame))
      (*frame)->scene = contestant.predictions->find(wanted.frame)->second;
    Scene true_scene = scene_of(*truth, set.boxes, (*frame)->scan);
    return Seen{**std::move(frame), std::move(true_scene)};
  }
  return Unexpected(
      Error{ErrorCode::kUnusable, set.folder.string(), {}, "the scan is gone", wanted.frame, {}});
}

}  // namespace verge::study
