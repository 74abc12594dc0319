// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/capture.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <pcap/pcap.h>

#include "verge/io/file/datagram.hpp"

namespace verge::io {
namespace {

constexpr std::uint64_t kFileHeader = 24;
constexpr std::uint64_t kRecordHeader = 16;
constexpr std::uint64_t kMostFrame = 262'144;
constexpr std::uint64_t kMostBlock = 16ULL << 20U;
constexpr std::uint32_t kSectionBlock = 0x0A0D0D0A;

struct CloseFile {
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this is what owns it
  void operator()(std::FILE* file) const { static_cast<void>(std::fclose(file)); }
};

struct CloseCapture {
  void operator()(pcap_t* capture) const { pcap_close(capture); }
};

}  // namespace

/// Bytes of the input, some of them read ahead, and how far libpcap has come.
struct Capture::State {
  Input input;
  std::uint64_t at = 0;         // what libpcap reads next
  std::uint64_t served = 0;     // what its file's buffer reads next
  std::uint64_t window_at = 0;  // what was read ahead
  std::vector<std::byte> window;
  std::optional<Error> failed;  // of the input
  std::unique_ptr<pcap_t, CloseCapture> capture;
  bool blocks = false;   // pcapng
  bool swapped = false;  // of the file, or of the section
  bool nanoseconds = false;
  bool ended = false;
  std::vector<std::byte> frame;

  explicit State(Input from) : input(std::move(from)) {}

  [[nodiscard]] std::uint64_t left() const { return input.size() - at; }

  /// Up to `length` bytes at `offset`; fewer at the end of the file.
  Bytes peek(std::uint64_t offset, std::uint64_t length) {
    constexpr std::uint64_t kAhead = 1ULL << 16U;
    length = std::min(length, input.size() - std::min(offset, input.size()));
    if (offset < window_at || offset + length > window_at + window.size()) {
      const std::uint64_t ahead =
          std::min(std::max(length, kAhead), input.size() - std::min(offset, input.size()));
      const auto bytes = input.read(std::min(offset, input.size()), ahead);
      if (!bytes) {
        failed = bytes.error();
        return {};
      }
      window.assign(bytes->begin(), bytes->end());
      window_at = offset;
    }
    return Bytes(window).subspan(static_cast<std::size_t>(offset - window_at),
                                 static_cast<std::size_t>(length));
  }

  [[nodiscard]] std::uint32_t word(Bytes bytes, std::size_t offset) const {
    return swapped ? load_be<std::uint32_t>(bytes, offset) : load_le<std::uint32_t>(bytes, offset);
  }

  [[nodiscard]] Error damaged(std::uint64_t offset, std::string what, std::string got,
                              std::string need) const {
    return input.error_at(ErrorCode::kDamaged, offset, std::move(what), std::move(got), std::move(need));
  }

