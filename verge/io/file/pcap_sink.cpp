// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcap_sink.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/core/atomic_file.hpp"
#include "verge/io/file/calibration_file.hpp"
#include "verge/io/file/pcap.hpp"
#include "verge/io/file/velodyne_scans.hpp"
#include "verge/io/file/wire_points.hpp"
#include "verge/sensor/velodyne/encoder.hpp"
#include "verge/sensor/velodyne/position.hpp"
#include "verge/sensor/velodyne/wire_cloud.hpp"

namespace verge::io {
namespace {

namespace velodyne = sensor::velodyne;

constexpr double kUsualRateHz = 10.0;
constexpr std::uint16_t kPositionPort = 8308;

/// Intensities to the wire's 0 to 255 where they are remissions from 0 to 1.
void scale_intensities(std::vector<float>& intensities) {
  const bool remissions = std::all_of(intensities.begin(), intensities.end(),
                                      [](float value) { return value >= 0.0F && value <= 1.0F; }) &&
                          std::any_of(intensities.begin(), intensities.end(),
                                      [](float value) { return value != std::floor(value); });
  if (!remissions) return;
  for (float& value : intensities) value *= 255.0F;
}

class PcapSink final : public Sink {
 public:
  PcapSink(std::filesystem::path path, SinkOptions options, PcapWriter writer)
      : path_(std::move(path)), options_(std::move(options)), writer_(std::move(writer)) {}

  [[nodiscard]] Expected<void> write(const Scan& scan) override;
  [[nodiscard]] Expected<void> finish() override;

 private:
  [[nodiscard]] Expected<void> choose_model(const Scan& scan);
  [[nodiscard]] Expected<void> encode_held(std::optional<std::int64_t> next_ns);
  [[nodiscard]] Expected<void> send(const std::vector<velodyne::SentPacket>& packets);
  [[nodiscard]] Expected<void> send_position(std::int64_t time_ns);
  void tell_what_is_left_out() const;

  /// A scan whose points have no times waits for the next one, which tells how fast the head turned.
  struct Held {
    Cloud cloud;
    std::int64_t time_ns = 0;
  };

