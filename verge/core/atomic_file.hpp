// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "verge/core/error.hpp"

namespace verge {

/// A file that appears whole or not at all: bytes go to a temporary file in the target's folder; commit()
/// syncs it and renames it over the target. Without commit(), or on any error, the temporary file goes and
/// the old target stays byte for byte. A target that is a device, a FIFO or a socket (/dev/stdout, /dev/full)
/// is written directly. A symbolic link is followed once, so that the file it names is replaced and the link
/// stays.
class AtomicFile {
 public:
  /// Fails with kCannotWrite (folder missing or read-only, target is a folder or marked read-only, name too
  /// long).
  [[nodiscard]] static Expected<AtomicFile> create(const std::filesystem::path& target);

  /// The standard output of this program, written directly: it belongs to whoever started us, so that it is
  /// never renamed over, even where it is a file. Fails with kCannotWrite where it is closed.
  [[nodiscard]] static Expected<AtomicFile> standard_output();

  /// Whether the bytes go straight to their reader (a device, a FIFO, standard output).
  [[nodiscard]] bool is_direct() const;

  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Appends bytes (buffered). After a failure every further call fails likewise.
  [[nodiscard]] Expected<void> write(std::string_view bytes);

  /// Hands buffered bytes to the system now: for a direct target (a pipe, a terminal) whose reader waits for
  /// each record. For a file that is yet to appear it does nothing.
  [[nodiscard]] Expected<void> flush();

  /// Flush, fsync, rename, fsync of the folder. Call once; the object is done afterwards.
  [[nodiscard]] Expected<void> commit();

 private:
  struct State;
  explicit AtomicFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The whole of `bytes` as the file `target`, atomically.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace verge
