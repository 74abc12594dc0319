// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/bag.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/point_cloud2.hpp"
#include "verge/io/file/ros_messages.hpp"
#include "verge/io/file/transforms.hpp"
#include "verge/io/file/velodyne_scans.hpp"

namespace verge::io {
namespace {

/// Times of a damaged recording may be any: within 126 years of 1970, differences fit.
constexpr std::int64_t kFarthest_ns = 4'000'000'000'000'000'000;
constexpr std::int64_t kLongestWait_ns = 500'000'000;
constexpr std::size_t kMostWaiting = 4;

MessageKind topic_kind(const Topic& topic) {
  return topic.unusable.empty() ? kind_of(topic.type) : MessageKind::kOther;
}

/// A scan whose poses may still come.
struct Waiting {
  Decoded decoded;
  std::int64_t received_ns = 0;
};

class BagRecording final : public Recording {
 public:
  BagRecording(std::unique_ptr<Bag> bag, std::size_t topic, Log log)
      : bag_(std::move(bag)), topic_(topic), log_(std::move(log)) {
    static_cast<void>(kind_at(bag_->topics().size() - 1));  // says which messages are wanted
  }

  /// Where the topic has packets: reads on to the first ones, which say the model. Damage before them is told
  /// by next(). Fails as VelodyneScans::create() does.
  [[nodiscard]] Expected<void> begin_packets(const RecordingOptions& options);

  [[nodiscard]] Expected<std::optional<Decoded>> next() override;
  [[nodiscard]] std::vector<Counter> counters() const override;

 private:
  [[nodiscard]] MessageKind kind_at(std::size_t topic);
  [[nodiscard]] Expected<void> read_message();
  [[nodiscard]] Expected<void> take(const Message& message);
  [[nodiscard]] Expected<void> take_cloud(const Message& message);
  [[nodiscard]] Expected<void> take_packets(const Message& message);
  [[nodiscard]] bool feed_packets();
  void judge_packets();
  [[nodiscard]] Expected<void> take_transforms(const Message& message);
  [[nodiscard]] Expected<void> take_odometry(const Message& message);
  void add_transform(StampedTransform transform, TransformOrigin origin);
  void add_scan(Decoded decoded, std::int64_t received_ns);
  [[nodiscard]] bool is_ready();
  [[nodiscard]] Decoded hand_out();
  [[nodiscard]] bool set_poses(Decoded& decoded) const;

