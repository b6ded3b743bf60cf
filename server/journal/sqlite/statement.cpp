#include "server/journal/sqlite/statement.hpp"

#include <sqlite3.h>

namespace genio {

Statement::Run::~Run() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

bool Statement::Run::next() const {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  throw_storage_error(code, sqlite3_db_handle(statement_));
}

int64_t Statement::Run::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}

std::string Statement::Run::text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  return bytes ? std::string(bytes, size_t(sqlite3_column_bytes(statement_, column))) : "";
}

std::vector<uint8_t> Statement::Run::bytes(int column) const {
  const auto* bytes = static_cast<const uint8_t*>(sqlite3_column_blob(statement_, column));
  if (!bytes) return {};
  return {bytes, bytes + sqlite3_column_bytes(statement_, column)};
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(const Database& db, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(db.handle(), sql.c_str(), -1, SQLITE_PREPARE_PERSISTENT,
                                      &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) throw_storage_error(code, db.handle());
}

void Statement::bind(int place, int64_t value) {
  const int code = sqlite3_bind_int64(statement_.get(), place, value);
  if (code != SQLITE_OK) throw_storage_error(code, sqlite3_db_handle(statement_.get()));
}

void Statement::bind(int place, std::span<const uint8_t> bytes) {
  // A null pointer would be NULL, which is not the same as nothing.
  const int code = bytes.empty() ? sqlite3_bind_zeroblob(statement_.get(), place, 0)
                                 : sqlite3_bind_blob64(statement_.get(), place, bytes.data(),
                                                       bytes.size(), SQLITE_TRANSIENT);
  if (code != SQLITE_OK) throw_storage_error(code, sqlite3_db_handle(statement_.get()));
}

void Statement::bind(int place, const std::string& text) {
  bind(place, std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

}  // namespace genio
