// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/rosbag2.hpp"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/chunk.hpp"
#include "verge/io/file/mcap.hpp"
#include "verge/io/file/packing.hpp"
#include "verge/io/file/sqlite.hpp"
#include "verge/io/files.hpp"

namespace verge::io {
namespace {

class Db3Bag final : public Bag {
 public:
  explicit Db3Bag(SqliteFile file) : file_(std::move(file)) {}

  /// Reads the table of topics and goes to the first message.
  [[nodiscard]] Expected<void> open();

  [[nodiscard]] std::vector<Topic>& topics() override { return topics_; }
  [[nodiscard]] Expected<std::optional<Message>> next() override;
  [[nodiscard]] std::vector<Counter> counters() const override;
  [[nodiscard]] const std::string& name() const override { return file_.input().name(); }
  [[nodiscard]] Expected<void> allow(std::uint64_t points) const override {
    return file_.input().allow(points, 0);
  }

 private:
  [[nodiscard]] Expected<void> read_topics();
  [[nodiscard]] std::optional<Error> count_messages();
  [[nodiscard]] Expected<Message> read_row();
  [[nodiscard]] Expected<Bytes> unpacked(Bytes packed, const Place& place);
  [[nodiscard]] Error error(const Place& place, std::string what, std::string got = {},
                            std::string need = {}) const;