  std::unique_ptr<Bag> bag_;
  std::size_t topic_;
  Log log_;
  std::vector<MessageKind> kinds_;  // by topic
  bool has_poses_ = false;
  bool ended_ = false;
  bool told_ = false;                      // what there is to say at the end
  std::optional<VelodyneScans> velodyne_;  // where the topic has packets
  VelodyneScan packets_;                   // of the message at hand
  std::size_t next_packet_ = 0;
  std::string packets_where_;                 // of the message at hand
  std::optional<std::string> first_foreign_;  // message of the first packet of another model
  std::deque<Error> errors_;                  // to tell before anything else is read
  Transforms transforms_;
  std::deque<Waiting> waiting_;
  std::int64_t now_ns_ = 0;
  std::optional<std::int64_t> last_stamp_ns_;
  std::uint64_t of_scans_ = 0, of_poses_ = 0, of_others_ = 0, rejected_ = 0;
  std::uint64_t transforms_used_ = 0, transforms_rejected_ = 0;
};

/// The kind of the messages of a topic, kOther for those that we do not read; decided where it is seen first.
MessageKind BagRecording::kind_at(std::size_t topic) {
  while (kinds_.size() <= topic) {
    Topic& seen = bag_->topics()[kinds_.size()];
    const MessageKind kind = topic_kind(seen);
    const bool read = kinds_.size() == topic_ || holds_poses(kind);
    has_poses_ = has_poses_ || holds_poses(kind);
    seen.wanted = read;
    kinds_.push_back(read ? kind : MessageKind::kOther);
  }
  return kinds_[topic];
}

/// The error of a message with its place in the file.
Error placed(Error error, const Message& message, const Bag& bag) {
  std::uint64_t byte = 0;
  std::from_chars(error.where.data(), error.where.data() + error.where.size(), byte);
  error.file = bag.name();
  error.where = message.place.where(byte);
  return error;
}

Expected<void> BagRecording::take(const Message& message) {
  now_ns_ = std::clamp(message.received_ns, -kFarthest_ns, kFarthest_ns);
  const auto read = [&]() -> Expected<void> {
    switch (kind_at(message.topic)) {
      case MessageKind::kPointCloud2:
        return take_cloud(message);
      case MessageKind::kVelodyneScan:
        return take_packets(message);
      case MessageKind::kTransforms:
        return take_transforms(message);
      case MessageKind::kOdometry:
        return take_odometry(message);
      case MessageKind::kOther:
        break;
    }
    ++of_others_;
    return {};
  };
  auto taken = read();
  if (taken) return taken;
  ++rejected_;
  return Unexpected(placed(std::move(taken).error(), message, *bag_));
}

Expected<void> BagRecording::take_cloud(const Message& message) {
  const auto cloud = read_point_cloud2(bag_->topics()[message.topic].wire, message.data);
  if (!cloud) return Unexpected(cloud.error());
  if (auto allowed = bag_->allow(cloud->points()); !allowed) return allowed;
  auto decoded = decode_point_cloud2(*cloud);
  if (!decoded) return Unexpected(std::move(decoded).error());
  ++of_scans_;
  add_scan(*std::move(decoded), now_ns_);
  return {};
}

Expected<void> BagRecording::take_packets(const Message& message) {
  auto scan = read_velodyne_scan(bag_->topics()[message.topic].wire, message.data);
  if (!scan) return Unexpected(std::move(scan).error());
  ++of_scans_;
  packets_ = *std::move(scan);
  packets_where_ = message.place.where();
  next_packet_ = 0;
  return {};
}

Expected<void> BagRecording::begin_packets(const RecordingOptions& options) {
  while (packets_.packets.empty() && !ended_) {
    if (auto read = read_message(); !read) errors_.push_back(std::move(read).error());
  }
  ModelVote models;
  for (const VelodynePacket& packet : packets_.packets) models.add(packet.payload);
  auto scans = VelodyneScans::create(options, bag_->name(), models.winner());
  if (!scans) return Unexpected(std::move(scans).error());
  velodyne_ = *std::move(scans);
  return {};
}

/// Packets of the message at hand (at its end, what is left) until a revolution is complete; false where
/// there are none. One at a time, since a message may hold any number of revolutions.
bool BagRecording::feed_packets() {
  if (!velodyne_) return false;
  auto decoded = velodyne_->take();
  while (!decoded && next_packet_ < packets_.packets.size()) {
    const VelodynePacket& packet = packets_.packets[next_packet_++];
    velodyne_->add(packet.payload, packet.received_ns != 0 ? packet.received_ns : now_ns_);
    if (!first_foreign_ && velodyne_->packets().rejected_model > 0) first_foreign_ = packets_where_;
    decoded = velodyne_->take();
  }
  if (!decoded && ended_) decoded = velodyne_->finish();
  if (!decoded) return false;
  decoded->frame_id = packets_.header.frame_id;
  add_scan(*std::move(decoded), now_ns_);
  return true;
}

/// At the end: what is wrong with the packets as a whole, and what is odd about them.
void BagRecording::judge_packets() {
  if (!velodyne_) return;
  if (auto fault = velodyne_->fault()) {
    fault->file = bag_->name();
    fault->where = first_foreign_.value_or("");
    errors_.push_back(*std::move(fault));
  }
  warn_of(velodyne_->oddities(), bag_->name(), log_);
}

void BagRecording::add_transform(StampedTransform transform, TransformOrigin origin) {
  if (transforms_.add(std::move(transform), origin)) {
    ++transforms_used_;
  } else {
    ++transforms_rejected_;
  }
}

Expected<void> BagRecording::take_transforms(const Message& message) {
  const Topic& topic = bag_->topics()[message.topic];
  auto transforms = read_transforms(topic.wire, message.data);
  if (!transforms) return Unexpected(std::move(transforms).error());
  const bool is_static = topic.name.ends_with("tf_static");
  for (StampedTransform& transform : *transforms) {
    add_transform(std::move(transform), is_static ? TransformOrigin::kStatic : TransformOrigin::kTree);
  }
  ++of_poses_;
  return {};
}

Expected<void> BagRecording::take_odometry(const Message& message) {
  auto transform = read_odometry(bag_->topics()[message.topic].wire, message.data);
  if (!transform) return Unexpected(std::move(transform).error());
  add_transform(*std::move(transform), TransformOrigin::kOdometry);
  ++of_poses_;
  return {};
}

void BagRecording::add_scan(Decoded decoded, std::int64_t received_ns) {
  if (decoded.stamp_ns && last_stamp_ns_ && *decoded.stamp_ns < *last_stamp_ns_) {
    decoded.notes.emplace_back("a scan is older than the one before it: the recording goes back in time");
  }
  if (decoded.stamp_ns) last_stamp_ns_ = decoded.stamp_ns;
  waiting_.push_back({std::move(decoded), received_ns});
}

/// Pose at the first point and, where the points have times, motion to the last. True where nothing more can
/// come of waiting.
bool BagRecording::set_poses(Decoded& decoded) const {
  if (!decoded.stamp_ns) return true;
  const auto begin = transforms_.T_world_frame(decoded.frame_id, *decoded.stamp_ns);
  if (!begin) return false;
  decoded.T_world_sensor = begin;
  const auto& times = decoded.cloud.time_s;
  if (times.empty()) return true;
  constexpr double kLongest_s = 4.0;  // of a scan; what organise() keeps of times is shorter than 4.3 s
  const double last = *std::max_element(times.begin(), times.end());
  const bool usable = last > 0.0 && last <= kLongest_s;
  if (!usable) return true;
  const std::int64_t duration_ns = std::llround(last * 1e9);
  const auto end = transforms_.T_world_frame(decoded.frame_id, *decoded.stamp_ns + duration_ns);
  if (!end) return false;
  decoded.motion = Motion{*begin, *end, duration_ns};
  return true;
}

bool BagRecording::is_ready() {
  if (waiting_.empty()) return false;
  Waiting& first = waiting_.front();
  const bool posed = set_poses(first.decoded);
  return posed || ended_ || !has_poses_ || waiting_.size() > kMostWaiting ||
         now_ns_ - first.received_ns > kLongestWait_ns || now_ns_ < first.received_ns;
}

Decoded BagRecording::hand_out() {
  Decoded decoded = std::move(waiting_.front().decoded);
  waiting_.pop_front();
  return decoded;
}

Expected<void> BagRecording::read_message() {
  const auto message = bag_->next();
  if (!message) return Unexpected(message.error());
  if (*message) return take(**message);
  ended_ = true;
  return {};
}

Expected<std::optional<Decoded>> BagRecording::next() {
  while (true) {
    if (!errors_.empty()) {
      Error error = std::move(errors_.front());
      errors_.pop_front();
      return Unexpected(std::move(error));
    }
    if (is_ready()) return hand_out();
    if (feed_packets()) continue;
    if (told_) return std::nullopt;
    if (ended_) {
      told_ = true;
      judge_packets();
    } else if (auto read = read_message(); !read) {
      return Unexpected(std::move(read).error());
    }
  }
}

std::vector<Counter> BagRecording::counters() const {
  std::vector<Counter> out{{"messages received", of_scans_ + of_poses_ + of_others_ + rejected_},
                           {"messages of scans", of_scans_},
                           {"messages of poses", of_poses_},
                           {"messages of other topics", of_others_},
                           {"messages rejected", rejected_}};
  if (has_poses_) {
    out.insert(out.end(), {{"transforms received", transforms_used_ + transforms_rejected_},
                           {"transforms used", transforms_used_},
                           {"transforms rejected", transforms_rejected_}});
  }
  const auto add = [&](const std::vector<Counter>& more) { out.insert(out.end(), more.begin(), more.end()); };
  if (velodyne_) add(velodyne_->counters());
  add(bag_->counters());
  return out;
}

/// "/a (sensor_msgs/PointCloud2, 120 messages), /b (...)", the first few.
std::string listed(const std::vector<Topic>& topics, const std::vector<std::size_t>& which) {
  constexpr std::size_t kMost = 6;
  std::string out;
  for (std::size_t i = 0; i < which.size() && i < kMost; ++i) {
    const Topic& topic = topics[which[i]];
    out += fmt::format("{}{} ({}{})", i == 0 ? "" : ", ", topic.name, topic.type,
                       topic.unusable.empty() ? "" : ": " + topic.unusable);
  }
  if (which.size() > kMost) out += fmt::format(", and {} more", which.size() - kMost);
  return out;
}

std::vector<std::size_t> topics_with_scans(const std::vector<Topic>& topics) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].messages > 0 && holds_scans(topic_kind(topics[i]))) out.push_back(i);
  }
  return out;
}

