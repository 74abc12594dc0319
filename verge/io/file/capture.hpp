// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/input.hpp"

namespace verge::io {

/// A captured frame; its bytes are valid until the next call.
struct CapturedFrame {
  std::int64_t time_ns = 0;  ///< Since the Unix epoch.
  bool cut = false;          ///< The capture kept only the first bytes of the frame.
  bool odd_time = false;     ///< A fraction of a second beyond a second.
  std::uint64_t offset = 0;  ///< Of the record in the file.
  Bytes bytes;
};

/// Records of a capture file, pcap or pcapng, through libpcap. libpcap is handed only what has been checked
/// before: lengths of records and blocks against the limits and against the bytes that are left.
class Capture {
 public:
  /// Fails with kUnusable where the file header is cut or is not one, or the link type is one of which UDP
  /// cannot be read.
  [[nodiscard]] static Expected<Capture> open(Input input);
  Capture(Capture&&) noexcept;
  Capture& operator=(Capture&&) noexcept;
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  ~Capture();

  /// The next frame; none at the end. kDamaged: a record cannot be read, nor any after it.
  [[nodiscard]] Expected<std::optional<CapturedFrame>> next();

  [[nodiscard]] int link_type() const;
  [[nodiscard]] const Input& input() const;
  /// The file again from its begin.
  [[nodiscard]] static Expected<Capture> reopen(Capture capture);

 private:
  struct State;
  explicit Capture(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace verge::io