  std::filesystem::path path_;
  SinkOptions options_;
  PcapWriter writer_;
  const velodyne::Facts* facts_ = nullptr;
  velodyne::Calibration calibration_;
  std::optional<velodyne::Encoder> encoder_;
  ScanTimes times_;
  std::optional<Held> held_;
  std::int64_t next_position_ns_ = 0;
};

Expected<void> PcapSink::choose_model(const Scan& scan) {
  const bool own = velodyne::model_named(scan.sensor).has_value();
  if (!options_.model && !own) {
    return Unexpected({ErrorCode::kUsage,
                       path_.string(),
                       {},
                       "the scans do not say of which sensor the packets shall be",
                       scan.sensor,
                       fmt::format("--model {}", kVelodyneModels)});
  }
  auto model = velodyne_model(options_.model.value_or(scan.sensor), path_.string());
  if (!model) return Unexpected(std::move(model).error());
  facts_ = &velodyne::facts_of(*model);
  calibration_ = facts_->calibration;
  if (options_.calibration) {
    auto calibration = read_calibration_file(*options_.calibration, facts_->lasers);
    if (!calibration) return Unexpected(std::move(calibration).error());
    calibration_ = *std::move(calibration);
  }
  encoder_.emplace(*model, calibration_);
  return {};
}

Expected<void> PcapSink::write(const Scan& scan) {
  constexpr std::int64_t kLastNs = std::numeric_limits<std::uint32_t>::max() * std::int64_t{1'000'000'000};
  if (!encoder_) {
    if (auto chosen = choose_model(scan); !chosen) return chosen;
  }
  const std::int64_t time_ns = times_.of(scan);
  if (time_ns < 0 || time_ns > kLastNs) {
    return Unexpected({ErrorCode::kCannotWrite,
                       path_.string(),
                       {},
                       "a capture cannot say the time of the scan",
                       fmt::format("{} ns", time_ns),
                       fmt::format("0 to {} ns", kLastNs)});
  }
  if (auto encoded = encode_held(time_ns); !encoded) return encoded;
  held_ = {wire_points(scan), time_ns};
  scale_intensities(held_->cloud.intensity);
  velodyne::set_rings_of_model(held_->cloud, *facts_, calibration_);
  return held_->cloud.time_s.empty() ? Expected<void>{} : encode_held({});
}

Expected<void> PcapSink::encode_held(std::optional<std::int64_t> next_ns) {
  constexpr double kSlowestHz = 5.0;
  constexpr double kFastestHz = 20.0;
  if (!held_) return {};
  const Held held = *std::exchange(held_, std::nullopt);
  Cloud cloud = held.cloud;
  if (cloud.time_s.empty()) {
    const double rate_hz =
        next_ns && *next_ns > held.time_ns ? 1e9 / static_cast<double>(*next_ns - held.time_ns) : 0.0;
    const bool turns_so = rate_hz > 0.99 * kSlowestHz && rate_hz < 1.01 * kFastestHz;
    velodyne::set_times_by_azimuth(cloud, *facts_, calibration_, turns_so ? rate_hz : kUsualRateHz);
  }
  encoder_->add(cloud, held.time_ns);
  return send(encoder_->take());
}

Expected<void> PcapSink::send(const std::vector<velodyne::SentPacket>& packets) {
  for (const velodyne::SentPacket& packet : packets) {
    // A packet begins before its first return: at the very begin of time that would be no time.
    const std::int64_t time_ns = std::max<std::int64_t>(0, packet.time_ns);
    if (auto sent = send_position(time_ns); !sent) return sent;
    if (auto written = writer_.write(packet.bytes, time_ns); !written) return written;
  }
  return {};
}

Expected<void> PcapSink::send_position(std::int64_t time_ns) {
  constexpr std::int64_t kEveryNs = 100'000'000;
  constexpr std::int64_t kFirstYearNs = 315'532'800'000'000'000;   // 1980
  constexpr std::int64_t kLastYearNs = 3'471'292'800'000'000'000;  // 2080
  const bool can_be_said = time_ns >= kFirstYearNs && time_ns < kLastYearNs;
  if (!options_.position_packets || !can_be_said || time_ns < next_position_ns_) return {};
  next_position_ns_ = time_ns + kEveryNs;
  PcapWriter::Route route;
  route.port = kPositionPort;
  return writer_.write(velodyne::locked_position(time_ns), time_ns, route);
}

void PcapSink::tell_what_is_left_out() const {
  const velodyne::EncodedPoints& points = encoder_->counters();
  if (points.encoded == points.points) return;
  warn(options_.log,
       fmt::format("{}: {} of {} points are left out: {} that a {} cannot have seen so, {} whose shot has a "
                   "nearer one",
                   path_.string(), points.points - points.encoded, points.points, points.not_on_wire,
                   enum_names<velodyne::Model>[static_cast<std::size_t>(facts_->model)], points.displaced));
}

Expected<void> PcapSink::finish() {
  if (auto encoded = encode_held({}); !encoded) return encoded;
  if (encoder_) {
    if (auto sent = send(encoder_->finish()); !sent) return sent;
    tell_what_is_left_out();
  }
  return writer_.commit();
}

}  // namespace

Expected<std::unique_ptr<Sink>> create_pcap_sink(const std::filesystem::path& path,
                                                 const SinkOptions& options) {
  if (path.extension() == ".pcapng") {
    return Unexpected({ErrorCode::kUsage, path.string(), {}, "pcapng is read but not written", {}, ".pcap"});
  }
  auto file = AtomicFile::create(path);
  if (!file) return Unexpected(std::move(file).error());
  auto writer = PcapWriter::create(*std::move(file));
  if (!writer) return Unexpected(std::move(writer).error());
  return std::make_unique<PcapSink>(path, options, *std::move(writer));
}

}  // namespace verge::io
