// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcap.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "verge/io/file/capture.hpp"
#include "verge/io/file/datagram.hpp"
#include "verge/io/file/velodyne_scans.hpp"
#include "verge/sensor/velodyne/facts.hpp"
#include "verge/sensor/velodyne/packet.hpp"

namespace verge::io {
namespace {

namespace velodyne = sensor::velodyne;

constexpr std::uint16_t kDataPort = 2368;
constexpr std::uint16_t kPositionPort = 8308;
/// How far a capture is looked through for a second sensor before the first scan: some ten seconds.
constexpr std::uint64_t kLookedThrough = 20'000;

/// What the records of a capture are; the kinds add up to the records.
struct RecordCounters {
  std::uint64_t records = 0;
  std::uint64_t from_sensor = 0;
  std::uint64_t other_sensor = 0;
  std::uint64_t other_port = 0;
  std::uint64_t fragments = 0;  ///< But for the last of each datagram.
  std::uint64_t not_udp = 0;
  std::uint64_t cut = 0;
  std::uint64_t malformed = 0;
};

/// What a look through the capture's begin has shown.
struct Survey {
  std::set<IpAddress> sensors;
  std::map<std::uint16_t, std::uint64_t> ports;
  std::optional<std::uint64_t> cut_to;  ///< Length to which the first cut frame was cut.
  bool whole = false;                   ///< The end was reached.
};

Survey look_through(Capture& capture) {
  Survey survey;
  DatagramReader reader(capture.link_type());
  Datagram datagram;
  for (std::uint64_t i = 0; i < kLookedThrough; ++i) {
    const auto frame = capture.next();
    if (!frame || !*frame) {
      survey.whole = true;
      break;
    }
    const FrameKind kind = reader.read((*frame)->bytes, datagram);
    if (kind == FrameKind::kCut && !survey.cut_to) survey.cut_to = (*frame)->bytes.size();
    if (kind != FrameKind::kUdp) continue;
    ++survey.ports[datagram.port];
    const bool data = datagram.port == kDataPort && datagram.payload.size() == velodyne::kDataBytes;
    if (data) survey.sensors.insert(datagram.source);
  }
  return survey;
}

std::string list_of(const std::set<IpAddress>& sensors) {
  std::string list;
  for (const IpAddress& sensor : sensors) list += (list.empty() ? "" : ", ") + to_string(sensor);
  return list;
}

/// Why a capture holds nothing for us.
Error nothing_in(const Input& input, const Survey& survey) {
  std::string seen;
  constexpr std::size_t kShown = 8;
  std::size_t shown = 0;
  for (const auto& [port, count] : survey.ports) {
    if (shown++ < kShown) seen += fmt::format("{}{}: {}", seen.empty() ? "; saw " : ", ", port, count);
  }
  std::string what = fmt::format("no data packet on port {}{}", kDataPort, seen);
  if (survey.cut_to)
    what = fmt::format("no whole data packet: the capture was cut to {} bytes", *survey.cut_to);
  return input.error_at(ErrorCode::kUnusable, 0, std::move(what));
}

/// The one sensor to read; an Error where there is none, or a choice.
Expected<std::optional<IpAddress>> choose(const Input& input, const Survey& survey,
                                          const RecordingOptions& options) {
  const auto usage = [&](std::string what) {
    return Unexpected(input.error_at(ErrorCode::kUsage, 0, std::move(what), list_of(survey.sensors)));
  };
  if (survey.sensors.empty() && survey.whole) return Unexpected(nothing_in(input, survey));
  if (options.sensor_ip) {
    const auto chosen =
        std::find_if(survey.sensors.begin(), survey.sensors.end(),
                     [&](const IpAddress& sensor) { return to_string(sensor) == *options.sensor_ip; });
    if (chosen == survey.sensors.end()) return usage(fmt::format("no sensor {} sends", *options.sensor_ip));
    return *chosen;
  }
  if (survey.sensors.size() > 1) return usage("several sensors: choose --sensor-ip");
  if (survey.sensors.empty()) return std::nullopt;
  return *survey.sensors.begin();
}

/// The first data packet's model, for a calibration that has to be of it.
std::optional<velodyne::Model> first_model(Capture& capture, const std::optional<IpAddress>& sensor) {
  DatagramReader reader(capture.link_type());
  Datagram datagram;
  while (true) {
    const auto frame = capture.next();
    if (!frame || !*frame) return std::nullopt;
    if (reader.read((*frame)->bytes, datagram) != FrameKind::kUdp) continue;
    const bool data = datagram.port == kDataPort && datagram.payload.size() == velodyne::kDataBytes;
    if (!data || (sensor && datagram.source != *sensor)) continue;
    if (const auto model = velodyne::model_of(datagram.payload)) return model;
  }
}

class PcapRecording final : public Recording {
 public:
  PcapRecording(Capture capture, std::optional<IpAddress> sensor, VelodyneScans scans, Log log)
      : capture_(std::move(capture)),
        reader_(capture_.link_type()),
        sensor_(sensor),
        scans_(std::move(scans)),
        log_(std::move(log)) {}

  [[nodiscard]] Expected<std::optional<Decoded>> next() override;
  [[nodiscard]] std::vector<Counter> counters() const override;

 private:
  [[nodiscard]] bool read_frame();
  void take_frame(const CapturedFrame& frame);
  void take_datagram(const Datagram& datagram, std::int64_t time_ns);
  void judge_end();
  void tell_oddities() const;

