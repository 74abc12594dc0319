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

void* take(std::size_t size) {
  void* memory = std::malloc(std::max<std::size_t>(size, 1));
  if (memory == nullptr) throw std::bad_alloc();
  const std::size_t now = out.fetch_add(malloc_usable_size(memory)) + malloc_usable_size(memory);
  std::size_t seen = most.load();
  while (seen < now && !most.compare_exchange_weak(seen, now)) {
  }
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
void operator delete(void* memory) noexcept { give(memory); }
void operator delete[](void* memory) noexcept { give(memory); }
void operator delete(void* memory, std::size_t) noexcept { give(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give(memory); }

namespace verge::faults {

MemoryMeter::MemoryMeter() : before_(out.load()) { most.store(before_); }

std::size_t MemoryMeter::peak() const { return most.load() - before_; }

}  // namespace verge::faults
