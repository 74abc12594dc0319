// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/memory_meter.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::atomic<std::size_t> out{0};
std::atomic<std::size_t> most{0};

/// None where there is none.
void* try_take(std::size_t size) noexcept {
  void* memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory == nullptr) return nullptr;
  const std::size_t now = out.fetch_add(malloc_usable_size(memory)) + malloc_usable_size(memory);
  std::size_t seen = most.load();
  while (seen < now && !most.compare_exchange_weak(seen, now)) {
  }
  return memory;
}

void* take(std::size_t size) {
  void* memory = try_take(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void give(void* memory) noexcept {
  if (memory == nullptr) return;
  out.fetch_sub(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

// What the whole test program allocates goes through these.
void* operator new(std::size_t size) { return take(size); }
void* operator new[](std::size_t size) { return take(size); }
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return try_take(size); }
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return try_take(size); }
void operator delete(void* memory) noexcept { give(memory); }
void operator delete[](void* memory) noexcept { give(memory); }
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { give(memory); }
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept { give(memory); }
void operator delete(void* memory, std::size_t) noexcept { give(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give(memory); }

namespace verge::faults {

MemoryMeter::MemoryMeter() : before_(out.load()) { most.store(before_); }

std::size_t MemoryMeter::peak() const { return most.load() - before_; }

}  // namespace verge::faults