  SqliteFile file_;
  std::optional<SqliteRows> rows_;  // before file_ goes
  Buffer unpacked_;
  std::vector<Topic> topics_;
  std::map<std::int64_t, std::size_t> ids_;  // index of the topic
  std::uint64_t received_ = 0, rejected_ = 0;
};

Error Db3Bag::error(const Place& place, std::string what, std::string got, std::string need) const {
  return {ErrorCode::kDamaged, name(), place.where(), std::move(what), std::move(got), std::move(need)};
}

Expected<void> Db3Bag::read_topics() {
  auto rows = file_.query("SELECT id, name, type, serialization_format FROM topics");
  if (!rows) return Unexpected(std::move(rows).error());
  while (true) {
    const auto more = rows->next();
    if (!more) return Unexpected(more.error());
    if (!*more) return {};
    Topic topic;
    topic.name = rows->text(1);
    topic.type = rows->text(2);
    const std::string format = rows->text(3);
    if (format != "cdr") topic.unusable = fmt::format("serialization {}, not cdr", format);
    ids_[rows->integer(0)] = find_or_add(topics_, topic);
  }
}

/// Messages of the topics, up to where the table is damaged.
std::optional<Error> Db3Bag::count_messages() {
  auto rows = file_.query("SELECT topic_id FROM messages NOT INDEXED");
  if (!rows) return std::move(rows).error();
  while (true) {
    const auto more = rows->next();
    if (!more) return more.error();
    if (!*more) return std::nullopt;
    const auto topic = ids_.find(rows->integer(0));
    if (topic != ids_.end()) ++topics_[topic->second].messages;
  }
}

Expected<void> Db3Bag::open() {
  for (const char* table : {"topics", "messages"}) {
    const auto found = file_.has_table(table);
    if (!found) return Unexpected(found.error());
    if (!*found) {
      return Unexpected(Error{ErrorCode::kUnusable,
                              name(),
                              {},
                              "database is no recording of rosbag2",
                              fmt::format("no table {}", table),
                              "tables topics and messages"});
    }
  }
  if (auto read = read_topics(); !read) return read;
  // Damage is said where the messages are read, unless none can be.
  if (auto usable = nothing_but_damage(topics_, count_messages()); !usable) return usable;
  // In the order of the rows, which is that of recording: sorting by time would need an index, or all of them
  // in memory.
  auto rows = file_.query("SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED");
  if (!rows) return Unexpected(std::move(rows).error());
  rows_ = *std::move(rows);
  return {};
}

/// rosbag2 compresses messages one by one, if at all, with zstd; a CDR message never begins as that does.
Expected<Bytes> Db3Bag::unpacked(Bytes packed, const Place& place) {
  if (!is_zstd(packed)) return packed;
  constexpr std::uint64_t kGreatestRatio = 1024;
  const auto size = zstd_size(packed);
  const bool fits =
      size && *size / kGreatestRatio <= packed.size() && file_.input().allow(0, *size).has_value();
  if (!fits) {
    Error too_large = error(place, "packed message does not tell a size that is allowed",
                            size ? fmt::format("{} B", *size) : "none");
    too_large.code = ErrorCode::kLimit;
    return Unexpected(std::move(too_large));
  }
  const std::span<std::byte> out = unpacked_.fresh(static_cast<std::size_t>(*size));
  if (!unpack(Packing::kZstd, packed, out)) return Unexpected(error(place, "packed message is damaged"));
  return Bytes(out);
}

Expected<Message> Db3Bag::read_row() {
  Message message;
  message.place.inside_of = fmt::format("messages row {}", rows_->integer(0));
  const auto topic = ids_.find(rows_->integer(1));
  if (topic == ids_.end()) {
    return Unexpected(
        error(message.place, "message of an unknown topic", fmt::format("{}", rows_->integer(1))));
  }
  message.topic = topic->second;
  message.received_ns = rows_->integer(2);
  if (!topics_[message.topic].wanted) return message;
  const auto data = rows_->blob(3);
  if (!data) return Unexpected(error(message.place, "message has no data"));
  auto bytes = unpacked(*data, message.place);
  if (!bytes) return Unexpected(std::move(bytes).error());
  message.data = *bytes;
  return message;
}

Expected<std::optional<Message>> Db3Bag::next() {
  if (!rows_) return std::nullopt;
  const auto more = rows_->next();
  if (!more) {
    rows_.reset();
    ++received_;
    ++rejected_;
    return Unexpected(more.error());
  }
  if (!*more) {
    rows_.reset();
    auto whole = file_.check_whole();
    if (whole) return std::nullopt;
    ++received_;
    ++rejected_;
    return Unexpected(std::move(whole).error());
  }
  ++received_;
  auto message = read_row();
  if (message) return *std::move(message);
  ++rejected_;
  return Unexpected(std::move(message).error());
}

std::vector<Counter> Db3Bag::counters() const {
  return {{"rows received", received_}, {"rows used", received_ - rejected_}, {"rows rejected", rejected_}};
}

/// rosbag2 can compress each file as a whole when it is done with it.
bool is_packed_file(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".db3.zstd") || name.ends_with(".mcap.zstd");
}

Expected<std::unique_ptr<Bag>> open_any(const std::filesystem::path& path, const InputLimits& limits) {
  auto input = Input::open(path, limits);
  if (!input) return Unexpected(std::move(input).error());
  if (is_packed_file(path)) {
    return Unexpected(
        input->error_at(ErrorCode::kUnusable, 0, "is compressed with zstd: unpack it first (zstd -d)"));
  }
  return path.extension() == ".mcap" ? open_mcap_bag(*std::move(input)) : open_db3_bag(*std::move(input));
}

/// Several files as one recording; one of them is open at a time.
class FolderBag final : public Bag {
 public:
  FolderBag(std::vector<std::filesystem::path> files, const InputLimits& limits)
      : files_(std::move(files)), limits_(limits), name_(files_.front().parent_path().string()) {}

  /// The topics of all files.
  [[nodiscard]] Expected<void> open(const Log& log);

  [[nodiscard]] std::vector<Topic>& topics() override { return topics_; }
  [[nodiscard]] Expected<std::optional<Message>> next() override;
  [[nodiscard]] std::vector<Counter> counters() const override;
  [[nodiscard]] const std::string& name() const override { return bag_ ? bag_->name() : name_; }
  [[nodiscard]] Expected<void> allow(std::uint64_t points) const override {
    return bag_ ? bag_->allow(points) : Expected<void>{};
  }

 private:
  [[nodiscard]] std::size_t own_topic(std::size_t topic);
  void close();

