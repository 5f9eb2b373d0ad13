#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vo/io/partial_path.hpp>

struct sqlite3;
struct sqlite3_stmt;

namespace place::sqlite {

/// A prepared statement: bind values in order, step, read columns in order. Failures throw `vo::Error` naming
/// the file.
class Statement {
 public:
  /// `allowance`: see `Database::allowance`; null: none.
  Statement(sqlite3* database, std::string path, std::string_view sql, std::int64_t* allowance);

  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(const std::optional<double>& value);
  Statement& bind(std::string_view value);
  Statement& bind(std::span<const std::uint8_t> value);

  /// True if there is a row to read.
  bool step();
  /// Runs a statement without rows and resets it for the next values.
  void execute();

  std::int64_t integer();
  double real();
  std::optional<double> optional_real();
  std::string text();
  /// Valid until the next step.
  std::span<const std::uint8_t> blob();

  /// A digest of the row's values and their types, continued from that of the rows before it. O(bytes).
  [[nodiscard]] std::uint64_t digest(std::uint64_t before) const;

 private:
  void check(int code);
  void charge(std::int64_t bytes);

  struct Finalise {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::string path_;
  std::int64_t* allowance_;
  std::unique_ptr<sqlite3_stmt, Finalise> statement_;
  int next_parameter_ = 1;
  int next_column_ = 0;
};

/// An open SQLite file.
class Database {
 public:
  enum class Mode { kReadOnly, kCreate };
  /// For reading, a file is opened in place, even on read-only media: SQLite would create files next to one
  /// in WAL mode, so there it is opened as immutable or, if there are pending changes next to it (`-wal`), as
  /// a copy of both.
  ///
  /// A file for reading may be made to deceive: views and triggers do nothing, and what is read, and the
  /// steps that it takes, are held to the file's size [SQLite, "Defense Against The Dark Arts"].
  Database(const std::filesystem::path& file, Mode mode, std::string shown_path);

  [[nodiscard]] Statement prepare(std::string_view sql) const;
  /// Runs statements without parameters or rows.
  void run(const std::string& sql) const;
  /// Throws unless the file has tables of stored values alone: no view, virtual table or generated column.
  void check_stored_values() const;
  /// Bytes that may still be read, of rows, texts and blobs: twice what the file and its changes hold, since
  /// pages that point at each other can make a short file give out any number of them. Reading more throws.
  [[nodiscard]] std::int64_t allowance() const { return reading_ ? reading_->allowance : 0; }
  /// Begins the limits on reading anew, where the same rows are read again and again.
  void renew_limits() const {
    if (reading_) *reading_ = whole_;
  }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  void open(const std::filesystem::path& file, Mode mode);
  void open_unwritable(const std::filesystem::path& file);
  void distrust(const std::filesystem::path& file);

  /// What is left of the limits on reading.
  struct Reading {
    std::int64_t allowance = 0;  ///< bytes
    std::int64_t steps = 0;      ///< of SQLite's machine
  };
  std::string path_;
  Reading whole_;                          ///< the limits as they were at first
  std::unique_ptr<Reading> reading_;       ///< none while writing; outlives the connection
  std::unique_ptr<vo::PartialPath> copy_;  ///< of the file and its changes; outlives the connection
  std::unique_ptr<sqlite3, Close> database_;
};

/// Merges changes that another program left next to a file (`-wal`) into it, or takes back those it had begun
/// (`-journal`), so that the file can be replaced: SQLite would apply them to any file of that name.
void fold_changes(const std::filesystem::path& file);

}  // namespace place::sqlite
