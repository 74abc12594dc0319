// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verge/io/input.hpp"
#include "verge/io/recording.hpp"
#include "verge/sensor/ibeo/framer.hpp"
#include "verge/sensor/ibeo/lux.hpp"

namespace verge::io {

/// A recording that is a stream of messages with a magic each. A format says what its messages mean.
class FramedRecording : public Recording {
 public:
  FramedRecording(Input input, const sensor::ibeo::FrameLayout& layout);

  [[nodiscard]] Expected<std::optional<Decoded>> next() final;
  [[nodiscard]] std::vector<Counter> counters() const final;

 protected:
  /// What a message holds: a scan, nothing that has points, or what is wrong with it. Every message is put
  /// to one account, by used(), ignored() or rejected().
  [[nodiscard]] virtual Expected<std::optional<Decoded>> decode(const sensor::ibeo::Frame& frame) = 0;
  /// What is wrong with the recording as a whole, asked once at its end.
  [[nodiscard]] virtual std::optional<Error> check_end() { return std::nullopt; }

  void used(const std::string& kind) { ++used_[kind]; }
  void ignored() { ++ignored_; }
  /// The error as one of this file, counted by what it says.
  [[nodiscard]] Error rejected(Error error);
  void add(const sensor::ibeo::PointCounts& points);
  [[nodiscard]] const Input& input() const { return input_; }

 private:
  [[nodiscard]] Expected<void> feed();
  [[nodiscard]] Error error_of(const sensor::ibeo::Skipped& skipped) const;

  Input input_;
  sensor::ibeo::FrameLayout layout_;
  sensor::ibeo::Framer framer_;
  std::uint64_t at_ = 0;
  bool ended_ = false;
  bool checked_ = false;
  std::map<std::string, std::uint64_t> used_;
  std::map<std::string, std::uint64_t> rejected_;
  std::uint64_t ignored_ = 0;
  sensor::ibeo::PointCounts points_;
};

}  // namespace verge::io