  std::vector<std::filesystem::path> files_;
  InputLimits limits_;
  std::string name_;
  std::vector<Topic> topics_;
  std::size_t next_ = 0;  // file to open
  std::unique_ptr<Bag> bag_;
  std::vector<std::size_t> own_;  // index in topics_ by the topic of bag_
  std::vector<Counter> counted_;  // in the files before
};

/// Sums counters by name.
void add_counters(std::vector<Counter>& sums, const std::vector<Counter>& more) {
  for (const Counter& counter : more) {
    const auto found =
        std::find_if(sums.begin(), sums.end(), [&](const Counter& sum) { return sum.name == counter.name; });
    if (found == sums.end()) {
      sums.push_back(counter);
    } else {
      found->count += counter.count;
    }
  }
}

Expected<void> FolderBag::open(const Log& log) {
  std::optional<Error> trouble;
  for (const auto& file : files_) {
    warn_of_wal(file, log);
    const auto bag = open_any(file, limits_);
    if (!bag) {  // said when its turn comes, if that ever does
      if (!trouble) trouble = bag.error();
      continue;
    }
    for (const Topic& topic : (*bag)->topics()) {
      topics_[find_or_add(topics_, topic)].messages += topic.messages;
    }
  }
  return nothing_but_damage(topics_, trouble);
}

/// The index of a topic of the open file in ours; tells the file whether somebody wants it.
std::size_t FolderBag::own_topic(std::size_t topic) {
  while (own_.size() <= topic) {
    Topic& theirs = bag_->topics()[own_.size()];
    own_.push_back(find_or_add(topics_, theirs));
    theirs.wanted = topics_[own_.back()].wanted;
  }
  return own_[topic];
}

void FolderBag::close() {
  add_counters(counted_, bag_->counters());
  bag_.reset();
  own_.clear();
}

Expected<std::optional<Message>> FolderBag::next() {
  while (true) {
    if (!bag_) {
      if (next_ == files_.size()) return std::nullopt;
      auto bag = open_any(files_[next_++], limits_);
      if (!bag) return Unexpected(std::move(bag).error());
      bag_ = *std::move(bag);
      if (!bag_->topics().empty()) static_cast<void>(own_topic(bag_->topics().size() - 1));
    }
    auto message = bag_->next();
    if (!message) return message;
    if (*message) {
      (*message)->topic = own_topic((*message)->topic);
      return message;
    }
    close();
  }
}

std::vector<Counter> FolderBag::counters() const {
  std::vector<Counter> out = counted_;
  if (bag_) add_counters(out, bag_->counters());
  return out;
}

}  // namespace

Expected<std::unique_ptr<Bag>> open_db3_bag(Input input) {
  auto file = SqliteFile::open(std::move(input));
  if (!file) return Unexpected(std::move(file).error());
  auto bag = std::make_unique<Db3Bag>(*std::move(file));
  if (auto opened = bag->open(); !opened) {
    Error error = std::move(opened).error();
    if (error.code == ErrorCode::kDamaged) error.code = ErrorCode::kUnusable;  // nothing could be read
    return Unexpected(std::move(error));
  }
  return bag;
}

void warn_of_wal(const std::filesystem::path& db3, const Log& log) {
  constexpr std::uintmax_t kWalHeaderBytes = 32;
  std::filesystem::path wal = db3;
  wal += "-wal";
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(wal, missing);
  if (missing || size <= kWalHeaderBytes) return;
  warn(log,
       fmt::format("{}: the recorder's WAL is not read, messages in it are missing ({} B); let SQLite take "
                   "it in: sqlite3 FILE 'PRAGMA wal_checkpoint(TRUNCATE)'",
                   wal.string(), size));
}

Expected<std::unique_ptr<Recording>> open_db3(Input input, const RecordingOptions& options) {
  return scans_of(open_db3_bag(std::move(input)), options);
}

std::vector<std::filesystem::path> find_rosbag2_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code failed;
  for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    const auto suffix = at->path().extension();
    if (suffix == ".db3" || suffix == ".mcap" || is_packed_file(at->path())) out.push_back(at->path());
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return out;
}

Expected<std::unique_ptr<Recording>> open_rosbag2_folder(const std::filesystem::path& folder,
                                                         const InputLimits& limits,
                                                         const RecordingOptions& options) {
  auto files = find_rosbag2_files(folder);
  if (files.empty()) {
    return Unexpected(Error{ErrorCode::kUnusable,
                            folder.string(),
                            {},
                            "folder has no recording of rosbag2",
                            {},
                            ".db3 or .mcap"});
  }
  auto bag = std::make_unique<FolderBag>(std::move(files), limits);
  if (auto opened = bag->open(options.log); !opened) return Unexpected(std::move(opened).error());
  return open_bag(std::move(bag), options);
}

}  // namespace verge::io
