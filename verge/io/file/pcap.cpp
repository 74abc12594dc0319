// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/pcap.hpp"

#include <algorithm>
#include <map>
#include <optional>
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
  std::map<IpAddress, ModelVote> sensors;
  std::map<std::uint16_t, std::uint64_t> ports;
  std::optional<std::uint64_t> cut_to;  ///< Length to which the first cut frame was cut.
};

Survey look_through(Capture& capture) {
  Survey survey;
  DatagramReader reader(capture.link_type());
  Datagram datagram;
  for (std::uint64_t i = 0; i < kLookedThrough || survey.sensors.empty(); ++i) {
    const auto frame = capture.next();
    if (!frame || !*frame) break;
    const FrameKind kind = reader.read((*frame)->bytes, datagram);
    if (kind == FrameKind::kCut && !survey.cut_to) survey.cut_to = (*frame)->bytes.size();
    if (kind != FrameKind::kUdp) continue;
    ++survey.ports[datagram.port];
    const bool data = datagram.port == kDataPort && datagram.payload.size() == velodyne::kDataBytes;
    if (data) survey.sensors[datagram.source].add(datagram.payload);
  }
  return survey;
}

std::string list_of(const Survey& survey) {
  std::string list;
  for (const auto& [sensor, models] : survey.sensors) list += (list.empty() ? "" : ", ") + to_string(sensor);
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

using Sensor = std::pair<const IpAddress, ModelVote>;

/// The one sensor to read; an Error where there is none, or a choice.
Expected<Sensor> choose(const Input& input, const Survey& survey, const RecordingOptions& options) {
  const auto usage = [&](std::string what) {
    return Unexpected(input.error_at(ErrorCode::kUsage, 0, std::move(what), list_of(survey)));
  };
  const auto& sensors = survey.sensors;
  if (sensors.empty()) return Unexpected(nothing_in(input, survey));
  if (options.sensor_ip) {
    const auto chosen = std::find_if(sensors.begin(), sensors.end(), [&](const Sensor& sensor) {
      return to_string(sensor.first) == *options.sensor_ip;
    });
    if (chosen == sensors.end()) return usage(fmt::format("no sensor {} sends", *options.sensor_ip));
    return *chosen;
  }
  if (sensors.size() > 1) return usage("several sensors: choose --sensor-ip");
  return *sensors.begin();
}

class PcapRecording final : public Recording {
 public:
  PcapRecording(Capture capture, const IpAddress& sensor, VelodyneScans scans, Log log)
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
  void take_datagram(const Datagram& datagram, const CapturedFrame& frame);
  void judge_end();
  void tell_oddities() const;

  Capture capture_;
  DatagramReader reader_;
  IpAddress sensor_;
  VelodyneScans scans_;
  Log log_;
  RecordCounters records_;
  std::uint64_t odd_times_ = 0;
  std::uint64_t backward_times_ = 0;
  std::int64_t last_time_ns_ = 0;
  bool ended_ = false;
  bool second_sensor_told_ = false;
  std::optional<std::uint64_t> first_foreign_;  // record of the first packet of another model
  std::vector<Error> errors_;                   // to tell at the end
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
      take_datagram(datagram, frame);
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

void PcapRecording::take_datagram(const Datagram& datagram, const CapturedFrame& frame) {
  const bool data = datagram.port == kDataPort;
  if (!data && datagram.port != kPositionPort) {
    ++records_.other_port;
    return;
  }
  const bool whole = data && datagram.payload.size() == velodyne::kDataBytes;
  if (datagram.source != sensor_) {
    ++records_.other_sensor;
    if (!whole || second_sensor_told_) return;
    second_sensor_told_ = true;
    note(log_, fmt::format("a second sensor, {}, is left out", to_string(datagram.source)));
    return;
  }
  ++records_.from_sensor;
  scans_.add(datagram.payload, frame.time_ns);
  if (!first_foreign_ && scans_.packets().rejected_model > 0) first_foreign_ = frame.offset;
}

/// What is wrong with the recording as a whole.
void PcapRecording::judge_end() {
  const Input& input = capture_.input();
  if (reader_.incomplete() != 0) {
    errors_.push_back(input.error_at(ErrorCode::kDamaged, input.size(), "fragments of datagrams are missing",
                                     fmt::format("{} datagrams", reader_.incomplete()), "0"));
  }
  if (auto fault = scans_.fault()) {
    errors_.insert(errors_.begin(), input.error_at(fault->code, first_foreign_.value_or(0), fault->what,
                                                   fault->got, fault->need));
  }
}

/// What moved nothing and is still worth a look.
void PcapRecording::tell_oddities() const {
  std::vector<std::string> oddities;
  add_oddity(oddities, records_.cut, "records are cut short");
  add_oddity(oddities, reader_.odd_lengths(), "datagrams are shorter than their IP packets say");
  add_oddity(oddities, reader_.bad_checksums(), "datagrams have a wrong checksum");
  add_oddity(oddities, odd_times_, "records have a fraction of a second that is more than a second");
  add_oddity(oddities, backward_times_, "records are older than those before them");
  for (std::string& oddity : scans_.oddities()) oddities.push_back(std::move(oddity));
  warn_of(oddities, capture_.input().name(), log_);
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
  auto scans = VelodyneScans::create(options, capture->input().name(), sensor->second.winner());
  if (!scans) return Unexpected(std::move(scans).error());
  return std::make_unique<PcapRecording>(*std::move(capture), sensor->first, *std::move(scans), options.log);
}

}  // namespace verge::io
