// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/message_stream.hpp"
#include "verge/io/file/ibeo_stream.hpp"
#include "verge/sensor/ibeo/idc.hpp"
#include "verge/sensor/ibeo/test_messages.hpp"

namespace verge::fuzz {
namespace {

namespace ibeo = sensor::ibeo;

/// A file of so many scans.
std::vector<std::byte> idc(std::size_t scans, bool closed) {
  ibeo::IdcWriter writer;
  std::vector<std::byte> file;
  const auto append = [&](const std::vector<std::byte>& bytes) {
    file.insert(file.end(), bytes.begin(), bytes.end());
  };
  for (std::size_t i = 0; i < scans; ++i) {
    append(writer.add({.type = ibeo::kScanType, .ntp = testing::kNtp + (i << 28U)},
                      ibeo::encode_scan(testing::lux_scan(2))));
  }
  if (closed) append(writer.close());
  return file;
}

/// An index that is good stays what it is when it is written again.
void check_index(Bytes body) {
  const auto index = ibeo::decode_frame_index(body, 1U << 20U);
  if (!index) return;
  const auto again = ibeo::decode_frame_index(ibeo::encode_frame_index(*index), 1U << 20U);
  require(again && *again == *index && index->entries.size() <= body.size() / 17);
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> seeds;
  for (const std::size_t scans : {0U, 1U, 3U}) {
    seeds.push_back(seed_of({idc(scans, true)}));
    seeds.push_back(seed_of({idc(scans, false)}));
  }
  seeds.push_back(seed_of({idc(2, true), idc(1, true)}));
  for (const std::size_t at : {19U, 36U, 128U}) {  // number of entries, number of triggers, first entry
    auto file = idc(2, true);
    file[idc(2, false).size() + 24 + at] = std::byte{0x10};
    seeds.push_back(seed_of({file}));
  }
  seeds.push_back(
      seed_of({ibeo::encode_frame_index({.name = "x", .triggers = {{}}, .entries = {{1, 2, 3}}})}));
  return seeds;
}

void check(Bytes input) {
  check_index(input);
  check_recording(input, [](io::Input file) { return io::open_ibeo(std::move(file), {}); });
}

}  // namespace verge::fuzz
