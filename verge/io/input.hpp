// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <sys/types.h>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"

namespace verge::io {

/// pread(2), or a stand-in that fails on purpose.
using PreadFunction = ssize_t (*)(int fd, void* buffer, std::size_t count, off_t offset);

/// What one input may take.
struct InputLimits {
  std::uint64_t memory_max_bytes = 1ULL << 30;  ///< For everything that is made of this input.
  int timeout_ms = 5000;                        ///< For a pipe that sends nothing.
  PreadFunction pread = nullptr;                ///< None: the system's.
};

/// Memory without a value before it is read into; grows and is used again, scan after scan.
class Buffer {
 public:
  /// At least `size` bytes; what it held is gone.
  [[nodiscard]] std::span<std::byte> fresh(std::size_t size);
  /// `size` bytes, of which the first `kept` stay as they are.
  [[nodiscard]] std::span<std::byte> grown(std::size_t kept, std::size_t size);

 private:
  std::unique_ptr<std::byte[]> data_;
  std::size_t capacity_ = 0;
};

/// The bytes of one input: a file that is read only where asked (so that a header can be judged before its
/// data are touched, at 64-bit offsets), a pipe or device that is read to its end, or memory.
///
/// A regular file counts as long as it was when it was opened: what is appended later is not seen, and a file
/// that has become shorter is kDamaged. It is read, not mapped, since a mapped file that shrinks kills the
/// process.
class Input {
 public:
  /// Fails with kCannotOpen (missing, folder, no permission, link loop, name too long); a pipe or device is
  /// read to its end here: kTimeout where it sends nothing for `timeout_ms`, kLimit where it has no end.
  [[nodiscard]] static Expected<Input> open(const std::filesystem::path& path, const InputLimits& limits,
                                            Buffer buffer = {});
  /// Memory of the caller, which must outlive the Input. `name` stands in errors.
  [[nodiscard]] static Input of(Bytes bytes, std::string name, const InputLimits& limits = {});

  Input(Input&&) noexcept;
  Input& operator=(Input&&) noexcept;
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input();

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const InputLimits& limits() const { return limits_; }

  /// The bytes [offset, offset + length), valid until the next call. The caller has checked that they lie
  /// inside size(). Fails with kDamaged (the file became shorter, or the device reports an error) and kLimit.
  [[nodiscard]] Expected<Bytes> read(std::uint64_t offset, std::uint64_t length);
  /// The first bytes, at most `length`.
  [[nodiscard]] Expected<Bytes> head(std::uint64_t length);

  /// Whether `points` points and `extra` bytes beside them fit the memory that this input may take: the
  /// ceiling, and 16 MiB + 64 x its size (reliability B1). Fails with kLimit.
  [[nodiscard]] Expected<void> allow(std::uint64_t points, std::uint64_t extra) const;

  /// The buffer for the next input; this one is done.
  [[nodiscard]] Buffer take_buffer() && { return std::move(buffer_); }

  /// An error of this input at a byte offset.
  [[nodiscard]] Error error_at(ErrorCode code, std::uint64_t offset, std::string what, std::string got = {},
                               std::string need = {}) const;

 private:
  Input(std::string name, const InputLimits& limits);
  [[nodiscard]] Expected<void> read_stream();
  [[nodiscard]] Expected<std::size_t> read_stream_once(std::size_t have, std::size_t most);

  std::string name_;
  InputLimits limits_;
  int fd_ = -1;  // -1: memory_ has everything
  std::uint64_t size_ = 0;
  Bytes memory_;
  Buffer buffer_;
};

}  // namespace verge::io
