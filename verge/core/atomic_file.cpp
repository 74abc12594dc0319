// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/core/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

namespace verge {
namespace fs = std::filesystem;

struct AtomicFile::State {
  fs::path target;
  fs::path temporary;  // empty: the target is written directly
  int fd = -1;
  std::string buffer;
  std::optional<Error> failure;
};

namespace {

constexpr std::size_t kBufferSize = 1U << 16U;

/// EPIPE comes only where the program ignores SIGPIPE, and only from a direct target.
Error write_error(const fs::path& file, std::string_view doing) {
  return {errno == EPIPE ? ErrorCode::kReaderGone : ErrorCode::kCannotWrite,
          file.string(),
          {},
          fmt::format("cannot {}: {}", doing, std::strerror(errno)),
          {},
          {}};
}

/// What the path names once links are followed: the rename must not replace a link by a file.
fs::path resolve_link(const fs::path& target) {
  std::error_code ignored;
  if (!fs::is_symlink(target, ignored)) return target;
  std::error_code error;
  fs::path resolved = fs::weakly_canonical(target, error);
  return error ? target : resolved;
}

bool names_a_stream(const fs::path& target) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

/// A name that nobody else uses: O_EXCL is the guarantee, the random part only makes a clash unlikely. A long
/// name is cut, since the file system's limit holds for the temporary name too.
fs::path temporary_name(const fs::path& target) {
  constexpr std::size_t kLongestName = 200;
  const std::string name = target.filename().string().substr(0, kLongestName);
  return folder_of(target) / fmt::format(".{}.tmp.{}.{:08x}", name, ::getpid(), std::random_device{}());
}

int open_retrying(const fs::path& path, int flags, mode_t mode) {
  int fd = -1;
  do {
    fd = ::open(path.c_str(), flags, mode);
  } while (fd < 0 && errno == EINTR);
  return fd;
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

bool sync_folder(const fs::path& folder) {
  const int fd = open_retrying(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0 || errno == EINVAL;  // some file systems cannot sync a folder
  ::close(fd);
  return synced;
}

}  // namespace

AtomicFile::AtomicFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
AtomicFile::AtomicFile(AtomicFile&&) noexcept = default;

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (!state_ || state_->fd < 0) return;
  ::close(state_->fd);
  if (!state_->temporary.empty()) ::unlink(state_->temporary.c_str());
}

Expected<AtomicFile> AtomicFile::create(const fs::path& target) {
  auto state = std::make_unique<State>();
  state->target = resolve_link(target);
  std::error_code ignored;
  if (fs::is_directory(state->target, ignored)) {
    return Unexpected({ErrorCode::kCannotWrite, target.string(), {}, "cannot write: it is a folder", {}, {}});
  }
  // The rename would succeed on a file that its owner marked read-only: that mark is a wish to keep it.
  if (fs::exists(state->target, ignored) && ::access(state->target.c_str(), W_OK) != 0) {
    return Unexpected(write_error(target, "write"));
  }
  constexpr mode_t kMode = 0644;
  if (names_a_stream(state->target)) {
    state->fd = open_retrying(state->target, O_WRONLY | O_CLOEXEC, kMode);
  } else {
    state->temporary = temporary_name(state->target);
    state->fd = open_retrying(state->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode);
  }
  if (state->fd < 0) return Unexpected(write_error(target, "write"));
  return AtomicFile(std::move(state));
}

Expected<AtomicFile> AtomicFile::standard_output() {
  auto state = std::make_unique<State>();
  state->target = "standard output";
  state->fd = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  if (state->fd < 0) return Unexpected(write_error(state->target, "write"));
  return AtomicFile(std::move(state));
}

bool AtomicFile::is_direct() const { return state_->temporary.empty(); }

Expected<void> AtomicFile::write(std::string_view bytes) {
  if (state_->failure) return Unexpected(*state_->failure);
  state_->buffer.append(bytes);
  if (state_->buffer.size() < kBufferSize) return {};
  if (!write_all(state_->fd, state_->buffer)) {
    state_->failure = write_error(state_->target, "write");
    return Unexpected(*state_->failure);
  }
  state_->buffer.clear();
  return {};
}

Expected<void> AtomicFile::flush() {
  if (state_->failure) return Unexpected(*state_->failure);
  if (!state_->temporary.empty()) return {};
  if (!write_all(state_->fd, state_->buffer)) {
    state_->failure = write_error(state_->target, "write");
    return Unexpected(*state_->failure);
  }
  state_->buffer.clear();
  return {};
}

Expected<void> AtomicFile::commit() {
  const std::unique_ptr<State> state = std::move(state_);
  const auto fail = [&](std::string_view doing) -> Expected<void> {
    Error error = write_error(state->target, doing);
    if (state->fd >= 0) ::close(state->fd);
    if (!state->temporary.empty()) ::unlink(state->temporary.c_str());
    return Unexpected(std::move(error));
  };
  if (state->failure) {
    ::close(state->fd);
    if (!state->temporary.empty()) ::unlink(state->temporary.c_str());
    return Unexpected(*state->failure);
  }
  if (!write_all(state->fd, state->buffer)) return fail("write");
  if (!state->temporary.empty() && ::fsync(state->fd) != 0) return fail("sync");
  const int fd = std::exchange(state->fd, -1);
  if (::close(fd) != 0) return fail("close");
  if (state->temporary.empty()) return {};
  if (::rename(state->temporary.c_str(), state->target.c_str()) != 0) return fail("rename");
  state->temporary.clear();
  if (!sync_folder(folder_of(state->target))) return fail("sync the folder of");
  return {};
}

Expected<void> write_file(const fs::path& target, std::string_view bytes) {
  auto file = AtomicFile::create(target);
  if (!file) return Unexpected(file.error());
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

}  // namespace verge