  Capture capture_;
  DatagramReader reader_;
  std::optional<IpAddress> sensor_;
  VelodyneScans scans_;
  Log log_;
  RecordCounters records_;
  std::uint64_t odd_times_ = 0;
  std::uint64_t backward_times_ = 0;
  std::int64_t last_time_ns_ = 0;
  bool ended_ = false;
  bool second_sensor_told_ = false;
  std::vector<Error> errors_;  // to tell at the end
};

/// Reads one frame on; false at the end of the capture.
bool PcapRecording::read_frame() {
  const auto frame = capture_.next();
  if (!frame) {
    ++records_.records;
    ++records_.malformed;
    errors_.push_back(frame.error());
    return false;
  }
  if (!*frame) return false;
  take_frame(**frame);
  return true;
}

void PcapRecording::take_frame(const CapturedFrame& frame) {
  ++records_.records;
  if (frame.odd_time) ++odd_times_;
  if (frame.time_ns < last_time_ns_) ++backward_times_;
  last_time_ns_ = frame.time_ns;
  Datagram datagram;
  switch (reader_.read(frame.bytes, datagram)) {
    case FrameKind::kUdp:
      take_datagram(datagram, frame.time_ns);
      break;
    case FrameKind::kFragment:
      ++records_.fragments;
      break;
    case FrameKind::kCut:
      ++records_.cut;
      break;
    case FrameKind::kMalformed:
      ++records_.malformed;
      break;
    case FrameKind::kNotUdp:
      ++records_.not_udp;
      break;
  }
}

void PcapRecording::take_datagram(const Datagram& datagram, std::int64_t time_ns) {
  const bool data = datagram.port == kDataPort;
  if (!data && datagram.port != kPositionPort) {
    ++records_.other_port;
    return;
  }
  const bool whole = data && datagram.payload.size() == velodyne::kDataBytes;
  if (!sensor_ && whole) sensor_ = datagram.source;
  if (sensor_ && datagram.source != *sensor_) {
    ++records_.other_sensor;
    if (!whole || second_sensor_told_) return;
    second_sensor_told_ = true;
    note(log_, fmt::format("a second sensor, {}, is left out", to_string(datagram.source)));
    return;
  }
  ++records_.from_sensor;
  scans_.add(datagram.payload, time_ns);
}

/// What is wrong with the recording as a whole.
void PcapRecording::judge_end() {
  const Input& input = capture_.input();
  if (reader_.incomplete() != 0) {
    errors_.push_back(input.error_at(ErrorCode::kDamaged, input.size(), "fragments of datagrams are missing",
                                     fmt::format("{} datagrams", reader_.incomplete()), "0"));
  }
  const velodyne::Counters& counters = scans_.packets();
  if (counters.data == 0) {
    const std::string got =
        fmt::format("{} of {} packets are of another model", counters.rejected_model, counters.packets);
    errors_.insert(errors_.begin(),
                   input.error_at(ErrorCode::kUnusable, 0, "no data packet can be decoded", got));
  }
}

/// What moved nothing and is still worth a look.
void PcapRecording::tell_oddities() const {
  const auto tell = [&](std::uint64_t count, std::string_view what) {
    if (count > 0) warn(log_, fmt::format("{}: {} {}", capture_.input().name(), count, what));
  };
  tell(reader_.odd_lengths(), "datagrams are shorter than their IP packets say");
  tell(reader_.bad_checksums(), "datagrams have a wrong checksum");
  tell(odd_times_, "records have a fraction of a second that is more than a second");
  tell(backward_times_, "records are older than those before them");
}

Expected<std::optional<Decoded>> PcapRecording::next() {
  while (true) {
    if (auto scan = scans_.take()) return scan;
    if (ended_) break;
    if (read_frame()) continue;
    ended_ = true;
    judge_end();
    tell_oddities();
  }
  if (auto scan = scans_.finish()) return scan;
  if (errors_.empty()) return std::nullopt;
  Error error = std::move(errors_.front());
  errors_.erase(errors_.begin());
  return Unexpected(std::move(error));
}

std::vector<Counter> PcapRecording::counters() const {
  std::vector<Counter> all{{"records received", records_.records},
                           {"records from the sensor", records_.from_sensor},
                           {"records from another sensor", records_.other_sensor},
                           {"records to another port", records_.other_port},
                           {"records that are fragments", records_.fragments},
                           {"records that are not UDP", records_.not_udp},
                           {"records cut", records_.cut},
                           {"records malformed", records_.malformed}};
  for (Counter& counter : scans_.counters()) all.push_back(std::move(counter));
  return all;
}

}  // namespace

Expected<std::unique_ptr<Recording>> open_pcap(Input input, const RecordingOptions& options) {
  auto capture = Capture::open(std::move(input));
  if (!capture) return Unexpected(capture.error());
  const Survey survey = look_through(*capture);
  const auto sensor = choose(capture->input(), survey, options);
  if (!sensor) return Unexpected(sensor.error());
  capture = Capture::reopen(*std::move(capture));
  if (!capture) return Unexpected(capture.error());
  const auto seen = options.calibration ? first_model(*capture, *sensor) : std::nullopt;
  auto scans = VelodyneScans::create(options, capture->input().name(), seen);
  if (!scans) return Unexpected(std::move(scans).error());
  capture = Capture::reopen(*std::move(capture));
  if (!capture) return Unexpected(capture.error());
  return std::make_unique<PcapRecording>(*std::move(capture), *sensor, *std::move(scans), options.log);
}

}  // namespace verge::io
