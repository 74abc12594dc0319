// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/sqlite.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/core.h>
#include <sqlite3.h>

#include "verge/io/text.hpp"

namespace verge::io {
namespace {

// SQLite reads through a "virtual file system": these functions give it the Input as its only file.

/// A database and how long its header says that it is, where that is more than there is.
struct Served {
  Input input;
  std::uint64_t promised_bytes = 0;
};

/// SQLite makes room for this; the first member is what it knows of it.
struct InputFile {
  sqlite3_file base;
  Served* served;
};

int close_file(sqlite3_file*) { return SQLITE_OK; }

/// What lies behind the end reads as zeros, and says so; in a file that is cut it is an error, since SQLite
/// takes zeros for data.
int read_file(sqlite3_file* file, void* out, int amount, sqlite3_int64 offset) {
  const Served& served = *reinterpret_cast<InputFile*>(file)->served;
  Input& input = reinterpret_cast<InputFile*>(file)->served->input;
  const auto wanted = static_cast<std::uint64_t>(amount);
  const auto begin = std::min(static_cast<std::uint64_t>(offset), input.size());
  const std::uint64_t length = std::min(wanted, input.size() - begin);
  if (length < wanted && served.promised_bytes > input.size()) return SQLITE_IOERR_READ;
  const auto bytes = input.read(begin, length);
  if (!bytes) return SQLITE_IOERR_READ;
  std::memset(out, 0, wanted);
  if (length > 0) std::memcpy(out, bytes->data(), length);
  return length == wanted ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
}

int write_file(sqlite3_file*, const void*, int, sqlite3_int64) { return SQLITE_READONLY; }
int truncate_file(sqlite3_file*, sqlite3_int64) { return SQLITE_READONLY; }
int sync_file(sqlite3_file*, int) { return SQLITE_OK; }
int size_file(sqlite3_file* file, sqlite3_int64* size) {
  const Served& served = *reinterpret_cast<InputFile*>(file)->served;
  *size = static_cast<sqlite3_int64>(std::max(served.input.size(), served.promised_bytes));
  return SQLITE_OK;
}
int lock_file(sqlite3_file*, int) { return SQLITE_OK; }
int check_lock(sqlite3_file*, int* locked) {
  *locked = 0;
  return SQLITE_OK;
}
int control_file(sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; }
int sector_size(sqlite3_file*) { return 512; }
/// Immutable: no journal and no WAL is looked for.
int characteristics(sqlite3_file*) { return SQLITE_IOCAP_IMMUTABLE; }

const sqlite3_io_methods* methods() {
  static constexpr sqlite3_io_methods kMethods = [] {
    sqlite3_io_methods m{};
    m.iVersion = 1;
    m.xClose = close_file;
    m.xRead = read_file;
    m.xWrite = write_file;
    m.xTruncate = truncate_file;
    m.xSync = sync_file;
    m.xFileSize = size_file;
    m.xLock = lock_file;
    m.xUnlock = lock_file;
    m.xCheckReservedLock = check_lock;
    m.xFileControl = control_file;
    m.xSectorSize = sector_size;
    m.xDeviceCharacteristics = characteristics;
    return m;
  }();
  return &kMethods;
}

/// The database itself and nothing else: no journal, no temporary file.
int open_file(sqlite3_vfs* vfs, const char*, sqlite3_file* file, int flags, int* out_flags) {
  auto* opened = reinterpret_cast<InputFile*>(file);
  opened->base.pMethods = nullptr;
  if ((flags & SQLITE_OPEN_MAIN_DB) == 0) return SQLITE_CANTOPEN;
  opened->served = static_cast<Served*>(vfs->pAppData);
  opened->base.pMethods = methods();
  if (out_flags != nullptr) *out_flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_MAIN_DB;
  return SQLITE_OK;
}

int delete_file(sqlite3_vfs*, const char*, int) { return SQLITE_READONLY; }
int access_file(sqlite3_vfs*, const char*, int, int* found) {
  *found = 0;
  return SQLITE_OK;
}
int full_name(sqlite3_vfs*, const char* name, int size, char* out) {
  sqlite3_snprintf(size, out, "%s", name);
  return SQLITE_OK;
}
int randomness(sqlite3_vfs*, int size, char* out) {
  std::memset(out, 0, static_cast<std::size_t>(size));
  return size;
}
int no_sleep(sqlite3_vfs*, int) { return 0; }
int no_time(sqlite3_vfs*, double* days) {
  *days = 0.0;
  return SQLITE_OK;
}

sqlite3_vfs file_system_of(Served* served, const char* name) {
  sqlite3_vfs vfs{};
  vfs.iVersion = 1;
  vfs.szOsFile = sizeof(InputFile);
  vfs.mxPathname = 16;
  vfs.zName = name;
  vfs.pAppData = served;
  vfs.xOpen = open_file;
  vfs.xDelete = delete_file;
  vfs.xAccess = access_file;
  vfs.xFullPathname = full_name;
  vfs.xRandomness = randomness;
  vfs.xSleep = no_sleep;
  vfs.xCurrentTime = no_time;
  return vfs;
}

/// Steps of SQLite's machine between two looks at whether it goes on for ever. A step to the next row of a
/// query of ours takes far fewer; one over a generated column or a cycle of pages is ended by the second
/// look.
constexpr int kStepsPerLook = 1'000'000;
int look(void* looks) { return ++*static_cast<int*>(looks) > 1 ? 1 : 0; }

/// A database may be made to do harm: nothing in it is believed but tables.
void restrict_database(sqlite3* database, const Input& input, int* looks) {
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  const std::uint64_t longest = std::min(input.limits().memory_max_bytes / 4, input.size());
  const std::uint64_t least = 4096;  // for the statements of ours
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH,
                static_cast<int>(std::clamp<std::uint64_t>(longest, least, 1ULL << 30U)));
  sqlite3_limit(database, SQLITE_LIMIT_COLUMN, 64);
  sqlite3_limit(database, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_progress_handler(database, kStepsPerLook, look, looks);
}

constexpr std::size_t kHeaderBytes = 100;

/// Pages x their size, as the header of a database says them (sqlite.org/fileformat2.html, 1.3); 0 where it
/// does not say: old versions of SQLite left the number of pages as it was, and the second counter behind.
std::uint64_t promised_bytes(Bytes header) {
  if (header.size() < kHeaderBytes) return 0;
  if (load_be<std::uint32_t>(header, 24) != load_be<std::uint32_t>(header, 92)) return 0;
  const auto page = load_be<std::uint16_t>(header, 16);
  return load_be<std::uint32_t>(header, 28) * (page == 1 ? std::uint64_t{65536} : page);
}

}  // namespace

struct SqliteState {
  SqliteState(Input source, std::uint64_t promised) : served{std::move(source), promised} {}
  SqliteState(const SqliteState&) = delete;
  SqliteState& operator=(const SqliteState&) = delete;
  ~SqliteState() { sqlite3_close(database); }

