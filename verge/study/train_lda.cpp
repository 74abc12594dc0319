// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/study/train_lda.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "verge/core/field_io.hpp"
#include "verge/core/version.hpp"
#include "verge/detect/lda/windows.hpp"
#include "verge/eval/labelled_set.hpp"
#include "verge/eval/nearest.hpp"
#include "verge/fit/discriminant.hpp"
#include "verge/pipeline/stages.hpp"
#include "verge/study/labelled_feed.hpp"
#include "verge/study/parts.hpp"
#include "verge/study/suite.hpp"

namespace verge::study {
namespace {

using detect::lda::Features;
using detect::lda::kFeatures;
using detect::lda::Window;

constexpr std::uint64_t kBeforeFirstDrive = 1'000'000;  // `verge evaluate` allows no more drives
constexpr std::size_t kHoldBack = 5;
constexpr std::size_t kLeastWindows = 500;
constexpr double kShrinkage = 1e-3;
constexpr double kOnEdge_m = 0.06;   // a few centimetres of noise
constexpr double kOffEdge_m = 0.5;   // no return of a window is then on the edge
constexpr double kStepMin_m = 0.03;  // what the labels call an edge and is level is none to find

/// Where the road ends, and where that is not known or there is nothing to see. Sensor frame.
class TrueEdges {
 public:
  TrueEdges(const std::vector<eval::Segment>& edges, const std::vector<eval::Segment>& unknown)
      : edges_(edges, kOffEdge_m), unknown_(unknown, kOnEdge_m) {}

  /// Metres to the nearest edge, infinity beyond half a metre.
  [[nodiscard]] double distance(Vec3 p_sensor) const { return edges_.distance(p_sensor.xy()); }
  [[nodiscard]] bool is_unknown(Vec3 p_sensor) const { return unknown_.distance(p_sensor.xy()) < kOnEdge_m; }

 private:
  eval::NearestSegment edges_;
  eval::NearestSegment unknown_;
};

TrueEdges edges_of(const Scene& truth) {
  std::vector<eval::Segment> kerbs;
  std::vector<eval::Segment> flush;
  for (const Boundary& boundary : truth.boundaries) {
    auto& segments = boundary.kind == BoundaryKind::kCurb ? kerbs : flush;
    for (std::size_t i = 1; i < boundary.points.size(); ++i)
      segments.push_back({boundary.points[i - 1].xy(), boundary.points[i].xy()});
  }
  return {kerbs, flush};
}

/// What is hidden of the truth does not count: it runs from each scan line to the next, across the edges.
TrueEdges edges_of(const eval::LabelledTruth& truth) {
  std::vector<eval::Segment> edges;
  std::vector<eval::Segment> unknown;
  for (const eval::TruePoint& point : truth.points) {
    const bool is_level = point.step_m && *point.step_m < kStepMin_m;
    (is_level ? unknown : edges).push_back({point.place, point.place});
  }
  return {edges, unknown};
}

/// Labelled windows.
struct Samples {
  std::vector<Features> edges;
  std::vector<Features> others;
};

/// Those of one scan line, from the road's axis to where it has crossed the edge; none where it does not.
Samples samples_of(const QuadrantRing& ring, std::span<const Window> windows, const LevelFrame& frame,
                   const TrueEdges& truth) {
  Samples samples;
  for (const Window& window : windows) {
    const Vec3 middle = frame.to_sensor(ring.points[window.middle]);
    const double off = truth.distance(middle);
    const bool on_edge = off <= kOnEdge_m;
    if (!on_edge && !samples.edges.empty()) return samples;
    if (!on_edge && truth.is_unknown(middle)) return {};
    if (on_edge) samples.edges.push_back(window.features);
    if (off > kOffEdge_m) samples.others.push_back(window.features);
  }
  return samples.edges.empty() ? Samples{} : samples;
}

/// Those of one prepared scan.
Samples samples_of(const Scan& scan, const TrueEdges& truth, const detect::LdaConfig& config) {
  const LevelFrame frame(*scan.mount);
  Samples all;
  for (const QuadrantRing& ring : split_quadrants(detect::lda::low_rings(scan, frame, config))) {
    const std::vector<Window> windows = detect::lda::windows_of(ring, scan.mount->height_m, config);
    const Samples more = samples_of(ring, windows, frame, truth);
    all.edges.insert(all.edges.end(), more.edges.begin(), more.edges.end());
    all.others.insert(all.others.end(), more.others.begin(), more.others.end());
  }
  return all;
}

/// Takes scans one after the other, and makes the model of them.
class Trainer {
 public:
  explicit Trainer(const detect::LdaConfig& config) : config_(config) {}

