// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/input.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace verge::io {
namespace {

/// What a point takes on its way from the file to the Scan, at most: its columns in the Cloud and in the
/// Scan, and the keys by which it is sorted.
constexpr std::uint64_t kBytesPerPoint = 128;
constexpr std::uint64_t kFreeBytes = 16ULL << 20U;
constexpr std::uint64_t kBytesPerByteRead = 64;

Error cannot_open(const std::string& name, std::string why) {
  return {ErrorCode::kCannotOpen, name, {}, fmt::format("cannot open: {}", why), {}, {}};
}

int open_retrying(const char* path) {
  int fd = -1;
  do {
    // Not blocking: opening a FIFO that nobody writes would hang here.
    fd = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  } while (fd < 0 && errno == EINTR);
  return fd;
}

/// Whether there is something to read (or the end) before the time is over.
bool wait_readable(int fd, int timeout_ms) {
  pollfd waiting{fd, POLLIN, 0};
  int ready = -1;
  do {
    ready = ::poll(&waiting, 1, timeout_ms);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace

std::span<std::byte> Buffer::fresh(std::size_t size) {
  if (capacity_ < size) {
    data_.reset();
    data_ = std::make_unique_for_overwrite<std::byte[]>(size);
    capacity_ = size;
  }
  return {data_.get(), size};
}

std::span<std::byte> Buffer::grown(std::size_t kept, std::size_t size) {
  if (capacity_ < size) {
    auto larger = std::make_unique_for_overwrite<std::byte[]>(size);
    if (kept > 0) std::memcpy(larger.get(), data_.get(), kept);
    data_ = std::move(larger);
    capacity_ = size;
  }
  return {data_.get(), size};
}

Input::Input(std::string name, const InputLimits& limits) : name_(std::move(name)), limits_(limits) {
  if (limits_.pread == nullptr) limits_.pread = &::pread;
}

Input::Input(Input&& other) noexcept
    : name_(std::move(other.name_)),
      limits_(other.limits_),
      fd_(std::exchange(other.fd_, -1)),
      size_(other.size_),
      memory_(other.memory_),
      buffer_(std::move(other.buffer_)) {}

Input& Input::operator=(Input&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(limits_, other.limits_);
  std::swap(fd_, other.fd_);
  std::swap(size_, other.size_);
  std::swap(memory_, other.memory_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

Input::~Input() {
  if (fd_ >= 0) ::close(fd_);
}

Expected<Input> Input::open(const std::filesystem::path& path, const InputLimits& limits, Buffer buffer) {
  Input input(path.string(), limits);
  input.buffer_ = std::move(buffer);
  input.fd_ = open_retrying(path.c_str());
  if (input.fd_ < 0) return Unexpected(cannot_open(input.name_, std::strerror(errno)));
  struct stat status {};
  if (::fstat(input.fd_, &status) != 0) return Unexpected(cannot_open(input.name_, std::strerror(errno)));
  if (S_ISDIR(status.st_mode)) return Unexpected(cannot_open(input.name_, "it is a folder"));
  if (S_ISREG(status.st_mode)) {
    input.size_ = static_cast<std::uint64_t>(status.st_size);
    return input;
  }
  if (auto read = input.read_stream(); !read) return Unexpected(read.error());
  return input;
}

Input Input::of(Bytes bytes, std::string name, const InputLimits& limits) {
  Input input(std::move(name), limits);
  input.memory_ = bytes;
  input.size_ = bytes.size();
  return input;
}

/// One read of a stream behind the `have` bytes that are there; 0 at its end.
Expected<std::size_t> Input::read_stream_once(std::size_t have, std::size_t most) {
  while (true) {
    if (!wait_readable(fd_, limits_.timeout_ms)) {
      return Unexpected(
          error_at(ErrorCode::kTimeout, have, fmt::format("no data for {} ms", limits_.timeout_ms)));
    }
    const ssize_t n = ::read(fd_, buffer_.grown(have, have + most).data() + have, most);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno == EINTR || errno == EAGAIN) continue;
    return Unexpected(
        error_at(ErrorCode::kDamaged, have, fmt::format("cannot read: {}", std::strerror(errno))));
  }
}

/// A pipe or device to its end, into the buffer, which doubles as it fills; half the memory is its share.
Expected<void> Input::read_stream() {
  const std::size_t most = static_cast<std::size_t>(limits_.memory_max_bytes / 2);
  std::size_t have = 0;
  std::size_t room = std::min<std::size_t>(most, 1U << 16U);
  while (true) {
    static_cast<void>(buffer_.grown(have, room));
    const auto n = read_stream_once(have, room - have);
    if (!n) return Unexpected(n.error());
    if (*n == 0) break;
    have += *n;
    if (have < room) continue;
    if (room == most) {
      return Unexpected(error_at(ErrorCode::kLimit, have, "stream is longer than the memory allowed for it",
                                 fmt::format(">= {} B", have), fmt::format("< {} B", most)));
    }
    room = std::min(most, 2 * room);
  }
  ::close(std::exchange(fd_, -1));
  size_ = have;
  memory_ = buffer_.grown(have, have);
  return {};
}

Expected<Bytes> Input::read(std::uint64_t offset, std::uint64_t length) {
  if (fd_ < 0) return memory_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
  if (length > limits_.memory_max_bytes / 2) {
    return Unexpected(error_at(ErrorCode::kLimit, offset, "needs more memory than allowed",
                               fmt::format("{} B", length),
                               fmt::format("<= {} B", limits_.memory_max_bytes / 2)));
  }
  const std::span<std::byte> out = buffer_.fresh(static_cast<std::size_t>(length));
  std::size_t have = 0;
  while (have < out.size()) {
    const ssize_t n =
        limits_.pread(fd_, out.data() + have, out.size() - have, static_cast<off_t>(offset + have));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      return Unexpected(
          error_at(ErrorCode::kDamaged, offset + have, fmt::format("cannot read: {}", std::strerror(errno))));
    }
    if (n == 0) {
      return Unexpected(error_at(ErrorCode::kDamaged, offset + have, "file became shorter while it was read",
                                 fmt::format("{} B", offset + have), fmt::format("{} B", size_)));
    }
    have += static_cast<std::size_t>(n);
  }
  return Bytes(out);
}

Expected<Bytes> Input::head(std::uint64_t length) { return read(0, std::min(length, size_)); }

Expected<void> Input::allow(std::uint64_t points, std::uint64_t extra) const {
  const std::uint64_t by_size = size_ > (limits_.memory_max_bytes / kBytesPerByteRead)
                                    ? limits_.memory_max_bytes
                                    : kFreeBytes + kBytesPerByteRead * size_;
  const std::uint64_t most = std::min(limits_.memory_max_bytes, by_size);
  if (extra <= most && points <= (most - extra) / kBytesPerPoint) return {};
  return Unexpected(error_at(ErrorCode::kLimit, 0, "needs more memory than allowed",
                             fmt::format("{} points and {} B", points, extra), fmt::format("<= {} B", most)));
}

Error Input::error_at(ErrorCode code, std::uint64_t offset, std::string what, std::string got,
                      std::string need) const {
  return {code, name_, fmt::format("{}", offset), std::move(what), std::move(got), std::move(need)};
}

}  // namespace verge::io
