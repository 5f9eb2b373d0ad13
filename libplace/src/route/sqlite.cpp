#include "route/sqlite.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>
#include <sqlite3.h>

#include <vo/base/error.hpp>
#include <vo/base/stopping.hpp>

namespace place::sqlite {
namespace {

[[noreturn]] void fail(sqlite3* database, const std::string& path, int code) {
  switch (code & 0xFF) {
    case SQLITE_NOTADB:
      throw vo::Error(path, "is no route database", "a file written by `retrace build`");
    case SQLITE_CORRUPT:
    case SQLITE_TOOBIG:
    case SQLITE_INTERRUPT:  // of a statement that takes more steps than the file has bytes
      throw vo::Error(path, "is damaged", "a whole route database; build it again");
    default:
      throw vo::Error(path, fmt::format("SQLite: {}", database != nullptr ? sqlite3_errmsg(database)
                                                                          : sqlite3_errstr(code)));
  }
}

constexpr std::int64_t kRow = 16;  // bytes that are charged for a row beside its texts and blobs

}  // namespace

void Statement::Finalise::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* database, std::string path, std::string_view sql, std::int64_t* allowance)
    : database_(database), path_(std::move(path)), allowance_(allowance) {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  statement_.reset(statement);
  check(code);
}

void Statement::check(int code) {
  if (code != SQLITE_OK && code != SQLITE_ROW && code != SQLITE_DONE) fail(database_, path_, code);
}

void Statement::charge(std::int64_t bytes) {
  if (allowance_ == nullptr) return;
  *allowance_ -= bytes;
  if (*allowance_ < 0) fail(database_, path_, SQLITE_CORRUPT);
}

Statement& Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), next_parameter_++, value));
  return *this;
}

Statement& Statement::bind(double value) {
  check(sqlite3_bind_double(statement_.get(), next_parameter_++, value));
  return *this;
}

Statement& Statement::bind(const std::optional<double>& value) {
  if (value) return bind(*value);
  check(sqlite3_bind_null(statement_.get(), next_parameter_++));
  return *this;
}