  void begin(std::string source) { sources_.push_back({std::move(source)}); }

  void see(const Scan& scan, const TrueEdges& truth) {
    Samples samples = samples_of(scan, truth, config_);
    if (++seen_ % kHoldBack == 0) {
      std::ranges::move(samples.edges, std::back_inserter(held_.edges));
      std::ranges::move(samples.others, std::back_inserter(held_.others));
      return;
    }
    for (const Features& f : samples.edges) edges_.add(f);
    for (const Features& f : samples.others) others_.add(f);
    LdaSource& source = sources_.back();
    ++source.scans;
    source.edge_windows += samples.edges.size();
    source.other_windows += samples.others.size();
  }

  [[nodiscard]] Expected<LdaModel> model() const {
    const auto trained = std::min(edges_.count(), others_.count()) < kLeastWindows
                             ? std::nullopt
                             : fit::fit_discriminant(edges_, others_, kShrinkage);
    if (!trained) return Unexpected(too_few());
    LdaModel model{.config = config_, .sources = sources_};
    for (std::size_t k = 0; k < kFeatures; ++k)
      model.config.*detect::lda::kFeatureNames[k].value = trained->weights[k];
    model.config.threshold = trained->threshold;
    model.held_edges = held_.edges.size();
    model.held_others = held_.others.size();
    model.found_share = share_of_edges(held_.edges, model.config);
    model.false_share = share_of_edges(held_.others, model.config);
    return model;
  }

 private:
  [[nodiscard]] Error too_few() const {
    return {ErrorCode::kUnusable,
            "train lda",
            {},
            "too few labelled windows",
            fmt::format("{} of an edge, {} others", edges_.count(), others_.count()),
            fmt::format(">= {} of each", kLeastWindows)};
  }

  /// How many are taken for edges.
  [[nodiscard]] static double share_of_edges(const std::vector<Features>& samples,
                                             const detect::LdaConfig& config) {
    if (samples.empty()) return 0.0;
    const auto taken = std::ranges::count_if(
        samples, [&](const Features& f) { return detect::lda::discriminant(f, config) > 0.0; });
    return static_cast<double>(taken) / static_cast<double>(samples.size());
  }

  detect::LdaConfig config_;
  std::vector<LdaSource> sources_;
  fit::Moments edges_{kFeatures};
  fit::Moments others_{kFeatures};
  Samples held_;
  std::size_t seen_ = 0;
};

/// A labelled folder, looked through before the first scan is read.
struct LabelledFolder {
  std::filesystem::path folder;
  std::vector<eval::LabelledScan> known;
};

Expected<std::vector<LabelledFolder>> folders_of(const std::vector<std::filesystem::path>& data) {
  std::vector<LabelledFolder> folders;
  for (const std::filesystem::path& folder : data) {
    auto known = eval::find_labelled_scans(folder);
    if (!known) return Unexpected(std::move(known).error());
    folders.push_back({folder, *std::move(known)});
  }
  return folders;
}

/// One training from its first scan to its last.
class Training {
 public:
  Training(const LdaTraining& training, const LdaTrainingHooks& hooks, std::vector<LabelledFolder> folders)
      : training_(training),
        hooks_(hooks),
        folders_(std::move(folders)),
        trainer_(training.config),
        total_(training.drives * training.scans) {
    for (const LabelledFolder& folder : folders_) total_ += folder.known.size();
  }

  [[nodiscard]] Expected<std::optional<LdaModel>> run() {
    for (std::uint64_t drive = 1; drive <= training_.drives; ++drive) see_drive(kBeforeFirstDrive + drive);
    for (const LabelledFolder& folder : folders_) {
      if (auto seen = see_folder(folder); !seen) return Unexpected(std::move(seen).error());
    }
    if (hooks_.stop.load()) return std::optional<LdaModel>();
    auto model = trainer_.model();
    if (!model) return Unexpected(std::move(model).error());
    return std::optional(*std::move(model));
  }

