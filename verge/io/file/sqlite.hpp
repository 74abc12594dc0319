// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "verge/core/bytes.hpp"
#include "verge/core/error.hpp"
#include "verge/io/input.hpp"

// The one place that knows SQLite.

struct sqlite3_stmt;

namespace verge::io {

/// What a SQLite database begins with.
inline constexpr std::string_view kSqliteMagic("SQLite format 3\0", 16);

/// An open database; what SQLite holds pointers to stays where it is.
struct SqliteState;

/// A statement that gives rows.
class SqliteRows {
 public:
  /// Whether there is another row. Fails with kDamaged.
  [[nodiscard]] Expected<bool> next();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::string text(int column) const;
  /// Valid until the next row. None where the column holds something else. Only a call of this reads the
  /// bytes from the file.
  [[nodiscard]] std::optional<Bytes> blob(int column) const;

 private:
  friend class SqliteFile;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  SqliteState* state_ = nullptr;
};

/// A SQLite database, read only, through an Input: nothing is written beside it, no lock is taken, memory and
/// files are the same to it. What a recorder that was killed left in a journal or WAL beside it is not seen.
/// Of a file that is cut, what lies in its pages that are there can be read.
class SqliteFile {
 public:
  /// Fails with kUnusable where the input is no database.
  [[nodiscard]] static Expected<SqliteFile> open(Input input);
  SqliteFile(SqliteFile&&) noexcept;
  SqliteFile& operator=(SqliteFile&&) noexcept;
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;
  ~SqliteFile();

  [[nodiscard]] const Input& input() const;
  /// Fails with kDamaged where the file is shorter than its header says.
  [[nodiscard]] Expected<void> check_whole() const;
  /// Whether there is a table (no view, no virtual table) of this name.
  [[nodiscard]] Expected<bool> has_table(const std::string& name) const;
  /// Rows of a query of ours, which must go before the database does. Fails with kDamaged where the tables
  /// are not as it expects.
  [[nodiscard]] Expected<SqliteRows> query(const char* sql) const;

 private:
  explicit SqliteFile(std::unique_ptr<SqliteState> state);
  std::unique_ptr<SqliteState> state_;
};

}  // namespace verge::io