  /// What SQLite says is wrong; or that the file is cut, which it cannot know.
  [[nodiscard]] Error damaged() const;
  [[nodiscard]] Expected<void> check_whole() const;

  Served served;
  std::string name = fmt::format("verge-{}", static_cast<const void*>(this));  // of the file system
  sqlite3_vfs vfs = file_system_of(&served, name.c_str());
  int looks = 0;
  sqlite3* database = nullptr;
};

Expected<void> SqliteState::check_whole() const {
  const Input& input = served.input;
  if (served.promised_bytes <= input.size()) return {};
  return Unexpected(input.error_at(ErrorCode::kDamaged, input.size(), "database is cut",
                                   fmt::format("{} B", input.size()),
                                   fmt::format("{} B", served.promised_bytes)));
}

Error SqliteState::damaged() const {
  if (auto whole = check_whole(); !whole) return std::move(whole).error();
  return {ErrorCode::kDamaged, served.input.name(), {}, "database is damaged", sqlite3_errmsg(database), {}};
}

SqliteFile::SqliteFile(std::unique_ptr<SqliteState> state) : state_(std::move(state)) {}
SqliteFile::SqliteFile(SqliteFile&&) noexcept = default;
SqliteFile& SqliteFile::operator=(SqliteFile&&) noexcept = default;
SqliteFile::~SqliteFile() = default;

const Input& SqliteFile::input() const { return state_->served.input; }
Expected<void> SqliteFile::check_whole() const { return state_->check_whole(); }

void SqliteRows::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Expected<bool> SqliteRows::next() {
  state_->looks = 0;
  const int state = sqlite3_step(statement_.get());
  if (state == SQLITE_ROW) return true;
  if (state == SQLITE_DONE) return false;
  return Unexpected(state_->damaged());
}

std::int64_t SqliteRows::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string SqliteRows::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  return text == nullptr ? std::string() : std::string(text);
}

std::optional<Bytes> SqliteRows::blob(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_BLOB) return std::nullopt;
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  if (data == nullptr && sqlite3_errcode(sqlite3_db_handle(statement_.get())) == SQLITE_NOMEM)
    return std::nullopt;
  return Bytes(data, data == nullptr ? 0 : static_cast<std::size_t>(size));
}

Expected<SqliteFile> SqliteFile::open(Input input) {
  const auto header = input.head(kHeaderBytes);
  if (!header) return Unexpected(header.error());
  if (!as_text(*header).starts_with(kSqliteMagic))
    return Unexpected(input.error_at(ErrorCode::kUnusable, 0, "no SQLite database"));
  const std::uint64_t promised = promised_bytes(*header);
  auto state = std::make_unique<SqliteState>(std::move(input), promised);
  // SQLite finds file systems by name; ours is known only while it opens the database.
  sqlite3_vfs_register(&state->vfs, 0);
  const int opened = sqlite3_open_v2("input", &state->database, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX,
                                     state->name.c_str());
  sqlite3_vfs_unregister(&state->vfs);
  if (opened != SQLITE_OK) return Unexpected(state->damaged());
  restrict_database(state->database, state->served.input, &state->looks);
  return SqliteFile(std::move(state));
}

Expected<bool> SqliteFile::has_table(const std::string& name) const {
  auto rows = query("SELECT name FROM sqlite_master WHERE type = 'table' AND rootpage > 0");
  if (!rows) return Unexpected(std::move(rows).error());
  while (true) {
    const auto more = rows->next();
    if (!more) return Unexpected(more.error());
    if (!*more) return false;
    if (rows->text(0) == name) return true;
  }
}

Expected<SqliteRows> SqliteFile::query(const char* sql) const {
  sqlite3_stmt* made = nullptr;
  state_->looks = 0;
  const int prepared = sqlite3_prepare_v2(state_->database, sql, -1, &made, nullptr);
  SqliteRows out;
  out.statement_.reset(made);
  out.state_ = state_.get();
  if (prepared != SQLITE_OK) return Unexpected(state_->damaged());
  return out;
}

}  // namespace verge::io
