// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/alasca_stream.hpp"

#include <utility>

#include "verge/io/file/framed_recording.hpp"
#include "verge/io/file/magic.hpp"
#include "verge/sensor/ibeo/alasca_xt.hpp"
#include "verge/sensor/ibeo/message.hpp"

namespace verge::io {
namespace {

namespace ibeo = sensor::ibeo;

class AlascaRecording final : public FramedRecording {
 public:
  explicit AlascaRecording(Input input)
      : FramedRecording(std::move(input), ibeo::kAlascaFrames), model_(ibeo::alasca_xt()) {}

 private:
  [[nodiscard]] Expected<std::optional<Decoded>> decode(const ibeo::Frame& frame) override;

  ibeo::AlascaModel model_;
};

Expected<std::optional<Decoded>> AlascaRecording::decode(const ibeo::Frame& frame) {
  if (ibeo::decode_alasca_header(frame.header).type != ibeo::kAlascaScanType) {
    ignored();
    return std::nullopt;
  }
  const auto scan = ibeo::decode_alasca_scan(frame.body, frame.offset + ibeo::kAlascaHeaderBytes);
  if (!scan) return Unexpected(rejected(scan.error()));
  used("compressed scan (15)");
  ibeo::MessageCloud made = ibeo::cloud_of(*scan, model_);
  add(made.counts);
  Decoded out;
  out.cloud = std::move(made.cloud);
  out.sensor = model_.name;
  return out;
}

/// A header of ours whose fields can be; 1 are objects, 255 has been seen.
bool is_header(Bytes bytes) {
  if (bytes.size() < ibeo::kAlascaHeaderBytes) return false;
  const ibeo::AlascaHeader header = ibeo::decode_alasca_header(bytes);
  return header.bytes <= ibeo::kAlascaFrames.body_max_bytes && header.type <= 255;
}

}  // namespace

bool is_alasca(Bytes head) {
  const auto& magic = ibeo::kAlascaFrames.magic;
  for (auto at = find_magic(head, magic); at; at = find_magic(head, magic, *at + 1)) {
    if (is_header(head.subspan(*at))) return true;
  }
  return false;
}

Expected<std::unique_ptr<Recording>> open_alasca(Input input, const RecordingOptions& options) {
  if (options.model && *options.model != "alasca_xt") {
    return Unexpected(
        input.error_at(ErrorCode::kUsage, 0, "no such model of this format", *options.model, "alasca_xt"));
  }
  const auto head = checked_head(input);
  if (!head) return Unexpected(head.error());
  const bool ours = find_magic(*head, ibeo::kAlascaFrames.magic).has_value();
  if (const auto other = find_magic(*head, ibeo::kLuxFrames.magic); other && !ours) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, *other,
                                     "holds messages of an ibeo LUX, not of an ALASCA XT", "AF FE C0 C2",
                                     "AF FE C0 C0"));
  }
  return std::make_unique<AlascaRecording>(std::move(input));
}

}  // namespace verge::io
