// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/ibeo_stream.hpp"

#include <string>
#include <utility>

#include <fmt/core.h>

#include "verge/core/angle.hpp"
#include "verge/io/file/calibration_file.hpp"
#include "verge/io/file/framed_recording.hpp"
#include "verge/io/file/magic.hpp"
#include "verge/sensor/ibeo/alasca_scan.hpp"
#include "verge/sensor/ibeo/health2030.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/message.hpp"
#include "verge/sensor/ibeo/objects2221.hpp"
#include "verge/sensor/ibeo/vehicle2805.hpp"

namespace verge::io {
namespace {

namespace ibeo = sensor::ibeo;

/// One line on where the sensor sits; none where it was not told.
std::optional<std::string> note_of(const ibeo::Mounting& mounting, std::uint16_t ticks_per_turn) {
  if (mounting == ibeo::Mounting{}) return std::nullopt;
  const double degrees = 360.0 / ticks_per_turn;
  return fmt::format(
      "mounting is not applied, points stay in the sensor's frame: yaw {:.3f}, pitch {:.3f}, roll {:.3f} "
      "deg, "
      "x {:.2f}, y {:.2f}, z {:.2f} m",
      mounting.yaw_ticks * degrees, mounting.pitch_ticks * degrees, mounting.roll_ticks * degrees,
      0.01 * mounting.x_cm, 0.01 * mounting.y_cm, 0.01 * mounting.z_cm);
}

class IbeoRecording final : public FramedRecording {
 public:
  IbeoRecording(Input input, ibeo::LuxModel model, Log log)
      : FramedRecording(std::move(input), ibeo::kLuxFrames), model_(std::move(model)), log_(std::move(log)) {}

 private:
  [[nodiscard]] Expected<std::optional<Decoded>> decode(const ibeo::Frame& frame) override;
  [[nodiscard]] std::optional<Error> check_end() override;
  [[nodiscard]] Expected<std::optional<Decoded>> decode_scan(Bytes body, std::uint64_t at);
  [[nodiscard]] Expected<std::optional<Decoded>> decode_health(Bytes body, std::uint64_t at);
  void check_index(Bytes body, std::uint64_t at);
  template <class T>
  [[nodiscard]] Expected<std::optional<Decoded>> account(const Expected<T>& decoded, const std::string& kind);