std::vector<std::size_t> all_of(const std::vector<Topic>& topics) {
  std::vector<std::size_t> out(topics.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
  return out;
}

/// Whether the user's name means the topic; the leading '/' may be left out.
bool is_called(const Topic& topic, const std::string& name) {
  return topic.name == name || topic.name == "/" + name;
}

Expected<std::size_t> choose(const Bag& bag, const std::vector<Topic>& topics,
                             const std::vector<std::size_t>& with_scans,
                             const std::optional<std::string>& name) {
  if (with_scans.empty()) {
    return Unexpected(Error{ErrorCode::kUnusable,
                            bag.name(),
                            {},
                            "no topic has scans",
                            listed(topics, all_of(topics)),
                            "sensor_msgs/PointCloud2 or velodyne_msgs/VelodyneScan"});
  }
  if (name) {
    const auto found = std::find_if(with_scans.begin(), with_scans.end(),
                                    [&](std::size_t i) { return is_called(topics[i], *name); });
    if (found != with_scans.end()) return *found;
    return Unexpected(Error{
        ErrorCode::kUsage, bag.name(), {}, "this topic has no scans", *name, listed(topics, with_scans)});
  }
  if (with_scans.size() == 1) return with_scans.front();
  return Unexpected(Error{ErrorCode::kUsage,
                          bag.name(),
                          {},
                          "several topics have scans, choose --topic",
                          listed(topics, with_scans),
                          "one"});
}

}  // namespace

