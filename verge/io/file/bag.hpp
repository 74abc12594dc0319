// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/file/ros_wire.hpp"
#include "verge/io/recording.hpp"

namespace verge::io {

/// A name under which messages of one type stand in a recording.
struct Topic {
  std::string name;
  std::string type;  ///< As the recording writes it.
  Wire wire = Wire::kCdr;
  std::string unusable;        ///< Why its messages cannot be read; empty: they can.
  std::uint64_t messages = 0;  ///< As far as known when the recording was opened.
  bool wanted = true;          ///< Set false, its messages come without data.
};

/// Where a message stands, for errors.
struct Place {
  std::string inside_of;     ///< What holds it: "4117" (offset of a chunk), "messages row 12", or nothing.
  std::uint64_t offset = 0;  ///< In that, or in the file.

  /// "OFFSET" or "INSIDE_OF+OFFSET", of a byte of the message.
  [[nodiscard]] std::string where(std::uint64_t byte = 0) const;
};

/// A recorded message, as it was written.
struct Message {
  std::size_t topic = 0;         ///< Index in topics().
  std::int64_t received_ns = 0;  ///< By the recorder, since the Unix epoch.
  Bytes data;                    ///< Valid until the next call of next().
  Place place;
};

/// The messages of a recording of ROS, one by one, in the file's order.
class Bag {
 public:
  Bag() = default;
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;
  virtual ~Bag() = default;

  /// Known so far; entries stay where they are, new ones come behind them while messages are read.
  [[nodiscard]] virtual std::vector<Topic>& topics() = 0;
  /// The next message; none at the end; an Error for a damaged part, behind which the next call goes on.
  [[nodiscard]] virtual Expected<std::optional<Message>> next() = 0;
  /// Of the pieces of the file (chunks, messages): received, then what became of them.
  [[nodiscard]] virtual std::vector<Counter> counters() const = 0;
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Whether so many points fit the memory allowed. Fails with kLimit.
  [[nodiscard]] virtual Expected<void> allow(std::uint64_t points) const = 0;
};

/// The topic's index in the list; a new entry where the name, type or wire is another.
[[nodiscard]] std::size_t find_or_add(std::vector<Topic>& topics, const Topic& topic);

/// The error with which to refuse a recording in which no message was found but damage: unusable, or a limit.
/// None where there are messages, or no damage.
[[nodiscard]] Expected<void> nothing_but_damage(const std::vector<Topic>& topics,
                                                const std::optional<Error>& trouble);

/// The scans of the one topic that has some (sensor_msgs/PointCloud2 or velodyne_msgs/VelodyneScan), or of
/// `options.topic`. Where tf2_msgs/TFMessage or nav_msgs/Odometry cover the time of a scan, it gets its pose,
/// and its motion where its points have times; for that a scan waits until its poses are there, for 0.5 s of
/// the recording and 4 scans at most.
///
/// Fails with kUsage where several topics have scans or the one asked for has none (it lists those that
/// have), kUnusable where none has.
[[nodiscard]] Expected<std::unique_ptr<Recording>> open_bag(std::unique_ptr<Bag> bag,
                                                            const RecordingOptions& options);

/// open_bag() of a bag that was just opened, or the Error with which it was not.
[[nodiscard]] Expected<std::unique_ptr<Recording>> scans_of(Expected<std::unique_ptr<Bag>> bag,
                                                            const RecordingOptions& options);

}  // namespace verge::io
