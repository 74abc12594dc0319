// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/faults/memory_meter.hpp"
#include "verge/core/bytes.hpp"

// What every fuzz target has. A target is one file NAME_fuzz.cpp that defines seeds() and check(). libFuzzer
// drives it (./dev fuzz), and the ordinary tests run it over its seeds and what can easily be made of them,
// so that it cannot rot.

namespace verge::fuzz {

/// Inputs to start from, made by our own generators: valid ones, and those of the catalogue of bad inputs.
[[nodiscard]] std::vector<std::string> seeds();

/// Feeds the input to the parser, and requires what has to hold whatever it is.
void check(Bytes input);

/// Ends the program where a property does not hold: libFuzzer keeps the input.
inline void require(bool property) {
  if (!property) std::abort();
}

/// What the parser makes of the input, which may take no more memory at a time than the contract allows:
/// 16 MiB and 64 times the input. Counts what `new` gives out; libFuzzer's limits watch the C libraries.
template <class Parse>
[[nodiscard]] auto bounded(Bytes input, Parse&& parse) {
  constexpr std::size_t kFree = 16U << 20U;
  constexpr std::size_t kEachByte = 64;
  const faults::MemoryMeter meter;
  auto parsed = parse();
  require(meter.peak() <= kFree + kEachByte * input.size());
  return parsed;
}

[[nodiscard]] inline Bytes bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace verge::fuzz