  static ssize_t read_on(void* cookie, char* buffer, std::size_t size);
  static int seek(void* cookie, off64_t* offset, int whence);
  void note_place();
  Expected<void> open();
  Expected<void> recognise();
  Expected<bool> check_record();
  Expected<bool> check_blocks();
  Expected<void> check_block(std::uint64_t offset, std::uint32_t type, std::uint64_t length);
};

/// What libpcap's file reads.
ssize_t Capture::State::read_on(void* cookie, char* buffer, std::size_t size) {
  auto& self = *static_cast<State*>(cookie);
  const Bytes bytes = self.peek(self.served, size);
  if (!bytes.empty()) std::memcpy(buffer, bytes.data(), bytes.size());
  self.served += bytes.size();
  return static_cast<ssize_t>(bytes.size());
}

/// For ftello() alone, which takes what its buffer holds off this: libpcap reads forward.
int Capture::State::seek(void* cookie, off64_t* offset, int whence) {
  if (whence != SEEK_CUR || *offset != 0) return -1;
  *offset = static_cast<off64_t>(static_cast<State*>(cookie)->served);
  return 0;
}

/// Behind what libpcap has read. An unbuffered file would be where it stands, but reads byte by byte.
void Capture::State::note_place() {
  at = static_cast<std::uint64_t>(std::max<off_t>(0, ftello(pcap_file(capture.get()))));
}

/// By the magic number: which format, whose byte order, what fractions of a second.
Expected<void> Capture::State::recognise() {
  const Bytes head = peek(0, kFileHeader);
  const auto unusable = [&](std::string what) {
    return Unexpected(input.error_at(ErrorCode::kUnusable, 0, std::move(what)));
  };
  if (head.size() < 4) return unusable("too short for a capture");
  const auto magic = load_le<std::uint32_t>(head, 0);
  const auto magic_be = load_be<std::uint32_t>(head, 0);
  constexpr std::uint32_t kMicro = 0xA1B2C3D4;
  constexpr std::uint32_t kNano = 0xA1B23C4D;
  blocks = magic == kSectionBlock;
  swapped = magic_be == kMicro || magic_be == kNano;
  nanoseconds = magic == kNano || magic_be == kNano;
  const bool known = blocks || swapped || magic == kMicro || nanoseconds;
  if (!known) return unusable("not a capture: no magic number of pcap or pcapng");
  if (head.size() < kFileHeader) return unusable("the file header is cut");
  return {};
}

Expected<void> Capture::State::open() {
  if (auto known = recognise(); !known) return known;
  if (blocks) {
    const auto checked = check_blocks();  // what pcap_fopen_offline reads must be sound too
    if (!checked) {
      Error error = checked.error();
      error.code = ErrorCode::kUnusable;
      return Unexpected(error);
    }
  }
  std::unique_ptr<std::FILE, CloseFile> file(
      fopencookie(this, "r", {&State::read_on, nullptr, &State::seek, nullptr}));
  if (!file) return Unexpected(input.error_at(ErrorCode::kUnusable, 0, "cannot read the capture"));
  std::array<char, PCAP_ERRBUF_SIZE> reason{};
  capture.reset(
      pcap_fopen_offline_with_tstamp_precision(file.get(), PCAP_TSTAMP_PRECISION_NANO, reason.data()));
  if (!capture) {
    if (failed) return Unexpected(*failed);
    return Unexpected(input.error_at(ErrorCode::kUnusable, served, reason.data()));
  }
  static_cast<void>(file.release());  // closed with the capture
  note_place();
  const int link = pcap_datalink(capture.get());
  if (DatagramReader::reads(link)) return {};
  return Unexpected(input.error_at(ErrorCode::kUnusable, 20, "frames of this link type cannot be read",
                                   fmt::format("link type {}", link),
                                   "Ethernet, Linux cooked, raw IP or loopback"));
}

/// Whether a record follows; an Error where it is not sound.
Expected<bool> Capture::State::check_record() {
  if (left() == 0) return false;
  const Bytes header = peek(at, kRecordHeader);
  if (failed) return Unexpected(*failed);
  if (header.size() < kRecordHeader) {
    return Unexpected(damaged(at, "the record header is cut", fmt::format("{} B", header.size()), "16 B"));
  }
  const std::uint64_t length = word(header, 8);
  if (length > kMostFrame) {
    return Unexpected(damaged(at + 8, "record length exceeds the limit", fmt::format("{}", length),
                              fmt::format("<= {}", kMostFrame)));
  }
  if (length > left() - kRecordHeader) {
    return Unexpected(damaged(at + 8, "the record is cut: its length exceeds the file",
                              fmt::format("{}", length), fmt::format("<= {}", left() - kRecordHeader)));
  }
  return true;
}

Expected<void> Capture::State::check_block(std::uint64_t offset, std::uint32_t type, std::uint64_t length) {
  const std::uint64_t rest = input.size() - offset;
  if (length < 12 || length % 4 != 0 || length > kMostBlock || length > rest) {
    return Unexpected(damaged(offset + 4, "block length is not possible", fmt::format("{}", length),
                              fmt::format("a multiple of 4, 12..{}", std::min(kMostBlock, rest))));
  }
  const Bytes tail = peek(offset + length - 4, 4);
  if (failed) return Unexpected(*failed);
  if (word(tail, 0) != length) {
    return Unexpected(damaged(offset + length - 4, "the block's two lengths differ",
                              fmt::format("{}", word(tail, 0)), fmt::format("{}", length)));
  }
  constexpr std::uint32_t kEnhancedPacket = 6;
  if (type != kEnhancedPacket) return {};
  const Bytes head = peek(offset, 32);
  if (length < 32 || word(head, 20) > length - 32) {
    return Unexpected(damaged(offset + 20, "captured length exceeds its block",
                              length < 32 ? std::string("no header") : fmt::format("{}", word(head, 20)),
                              fmt::format("<= {}", length < 32 ? 0 : length - 32)));
  }
  return {};
}

/// Whether a packet's block follows, past blocks of other kinds; an Error where one of them is not sound.
Expected<bool> Capture::State::check_blocks() {
  std::uint64_t offset = at;
  while (offset < input.size()) {
    const Bytes header = peek(offset, 12);
    if (failed) return Unexpected(*failed);
    if (header.size() < 12) {
      return Unexpected(
          damaged(offset, "the block header is cut", fmt::format("{} B", header.size()), "12 B"));
    }
    constexpr std::uint32_t kByteOrder = 0x1A2B3C4D;
    if (load_le<std::uint32_t>(header, 0) == kSectionBlock)
      swapped = load_be<std::uint32_t>(header, 8) == kByteOrder;
    const std::uint32_t type = word(header, 0);
    const std::uint64_t length = word(header, 4);
    if (auto checked = check_block(offset, type, length); !checked) return Unexpected(checked.error());
    const bool holds_packet = type == 2 || type == 3 || type == 6;
    if (holds_packet) return true;
    offset += length;
  }
  return false;
}

Capture::Capture(std::unique_ptr<State> state) : state_(std::move(state)) {}
Capture::Capture(Capture&&) noexcept = default;
Capture& Capture::operator=(Capture&&) noexcept = default;
Capture::~Capture() = default;

int Capture::link_type() const { return pcap_datalink(state_->capture.get()); }
const Input& Capture::input() const { return state_->input; }

Expected<Capture> Capture::open(Input input) {
  auto state = std::make_unique<State>(std::move(input));
  if (auto opened = state->open(); !opened) return Unexpected(opened.error());
  return Capture(std::move(state));
}

Expected<Capture> Capture::reopen(Capture capture) {
  capture.state_->capture.reset();
  return open(std::move(capture.state_->input));
}

Expected<std::optional<CapturedFrame>> Capture::next() {
  State& state = *state_;
  if (state.ended) return std::nullopt;
  const auto stop = [&](Error error) {
    state.ended = true;
    return Unexpected(std::move(error));
  };
  const std::uint64_t offset = state.at;
  const auto follows = state.blocks ? state.check_blocks() : state.check_record();
  if (!follows) return stop(follows.error());
  if (!*follows) {
    state.ended = true;
    return std::nullopt;
  }
  const std::uint32_t fraction = state.blocks ? 0 : state.word(state.peek(offset, kRecordHeader), 4);
  pcap_pkthdr* header = nullptr;
  const u_char* data = nullptr;
  if (pcap_next_ex(state.capture.get(), &header, &data) != 1) {
    if (state.failed) return stop(*state.failed);
    return stop(state.damaged(offset, pcap_geterr(state.capture.get()), {}, {}));
  }
  state.note_place();
  const auto* const bytes = reinterpret_cast<const std::byte*>(data);
  state.frame.assign(bytes, bytes + header->caplen);
  CapturedFrame frame{.offset = offset, .bytes = state.frame};
  frame.cut = header->caplen < header->len;
  const std::int64_t unit_ns = state.nanoseconds ? 1 : 1000;
  const std::int64_t part_ns = state.blocks ? header->ts.tv_usec : fraction * unit_ns;
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  frame.odd_time = part_ns < 0 || part_ns >= kSecondNs;
  // Seconds are 32 bits in a pcap; a pcapng may say anything.
  const std::int64_t seconds = std::clamp<std::int64_t>(header->ts.tv_sec, 0, 1LL << 32U);
  frame.time_ns = seconds * kSecondNs + std::clamp<std::int64_t>(part_ns, 0, kSecondNs - 1);
  return frame;
}

}  // namespace verge::io
