// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "verge/study/engine.hpp"

namespace verge::study {

/// Rows of text under a head; the first columns are words, the others figures.
struct Table {
  std::string title;  ///< Empty where the suite's says it.
  std::vector<std::string> head;
  std::size_t words = 2;
  std::vector<std::vector<std::string>> rows;
};

/// Results by cell and contestant, what others printed below each cell; of a suite of conditions a table a
/// condition. A figure that does not exist is "-".
[[nodiscard]] std::vector<Table> tables_of(const Results& results);

/// How long scans took, all cells together.
[[nodiscard]] Table time_table(const Results& results);

/// What a reader has to know beside the figures, a sentence each: which contestants do not say what a suite
/// judges, and what could not be read.
[[nodiscard]] std::vector<std::string> notes_on(const Results& results);

/// The tally of all cells of a contestant together.
[[nodiscard]] Tally all_of(const Results& results, std::size_t contestant);

[[nodiscard]] std::string to_text(const Table& table);

}  // namespace verge::study