std::string Place::where(std::uint64_t byte) const {
  if (inside_of.empty()) return fmt::format("{}", offset + byte);
  return fmt::format("{}+{}", inside_of, offset + byte);
}

std::size_t find_or_add(std::vector<Topic>& topics, const Topic& topic) {
  const auto found = std::find_if(topics.begin(), topics.end(), [&](const Topic& known) {
    return known.name == topic.name && known.type == topic.type && known.wire == topic.wire &&
           known.unusable == topic.unusable;
  });
  const auto index = static_cast<std::size_t>(found - topics.begin());
  if (found == topics.end()) topics.push_back(topic);
  return index;
}

Expected<void> nothing_but_damage(const std::vector<Topic>& topics, const std::optional<Error>& trouble) {
  const bool any =
      std::any_of(topics.begin(), topics.end(), [](const Topic& topic) { return topic.messages > 0; });
  if (any || !trouble) return {};
  Error error = *trouble;
  if (error.code == ErrorCode::kDamaged) error.code = ErrorCode::kUnusable;
  return Unexpected(std::move(error));
}

Expected<std::unique_ptr<Recording>> open_bag(std::unique_ptr<Bag> bag, const RecordingOptions& options) {
  const auto& topics = bag->topics();
  const auto topic = choose(*bag, topics, topics_with_scans(topics), options.topic);
  if (!topic) return Unexpected(topic.error());
  const bool has_packets = topic_kind(topics[*topic]) == MessageKind::kVelodyneScan;
  auto recording = std::make_unique<BagRecording>(std::move(bag), *topic, options.log);
  if (!has_packets) return recording;
  if (auto begun = recording->begin_packets(options); !begun) return Unexpected(std::move(begun).error());
  return recording;
}

Expected<std::unique_ptr<Recording>> scans_of(Expected<std::unique_ptr<Bag>> bag,
                                              const RecordingOptions& options) {
  if (!bag) return Unexpected(std::move(bag).error());
  return open_bag(*std::move(bag), options);
}

}  // namespace verge::io