Statement& Statement::bind(std::string_view value) {
  check(sqlite3_bind_text(statement_.get(), next_parameter_++, value.data(), static_cast<int>(value.size()),
                          SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(std::span<const std::uint8_t> value) {
  static constexpr std::uint8_t kNothing = 0;  // a null pointer would be NULL, not a blob without bytes
  check(sqlite3_bind_blob64(statement_.get(), next_parameter_++, value.empty() ? &kNothing : value.data(),
                            value.size(), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  vo::stop_if_asked();
  const int code = sqlite3_step(statement_.get());
  check(code);
  next_column_ = 0;
  if (code == SQLITE_ROW) charge(kRow);
  return code == SQLITE_ROW;
}

void Statement::execute() {
  while (step()) {
  }
  check(sqlite3_reset(statement_.get()));
  check(sqlite3_clear_bindings(statement_.get()));
  next_parameter_ = 1;
}

std::int64_t Statement::integer() {
  return sqlite3_column_int64(statement_.get(), next_column_++);
}

double Statement::real() {
  return sqlite3_column_double(statement_.get(), next_column_++);
}

std::optional<double> Statement::optional_real() {
  if (sqlite3_column_type(statement_.get(), next_column_) == SQLITE_NULL) {
    ++next_column_;
    return std::nullopt;
  }
  return real();
}

std::string Statement::text() {
  const int column = next_column_++;
  const unsigned char* value = sqlite3_column_text(statement_.get(), column);
  if (value == nullptr) return {};
  const int bytes = sqlite3_column_bytes(statement_.get(), column);
  charge(bytes);
  return {reinterpret_cast<const char*>(value), static_cast<std::size_t>(bytes)};
}

std::span<const std::uint8_t> Statement::blob() {
  const int column = next_column_++;
  const auto* value = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  const int bytes = sqlite3_column_bytes(statement_.get(), column);
  charge(bytes);
  return {value, static_cast<std::size_t>(bytes)};
}

std::uint64_t Statement::digest(std::uint64_t before) const {
  constexpr std::uint64_t kPrime = 0x100000001b3U;  // FNV's, on words instead of bytes
  std::uint64_t digest = before;
  const auto mix = [&](std::uint64_t word) {
    digest = (digest ^ word) * kPrime;
    digest ^= digest >> 32U;  // so that the high bits count for the low ones
  };
  for (int column = 0; column < sqlite3_column_count(statement_.get()); ++column) {
    const int type = sqlite3_column_type(statement_.get(), column);
    mix(static_cast<std::uint64_t>(type));
    if (type == SQLITE_INTEGER) {
      mix(std::bit_cast<std::uint64_t>(std::int64_t{sqlite3_column_int64(statement_.get(), column)}));
    } else if (type == SQLITE_FLOAT) {
      mix(std::bit_cast<std::uint64_t>(sqlite3_column_double(statement_.get(), column)));
    } else if (type != SQLITE_NULL) {
      const void* bytes = sqlite3_column_blob(statement_.get(), column);
      const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
      mix(size);
      for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, static_cast<const char*>(bytes) + i, std::min(sizeof word, size - i));
        mix(word);
      }
    }
  }
  return digest;
}

void Database::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

Database::Database(const std::filesystem::path& file, Mode mode, std::string shown_path)
    : path_(std::move(shown_path)) {
  open(file, mode);
  if (mode == Mode::kReadOnly) distrust(file);
}

void Database::distrust(const std::filesystem::path& file) {
  const auto bytes_of = [](const std::filesystem::path& part) {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(part, error);
    return error ? 0 : static_cast<std::int64_t>(bytes);
  };
  const std::int64_t bytes = bytes_of(file) + bytes_of(file.string() + "-wal");
  constexpr std::int64_t kStepsPerByte = 16, kStepsOfAny = 100'000, kSchema = 1 << 16,
                         kLongest = 1'000'000'000;  // SQLite's own limit
  constexpr int kBetween = 1000;                    // steps from one look at the limit to the next
  whole_ = {2 * bytes + kSchema, kStepsPerByte * bytes + kStepsOfAny};
  reading_ = std::make_unique<Reading>(whole_);
  sqlite3_progress_handler(
      database_.get(), kBetween,
      [](void* reading) {
        auto& left = static_cast<Reading*>(reading)->steps;
        left -= kBetween;
        return left < 0 ? 1 : 0;
      },
      reading_.get());
  sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(std::min(bytes + kSchema, kLongest)));
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  run("PRAGMA cell_size_check = ON");
}

void Database::check_stored_values() const {
  const bool made = prepare(
                        "SELECT 1 FROM sqlite_schema WHERE type NOT IN ('table', 'index') UNION ALL "
                        "SELECT 1 FROM pragma_table_list WHERE schema = 'main' AND type != 'table' UNION ALL "
                        "SELECT 1 FROM sqlite_schema AS s, pragma_table_xinfo(s.name) AS c "
                        "WHERE s.type = 'table' AND c.hidden != 0")
                        .step();
  if (made) fail(database_.get(), path_, SQLITE_CORRUPT);
}

void Database::open(const std::filesystem::path& file, Mode mode) {
  const int flags =
      mode == Mode::kReadOnly ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* database = nullptr;
  int code = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
  database_.reset(database);
  if (code == SQLITE_OK) sqlite3_extended_result_codes(database, 0);
  if (code == SQLITE_OK && mode == Mode::kReadOnly) {
    // At its first read SQLite finds that it cannot create the files it needs next to this one.
    code = sqlite3_exec(database, "PRAGMA schema_version", nullptr, nullptr, nullptr) & 0xFF;
    if (code == SQLITE_CANTOPEN || code == SQLITE_READONLY) {
      open_unwritable(file);
      return;
    }
  }
  if (code != SQLITE_OK) fail(database, path_, code);
}

void Database::open_unwritable(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path changes = file.string() + "-wal";
  if (fs::exists(changes, error) && fs::file_size(changes, error) > 0) {
    std::string folder = (fs::temp_directory_path() / "retrace-route-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr)
      throw vo::Error(path_, "has changes beside it (-wal) and there is no folder to copy both to",
                      "a folder for temporary files (TMPDIR)");
    copy_ = std::make_unique<vo::PartialPath>(folder);
    fs::copy_file(file, copy_->path() / "route.db", error);
    if (!error) fs::copy_file(changes, copy_->path() / "route.db-wal", error);
    if (error) throw vo::Error(path_, fmt::format("cannot be copied to {}: {}", folder, error.message()));
    open(copy_->path() / "route.db", Mode::kCreate);
    return;
  }
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  uri += "?immutable=1";
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(uri.c_str(), &database, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(database);
  if (code != SQLITE_OK) fail(database, path_, code);
  sqlite3_extended_result_codes(database, 0);
}

void fold_changes(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::path changes = file.string() + "-wal", index = file.string() + "-shm",
                              journal = file.string() + "-journal";
  if (std::filesystem::exists(changes, ignored) || std::filesystem::exists(journal, ignored)) {
    sqlite3* database = nullptr;
    if (sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK)
      // The first of these reads, which takes back what a killed program had begun (`-journal`).
      sqlite3_exec(database,
                   "PRAGMA schema_version; PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE",
                   nullptr, nullptr, nullptr);
    sqlite3_close(database);
  }
  std::filesystem::remove(changes, ignored);
  std::filesystem::remove(index, ignored);
  std::filesystem::remove(journal, ignored);
}

Statement Database::prepare(std::string_view sql) const {
  return {database_.get(), path_, sql, reading_ ? &reading_->allowance : nullptr};
}

void Database::run(const std::string& sql) const {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(database_.get(), path_, code);
}

}  // namespace place::sqlite
