// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/verge/output.hpp"

#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "verge/core/angle.hpp"
#include "verge/core/version.hpp"
#include "verge/emit/jsonl_writer.hpp"

namespace verge::app {
namespace {

using Json = nlohmann::ordered_json;

/// Ten-thousandths are below what can be measured, and keep the file readable.
double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

Json spread_of(const std::vector<double>& values) {
  return {{"median", rounded(pipeline::percentile(values, 0.5).value_or(0.0))},
          {"p10", rounded(pipeline::percentile(values, 0.1).value_or(0.0))},
          {"p90", rounded(pipeline::percentile(values, 0.9).value_or(0.0))}};
}

Json mount_summary(const std::vector<Mount>& mounts) {
  Json mount;
  const auto add = [&](const char* key, double Mount::*field, bool is_angle) {
    auto values = pipeline::column<Mount>(mounts, field);
    for (double& value : values) value = is_angle ? rad_to_deg(value) : value;
    mount[key] = spread_of(values);
  };
  add("height_m", &Mount::height_m, false);
  add("pitch_deg", &Mount::pitch_rad, true);
  add("roll_deg", &Mount::roll_rad, true);
  add("forward_deg", &Mount::forward_rad, true);
  return mount;
}

/// /dev/stdout names a file where standard output is redirected to one; renaming over that file would cut off
/// whoever else writes to it.
bool is_standard_output(const std::string& target) { return target == "-" || target == "/dev/stdout"; }

Expected<AtomicFile> open_target(const std::string& target) {
  return emit::open_output(is_standard_output(target) ? "-" : target);
}

}  // namespace

Expected<std::unique_ptr<Output>> Output::open(const OutputRequest& request, Provenance provenance) {
  auto output = std::make_unique<Output>();
  output->provenance_ = std::move(provenance);
  auto jsonl = open_target(request.jsonl);
  if (!jsonl) return Unexpected(std::move(jsonl).error());
  if (!jsonl->is_direct()) {
    auto summary = AtomicFile::create(request.jsonl + ".summary.json");
    if (!summary) return Unexpected(std::move(summary).error());
    output->summary_ = *std::move(summary);
  }
  output->jsonl_ = *std::move(jsonl);
  std::optional<emit::GeoOrigin> origin;
  if (request.origin) {
    auto parsed = emit::parse_origin(*request.origin);
    if (!parsed) return Unexpected(std::move(parsed).error());
    origin = *parsed;
  }
  if (!request.geojson) return output;
  auto geojson = emit::GeoJsonWriter::open(*request.geojson, origin);
  if (!geojson) return Unexpected(std::move(geojson).error());
  output->geojson_ = *std::move(geojson);
  return output;
}

Expected<void> Output::write_record(const std::string& record) {
  if (!jsonl_) return {};
  auto written = jsonl_->write(record + '\n').and_then([this] { return jsonl_->flush(); });
  if (written || written.error().code != ErrorCode::kReaderGone || !geojson_) return written;
  jsonl_.reset();
  return {};
}

Expected<void> Output::write(const pipeline::Frame& frame, const std::string& record) {
  const std::scoped_lock lock(mutex_);
  if (finished_) return {};
  if (auto written = write_record(record); !written) return written;
  if (geojson_) {
    if (auto written = geojson_->write(frame.scene, frame.scan.T_world_sensor); !written) return written;
  }
  pipeline::add(counts_, frame.scan, frame.scene);
  return {};
}

void Output::count_damaged() {
  const std::scoped_lock lock(mutex_);
  ++counts_.damaged;
}

pipeline::Counts Output::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

std::string Output::summary(bool interrupted, const std::vector<Mount>& mounts) const {
  const Json scans{
      {"received", counts_.scans + counts_.damaged}, {"used", counts_.scans}, {"damaged", counts_.damaged}};
  const Json points{{"received", counts_.points.received},
                    {"used", counts_.points.used},
                    {"not_finite", counts_.points.not_finite},
                    {"no_return", counts_.points.no_return}};
  Json json{{"schema", 1},
            {"interrupted", interrupted},
            {"scans", scans},
            {"boundaries", counts_.boundaries},
            {"points", points}};
  if (!mounts.empty()) json["mount"] = mount_summary(mounts);
  json["method"] = provenance_.method;
  json["version"] = version();
  json["config_hash"] = provenance_.config_hash;
  return json.dump(2) + '\n';
}

Expected<void> Output::finish(bool interrupted, const std::vector<Mount>& mounts) {
  const std::scoped_lock lock(mutex_);
  if (std::exchange(finished_, true)) return {};
  if (summary_) {
    if (auto written = summary_->write(summary(interrupted, mounts)); !written) return written;
  }
  if (geojson_) {
    if (auto finished = geojson_->finish(); !finished) return finished;
  }
  if (jsonl_) {
    if (auto committed = jsonl_->commit(); !committed) return committed;
  }
  return summary_ ? summary_->commit() : Expected<void>{};
}

}  // namespace verge::app