 private:
  void see_drive(std::uint64_t drive) {
    if (hooks_.stop.load()) return;
    const sim::Drive world(drives_.make(drive));
    trainer_.begin(fmt::format("made-up drive {} of suite paper3, every {}th scan", drive, drives_.step));
    for (std::size_t i = 0; i < training_.scans && !hooks_.stop.load(); ++i) {
      sim::Simulated simulated = simulated_of(drives_, world, drive, drives_.first_scan + i * drives_.step);
      pipeline::Frame frame;
      frame.scan = std::move(simulated.scan);
      pipeline::prepare(frame, {});
      see(frame.scan, edges_of(simulated.truth));
    }
  }

  [[nodiscard]] Expected<void> see_folder(const LabelledFolder& set) {
    trainer_.begin(set.folder.string());
    LabelledFeed feed(scan_folders(set.known), hooks_.warning);
    while (!hooks_.stop.load()) {
      const auto frame = feed.next();
      if (!frame) return Unexpected(frame.error());
      if (!*frame) break;
      const auto labelled =
          std::ranges::find(set.known, eval::frame_stem((*frame)->scan.frame), &eval::LabelledScan::frame);
      if (labelled == set.known.end()) continue;
      const auto truth = eval::read_labelled_truth(*labelled, kLabelGap_m);
      if (!truth) return Unexpected(truth.error());
      see((*frame)->scan, edges_of(*truth));
    }
    return {};
  }

  void see(const Scan& scan, const TrueEdges& truth) {
    trainer_.see(scan, truth);
    hooks_.progress(++done_, total_);
  }

  static MadeDrives frames_of_paper3() {
    return std::get<MadeDrives>(suite_named("paper3", {}).cells.front().scans);
  }

  const LdaTraining& training_;
  const LdaTrainingHooks& hooks_;
  std::vector<LabelledFolder> folders_;
  MadeDrives drives_ = frames_of_paper3();
  Trainer trainer_;
  std::size_t total_;
  std::size_t done_ = 0;
};

/// The command that makes the model again.
std::string command_of(const LdaTraining& training) {
  std::string command =
      fmt::format("verge train lda --drives {} --scans {}", training.drives, training.scans);
  for (const std::filesystem::path& folder : training.data)
    command += fmt::format(" --data {}", escape_control_bytes(folder.string()));
  const auto usual = field_rows(detect::LdaConfig{});
  const auto rows = field_rows(training.config);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].value != usual[i].value)
      command += fmt::format(" --set lda.{}={}", rows[i].info.name, rows[i].value);
  }
  return command;
}

}  // namespace

Expected<std::optional<LdaModel>> train_lda(const LdaTraining& training, const LdaTrainingHooks& hooks) {
  auto folders = folders_of(training.data);
  if (!folders) return Unexpected(std::move(folders).error());
  return Training(training, hooks, *std::move(folders)).run();
}

std::string model_file(const LdaTraining& training, const LdaModel& model) {
  std::string text = fmt::format(
      "# The linear discriminant of method lda (a reconstruction; see docs/methods.md), made by verge {}:\n"
      "#   {}\n# A file of settings: verge detect SCANS --config FILE\n#\n# Features of a window of {} "
      "returns:\n",
      version(), command_of(training), model.config.window);
  for (const detect::lda::FeatureName& feature : detect::lda::kFeatureNames)
    text += fmt::format("#   {:18}  {}\n", feature.weight, feature.meaning);
  text += fmt::format("#\n# {:>5}  {:>12}  {:>13}  trained on\n", "scans", "edge windows", "other windows");
  for (const LdaSource& source : model.sources) {
    text += fmt::format("# {:5}  {:12}  {:13}  {}\n", source.scans, source.edge_windows, source.other_windows,
                        escape_control_bytes(source.name));
  }
  text += fmt::format(
      "#\n# Of every fifth scan, held back: {:.4f} of {} edge windows found, {:.4f} of {} others taken for "
      "one.\n\nmethod = \"lda\"\n\n",
      model.found_share, model.held_edges, model.false_share, model.held_others);
  return text + to_toml("lda", field_rows(model.config));
}

}  // namespace verge::study