  ibeo::LuxModel model_;
  Log log_;
  std::vector<std::string> health_;  // what the sensor has said since the last scan
  bool is_idc_ = false;              // a live stream leaves the size of the message before at 0
  bool closed_ = false;
};

/// Puts a message that holds no scan to its account.
template <class T>
Expected<std::optional<Decoded>> IbeoRecording::account(const Expected<T>& decoded, const std::string& kind) {
  if (!decoded) return Unexpected(rejected(decoded.error()));
  used(kind);
  return std::nullopt;
}

Expected<std::optional<Decoded>> IbeoRecording::decode(const ibeo::Frame& frame) {
  const ibeo::MessageHeader header = ibeo::decode_header(frame.header);
  const std::uint64_t at = frame.offset + ibeo::kHeaderBytes;
  is_idc_ = is_idc_ || header.previous_bytes != 0;
  closed_ = header.type == ibeo::kIdcTrailerType;
  switch (header.type) {
    case ibeo::kScanType:
      return decode_scan(frame.body, at);
    case ibeo::kHealthType:
      return decode_health(frame.body, at);
    case ibeo::kObjectsType:
      return account(ibeo::decode_objects(frame.body, at), "objects (0x2221)");
    case ibeo::kVehicleStateType:
      return account(ibeo::decode_vehicle_state(frame.body, at), "vehicle state (0x2805)");
    case ibeo::kIdcIndexType:
      check_index(frame.body, at);
      break;
    case ibeo::kIdcTrailerType:
      used("trailer (0x6120)");
      break;
    default:
      ignored();
  }
  return std::nullopt;
}

Expected<std::optional<Decoded>> IbeoRecording::decode_scan(Bytes body, std::uint64_t at) {
  const auto scan = ibeo::decode_scan(body, at);
  if (!scan) return Unexpected(rejected(scan.error()));
  used("scan (0x2202)");
  ibeo::MessageCloud made = ibeo::cloud_of(*scan, model_);
  add(made.counts);
  Decoded out;
  out.cloud = std::move(made.cloud);
  out.stamp_ns = made.stamp_ns;
  out.sensor = model_.name;
  out.notes = std::exchange(health_, {});
  if (auto mounting = note_of(scan->mounting, scan->ticks_per_turn))
    out.notes.push_back(*std::move(mounting));
  if ((scan->flags & ibeo::kDirtLabelled) != 0)
    out.notes.emplace_back("the sensor labels dirt on its window");
  if ((scan->flags & ibeo::kRainLabelled) != 0) out.notes.emplace_back("the sensor labels rain");
  return out;
}

Expected<std::optional<Decoded>> IbeoRecording::decode_health(Bytes body, std::uint64_t at) {
  constexpr std::size_t kMostNotes = 32;  // a sensor may be ill for a long time between two scans
  const auto health = ibeo::decode_health(body, at);
  if (health) {
    for (const std::string_view trouble : ibeo::troubles_of(*health)) {
      if (health_.size() < kMostNotes) health_.push_back(fmt::format("the sensor reports: {}", trouble));
    }
  }
  return account(health, "errors and warnings (0x2030)");
}

/// An index that is wrong is no reason to distrust the scans: it is not needed.
void IbeoRecording::check_index(Bytes body, std::uint64_t at) {
  const auto index = ibeo::decode_frame_index(body, at);
  if (index) return used("frame index (0x6130)");
  note(log_, to_string(rejected(index.error())));
}

std::optional<Error> IbeoRecording::check_end() {
  if (!is_idc_ || closed_) return std::nullopt;
  return input().error_at(ErrorCode::kDamaged, input().size(), "recording was not closed: it has no trailer");
}

/// A header of ours whose fields can be.
bool is_header(Bytes bytes) {
  if (bytes.size() < ibeo::kHeaderBytes) return false;
  const ibeo::MessageHeader header = ibeo::decode_header(bytes);
  return header.bytes <= ibeo::kLuxFrames.body_max_bytes && header.type >= 0x2000 && header.type < 0x8000;
}

}  // namespace

bool is_ibeo(Bytes head) {
  for (auto at = find_magic(head, ibeo::kLuxFrames.magic); at;
       at = find_magic(head, ibeo::kLuxFrames.magic, *at + 1)) {
    if (is_header(head.subspan(*at))) return true;
  }
  return false;
}

Expected<ibeo::LuxModel> lux_with_layers(const std::optional<std::filesystem::path>& calibration) {
  ibeo::LuxModel model = ibeo::lux();
  if (!calibration) return model;
  const auto layers = read_calibration_file(*calibration, model.layer_elevation_rad.size());
  if (!layers) return Unexpected(layers.error());
  const auto refuse = [&](std::string what) {
    return Unexpected({ErrorCode::kUnusable, calibration->string(), {}, std::move(what), {}, {}});
  };
  for (std::size_t i = 0; i < layers->size(); ++i) {
    const sensor::velodyne::LaserCorrection& layer = (*layers)[i];
    const bool flat = layer.azimuth_rad == 0.0 && layer.distance_m == 0.0 && layer.up_m == 0.0 &&
                      layer.left_m == 0.0 && !layer.near;
    if (!flat) return refuse("a LUX's layers have elevations (vert_correction) alone");
    if (i > 0 && layer.elevation_rad <= model.layer_elevation_rad[i - 1])
      return refuse("layers do not rise from 0 on");
    model.layer_elevation_rad[i] = layer.elevation_rad;
  }
  return model;
}

Expected<std::unique_ptr<Recording>> open_ibeo(Input input, const RecordingOptions& options) {
  if (options.model && *options.model != "lux" && *options.model != "ldmrs") {
    return Unexpected(
        input.error_at(ErrorCode::kUsage, 0, "no such model of this format", *options.model, "lux or ldmrs"));
  }
  const auto head = checked_head(input);
  if (!head) return Unexpected(head.error());
  const bool ours = find_magic(*head, ibeo::kLuxFrames.magic).has_value();
  if (const auto other = find_magic(*head, ibeo::kAlascaFrames.magic); other && !ours) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, *other,
                                     "holds messages of an ibeo ALASCA XT, not of a LUX", "AF FE C0 C0",
                                     "AF FE C0 C2"));
  }
  auto model = lux_with_layers(options.calibration);
  if (!model) return Unexpected(std::move(model).error());
  return std::make_unique<IbeoRecording>(std::move(input), *std::move(model), options.log);
}

}  // namespace verge::io
