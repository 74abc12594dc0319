// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/recording_source.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace verge::io {
namespace {

constexpr std::size_t kDamaged = SIZE_MAX;

/// Scans of so many points, or damage.
class Listed final : public Recording {
 public:
  explicit Listed(std::vector<std::size_t> points) : points_(std::move(points)) {}

  [[nodiscard]] Expected<std::optional<Decoded>> next() override {
    if (next_ == points_.size()) return std::nullopt;
    const std::size_t points = points_[next_++];
    if (points == kDamaged) return Unexpected({ErrorCode::kDamaged, "drive.rec", "7", "is cut", {}, {}});
    Decoded decoded;
    for (std::size_t i = 0; i < points; ++i) {
      decoded.cloud.x.push_back(static_cast<float>(i + 1));
      decoded.cloud.y.push_back(0.0F);
      decoded.cloud.z.push_back(0.0F);
      decoded.cloud.ring.push_back(0);
    }
    decoded.stamp_ns = static_cast<std::int64_t>(1000 * next_);
    decoded.notes = {"taken as it is"};
    return decoded;
  }
  [[nodiscard]] std::vector<Counter> counters() const override { return {{"scans", next_}}; }

 private:
  std::vector<std::size_t> points_;
  std::size_t next_ = 0;
};

std::unique_ptr<Source> listed(std::vector<std::size_t> points, OpenOptions options = {}) {
  return source_of(std::make_unique<Listed>(std::move(points)), {Format::kPcd, {"drive.rec"}, {}},
                   std::move(options));
}

/// "000000:3 damage 000001:5": name and points of each scan.
std::string all_of(Source& source) {
  std::string text;
  while (true) {
    const auto scan = source.next();
    if (scan && !*scan) return text;
    if (!text.empty()) text += ' ';
    text += scan ? (*scan)->frame + ":" + std::to_string((*scan)->size()) : "damage";
  }
}

TEST(RecordingSource, NamesScansByTheirPlaceAndKeepsTheirTime) {
  EXPECT_EQ(all_of(*listed({3, 5, 0})), "000000:3 000001:5 000002:0");
  const auto source = listed({3});
  EXPECT_EQ(source->next().value()->stamp_ns, 1000);
  EXPECT_EQ(source->counters().front().count, 1U);
  EXPECT_FALSE(source->info().scans.has_value());
}

TEST(RecordingSource, DamageIsSaidAndWhatFollowsIsRead) {
  EXPECT_EQ(all_of(*listed({3, kDamaged, 5})), "000000:3 damage 000001:5");
}

TEST(RecordingSource, TheFramesAskedForKeepTheirNames) {
  OpenOptions options;
  options.frames_begin = 1;
  options.frames_end = 3;
  EXPECT_EQ(all_of(*listed({kDamaged, 1, 2, 3, kDamaged, 4}, options)), "000001:2 000002:3");
  options.frames_begin = 9;
  options.frames_end.reset();
  EXPECT_EQ(all_of(*listed({1, 2}, options)), "");
}

TEST(RecordingSource, NotesAreSaidOnce) {
  std::vector<std::string> lines;
  OpenOptions options;
  options.log = [&](LogLevel /*level*/, std::string_view text) { lines.emplace_back(text); };
  (void)all_of(*listed({3, 5, 7}, options));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "drive.rec: taken as it is");
}

}  // namespace
}  // namespace verge::io
