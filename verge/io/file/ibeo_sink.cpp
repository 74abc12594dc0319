// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ibeo_sink.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/io/file/wire_points.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/wire_scan.hpp"

namespace verge::io {
namespace {

namespace ibeo = sensor::ibeo;
namespace fs = std::filesystem;

std::string_view text_of(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

Error cannot_write(const fs::path& path, std::string what, std::string got, std::string need) {
  return {ErrorCode::kCannotWrite, path.string(), {}, std::move(what), std::move(got), std::move(need)};
}

void add(ibeo::EncodedPoints& all, const ibeo::EncodedPoints& more) {
  all.points += more.points;
  all.encoded += more.encoded;
  all.not_on_wire += more.not_on_wire;
  all.altered += more.altered;
}

/// What the messages of both sensors have in common.
class MessageSink : public Sink {
 public:
  MessageSink(fs::path path, AtomicFile file, Log log)
      : path_(std::move(path)), file_(std::move(file)), log_(std::move(log)) {}

 protected:
  [[nodiscard]] Expected<void> append(Bytes message) { return file_.write(text_of(message)); }
  [[nodiscard]] Expected<void> count(const ibeo::EncodedPoints& points, std::size_t most) {
    add(points_, points);
    ++scans_;
    if (points.encoded <= most) return {};
    return Unexpected(cannot_write(path_, "a scan of this sensor does not hold so many points",
                                   fmt::format("{}", points.encoded), fmt::format("<= {}", most)));
  }
  [[nodiscard]] Expected<void> commit() {
    if (points_.not_on_wire > 0 || points_.altered > 0) {
      warn(log_,
           fmt::format("{}: {} of {} points are left out, which the sensor cannot have seen so; {} more "
                       "have a pulse width or flags that its messages cannot say",
                       path_.string(), points_.not_on_wire, points_.points, points_.altered));
    }
    return file_.commit();
  }
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] std::uint64_t scans() const { return scans_; }

 private:
  fs::path path_;
  AtomicFile file_;
  Log log_;
  ibeo::EncodedPoints points_;
  std::uint64_t scans_ = 0;
};

class IdcSink final : public MessageSink {
 public:
  IdcSink(fs::path path, AtomicFile file, Log log, ibeo::LuxModel model)
      : MessageSink(std::move(path), std::move(file), std::move(log)), model_(std::move(model)) {}

  [[nodiscard]] Expected<void> write(const Scan& scan) override {
    constexpr std::int64_t kLastNs = 2'085'978'495'000'000'000;  // 2036-02-07, when NTP's seconds end
    constexpr std::size_t kMostPoints = 65'535;
    if (scan.stamp_ns && (*scan.stamp_ns < 0 || *scan.stamp_ns > kLastNs)) {
      return Unexpected(cannot_write(path(), "an ibeo message cannot say the time of the scan",
                                     fmt::format("{} ns", *scan.stamp_ns),
                                     fmt::format("0 to {} ns", kLastNs)));
    }
    const std::int64_t since_power_on_ns = 80'000'000 * static_cast<std::int64_t>(scans());
    ibeo::WireLuxScan wire = ibeo::scan_of(wire_points(scan), scan.stamp_ns, model_, since_power_on_ns);
    wire.scan.number = static_cast<std::uint16_t>(scans());
    if (auto counted = count(wire.counts, kMostPoints); !counted) return counted;
    return append(
        writer_.add({.type = ibeo::kScanType, .ntp = wire.scan.start_ntp}, ibeo::encode_scan(wire.scan)));
  }
  [[nodiscard]] Expected<void> finish() override {
    if (auto closed = append(writer_.close()); !closed) return closed;
    return commit();
  }

 private:
  ibeo::LuxModel model_;
  ibeo::IdcWriter writer_;
};

class AlascaSink final : public MessageSink {
 public:
  using MessageSink::MessageSink;

  [[nodiscard]] Expected<void> write(const Scan& scan) override {
    constexpr std::int64_t kMillisecondNs = 1'000'000;
    const auto time_ms =
        static_cast<std::uint32_t>(times_.of(scan) / kMillisecondNs);  // wraps, as the sensor's
    ibeo::WireAlascaScan wire = ibeo::scan_of(wire_points(scan), model_);
    wire.scan.number = static_cast<std::uint16_t>(scans());
    wire.scan.time = time_ms;
    if (auto counted = count(wire.counts, ibeo::kAlascaPointsMost); !counted) return counted;
    return append(ibeo::encode_alasca_message({.type = ibeo::kAlascaScanType, .time_ms = time_ms},
                                              ibeo::encode_alasca_scan(wire.scan)));
  }
  [[nodiscard]] Expected<void> finish() override { return commit(); }

 private:
  ibeo::AlascaModel model_ = ibeo::alasca_xt();
  ScanTimes times_;
};

Expected<void> check_model(const fs::path& path, const SinkOptions& options,
                           std::initializer_list<std::string_view> models) {
  const bool known =
      !options.model || std::find(models.begin(), models.end(), *options.model) != models.end();
  if (known) return {};
  return Unexpected({ErrorCode::kUsage,
                     path.string(),
                     {},
                     "no such model of this format",
                     *options.model,
                     fmt::format("{}", fmt::join(models, " or "))});
}

}  // namespace

Expected<std::unique_ptr<Sink>> create_idc_sink(const fs::path& path, const SinkOptions& options) {
  if (auto checked = check_model(path, options, {"lux", "ldmrs"}); !checked)
    return Unexpected(std::move(checked).error());
  auto model = lux_with_layers(options.calibration);
  if (!model) return Unexpected(std::move(model).error());
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(std::move(file).error());
  return std::make_unique<IdcSink>(path, *std::move(file), options.log, *std::move(model));
}

Expected<std::unique_ptr<Sink>> create_alasca_sink(const fs::path& path, const SinkOptions& options) {
  if (auto checked = check_model(path, options, {"alasca_xt"}); !checked)
    return Unexpected(std::move(checked).error());
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(std::move(file).error());
  return std::make_unique<AlascaSink>(path, *std::move(file), options.log);
}

}  // namespace verge::io
