// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/velodyne_scans.hpp"

#include <utility>

#include <fmt/core.h>

#include "verge/io/input.hpp"
#include "verge/sensor/velodyne/calibration.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::io {
namespace {

namespace velodyne = sensor::velodyne;

Error usage(const std::string& name, std::string what, std::string got, std::string need) {
  return {ErrorCode::kUsage, name, {}, std::move(what), std::move(got), std::move(need)};
}

}  // namespace

Expected<velodyne::Calibration> read_calibration_file(const std::filesystem::path& path, std::size_t lasers) {
  constexpr std::uint64_t kMost = (1ULL << 20U) + 1;  // what read_calibration() refuses
  auto file = Input::open(path, {});
  if (!file) return Unexpected(std::move(file).error());
  const auto bytes = file->head(kMost);
  if (!bytes) return Unexpected(bytes.error());
  return velodyne::read_calibration(*bytes, path.string(), lasers);
}

Expected<velodyne::Model> velodyne_model(const std::string& model, const std::string& name) {
  const auto known = velodyne::model_named(model);
  if (known) return *known;
  return Unexpected(usage(name, "no such Velodyne model", model, std::string(kVelodyneModels)));
}

Expected<VelodyneScans> VelodyneScans::create(const RecordingOptions& options, const std::string& name,
                                              std::optional<velodyne::Model> seen) {
  velodyne::DecoderConfig config;
  if (options.model) {
    auto model = velodyne_model(*options.model, name);
    if (!model) return Unexpected(std::move(model).error());
    config.model = *model;
  }
  if (options.calibration) {
    const auto model = config.model ? config.model : seen;
    if (!model) return Unexpected(usage(name, "a calibration needs its model, choose --model", {}, {}));
    auto calibration = read_calibration_file(*options.calibration, velodyne::facts_of(*model).lasers);
    if (!calibration) return Unexpected(std::move(calibration).error());
    config.calibration = *std::move(calibration);
  }
  return VelodyneScans(std::move(config));
}

std::optional<Decoded> VelodyneScans::decoded(std::optional<velodyne::Revolution> revolution) const {
  constexpr double kComplete = 0.98;
  if (!revolution) return std::nullopt;
  Decoded out;
  out.cloud = std::move(revolution->cloud);
  out.stamp_ns = revolution->stamp_ns;
  if (revolution->completeness < kComplete)
    out.notes.push_back(fmt::format("revolution is {:.0f} % complete", 100.0 * revolution->completeness));
  if (revolution->stalled) out.notes.emplace_back("the head stands still");
  const auto model = decoder_.model();
  if (model) out.sensor = enum_names<velodyne::Model>[static_cast<std::size_t>(*model)];
  if (!own_angles_ && model && velodyne::facts_of(*model).banks == 2) {
    out.notes.emplace_back(
        "no calibration given: the usual angles and offsets of the model, which are off by up to 1 degree "
        "and "
        "0.3 m");
  }
  return out;
}

std::optional<Decoded> VelodyneScans::take() { return decoded(decoder_.take()); }
std::optional<Decoded> VelodyneScans::finish() { return decoded(decoder_.finish()); }

std::vector<Counter> VelodyneScans::counters() const {
  const velodyne::Counters& c = decoder_.counters();
  const velodyne::PointCounters& p = c.points;
  return {{"packets received", c.packets},
          {"packets used", c.data},
          {"packets of position", c.positions},
          {"packets of another size", c.rejected_size},
          {"packets of another model", c.rejected_model},
          {"packets sent twice", c.duplicates},
          {"packets too late", c.late},
          {"blocks received", c.blocks},
          {"blocks used", c.blocks_used},
          {"blocks of an unknown flag", c.rejected_flag},
          {"blocks beyond 360 degrees", c.rejected_azimuth},
          {"blocks out of turn", c.rejected_turn},
          {"measurements received", p.measured},
          {"measurements used", p.used},
          {"measurements without return", p.no_return},
          {"measurements too near", p.below_min},
          {"measurements too far", p.above_max},
          {"measurements of the same echo", p.same_echo}};
}

}  // namespace verge::io
