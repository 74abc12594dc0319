// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/velodyne_scans.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "verge/io/file/calibration_file.hpp"
#include "verge/sensor/velodyne/facts.hpp"

namespace verge::io {
namespace {

namespace velodyne = sensor::velodyne;

Error usage(const std::string& name, std::string what, std::string got, std::string need) {
  return {ErrorCode::kUsage, name, {}, std::move(what), std::move(got), std::move(need)};
}

}  // namespace

Expected<velodyne::Model> velodyne_model(const std::string& model, const std::string& name) {
  const auto known = velodyne::model_named(model);
  if (known) return *known;
  return Unexpected(usage(name, "no such Velodyne model", model, std::string(kVelodyneModels)));
}

void ModelVote::add(Bytes payload) {
  if (payload.size() != velodyne::kDataBytes) return;
  if (const auto model = velodyne::model_of(payload)) ++packets_[*model];
}

std::optional<velodyne::Model> ModelVote::winner() const {
  const auto most = std::max_element(packets_.begin(), packets_.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == packets_.end()) return std::nullopt;
  return most->first;
}

Expected<VelodyneScans> VelodyneScans::create(const RecordingOptions& options, const std::string& name,
                                              std::optional<velodyne::Model> seen) {
  velodyne::DecoderConfig config;
  config.model = seen;
  if (options.model) {
    auto model = velodyne_model(*options.model, name);
    if (!model) return Unexpected(std::move(model).error());
    config.model = *model;
  }
  if (options.calibration) {
    if (!config.model)
      return Unexpected(usage(name, "a calibration needs its model, choose --model", {}, {}));
    auto calibration = read_calibration_file(*options.calibration, velodyne::facts_of(*config.model).lasers);
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
          {"measurements of the same echo", p.same_echo},
          {"stamps received", c.stamps},
          {"stamps used", c.stamps - c.stamps_estimated},
          {"stamps estimated", c.stamps_estimated},
          {"sentences received", c.positions},
          {"sentences used", c.nmea_used},
          {"sentences of a receiver that guesses", c.nmea_unlocked},
          {"sentences that are not there", c.nmea_absent},
          {"sentences without a time", c.nmea_ignored},
          {"sentences 1024 weeks old", c.nmea_rolled_over}};
}

std::optional<Error> VelodyneScans::fault() const {
  const velodyne::Counters& c = decoder_.counters();
  const std::string share = fmt::format("{} of {} packets", c.rejected_model, c.packets);
  if (c.packets == 0) return std::nullopt;
  if (c.data == 0) {
    return Error{
        ErrorCode::kUnusable, {}, {}, "no data packet can be decoded", share + " are of another model", {}};
  }
  if (c.rejected_model == 0) return std::nullopt;
  const auto model = static_cast<std::size_t>(*decoder_.model());
  return Error{ErrorCode::kDamaged,
               {},
               {},
               "packets of another model are left out",
               share,
               std::string(enum_names<velodyne::Model>[model])};
}

std::vector<std::string> VelodyneScans::oddities() const {
  const velodyne::Counters& c = decoder_.counters();
  std::vector<std::string> all;
  add_oddity(all, c.rejected_size, "packets are neither 1206 nor 512 bytes long");
  add_oddity(all, c.late, "packets came too late to be used");
  add_oddity(all, c.rejected_flag, "blocks have a flag that the model does not have");
  add_oddity(all, c.rejected_azimuth, "blocks lie beyond 360 degrees");
  add_oddity(all, c.rejected_turn, "blocks are out of turn");
  add_oddity(all, c.stalled, "scans ended by time: the head stands still");
  add_oddity(all, c.stamps_estimated, "stamps are of no use and were estimated");
  add_oddity(all, c.clock_jumps, "times the sensor's clock was set");
  add_oddity(all, c.hour_ambiguous, "stamps are half an hour off the host's clock: the hour may be wrong");
  add_oddity(all, c.hour_disputed, "GPS sentences say another hour than the one in use");
  add_oddity(all, c.nmea_rolled_over, "GPS sentences are 1024 weeks old: the receiver's counter rolled over");
  return all;
}

void add_oddity(std::vector<std::string>& all, std::uint64_t count, std::string_view what) {
  if (count > 0) all.push_back(fmt::format("{} {}", count, what));
}

void warn_of(const std::vector<std::string>& oddities, const std::string& file, const Log& log) {
  if (!oddities.empty()) warn(log, fmt::format("{}: {}", file, fmt::join(oddities, "; ")));
}

}  // namespace verge::io
