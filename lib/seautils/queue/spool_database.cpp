#include "seautils/queue/spool_database.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cstring>

namespace seautils::queue {

namespace {

constexpr int busy_ms = 1000;

}  // namespace

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close(handle); }
void Statement::Finalize::operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }

Database::Database(const std::string& path) : path_(path) {
    sqlite3* handle = nullptr;
    const int code =
        sqlite3_open_v2(path.c_str(), &handle,
                        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
    handle_.reset(handle);
    if (code != SQLITE_OK) fail(code);
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, busy_ms);
}

void Database::fail(const std::string& what) const {
    throw DataError(fmt::format("spool {} {}", quote(path_), what));
}

void Database::fail(int code) const {
    const std::string name = "spool " + quote(path_);
    const int system = handle_ ? sqlite3_system_errno(handle_.get()) : 0;
    const std::string why = system != 0 ? ": " + std::string(std::strerror(system)) : "";
    switch (code & 0xff) {
        case SQLITE_NOTADB:
            fail("is not a spool (move it away to start with an empty one)");
        case SQLITE_CORRUPT:
            fail("is damaged (move it away to start with an empty one)");
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            throw Error(ExitCode::try_again, name + " is in use by another process");
        case SQLITE_FULL:
            throw Error(ExitCode::io, name + ": no space left");
        case SQLITE_CANTOPEN:
        case SQLITE_READONLY:
        case SQLITE_PERM:
            throw Error(ExitCode::cannot_create, name + " cannot be opened for writing" + why);
        default:
            throw Error(ExitCode::io, fmt::format("{} failed (SQLite {}){}", name, code, why));
    }
}

void Database::run(const char* sql) { Statement(*this, sql).run(); }

std::int64_t Database::number(const char* sql) {
    Statement statement(*this, sql);
    return statement.next() ? statement.number(0) : 0;
}

Statement::Statement(Database& database, const char* sql) : database_(database) {
    sqlite3_stmt* handle = nullptr;
    const int code =
        sqlite3_prepare_v3(database.get(), sql, -1, SQLITE_PREPARE_PERSISTENT, &handle, nullptr);
    handle_.reset(handle);
    check(code);
}

void Statement::check(int code) const {
    if (code == SQLITE_OK || code == SQLITE_ROW || code == SQLITE_DONE) return;
    sqlite3_reset(handle_.get());
    database_.fail(code);
}

Statement& Statement::bind(int place, std::int64_t value) {
    check(sqlite3_bind_int64(handle_.get(), place, value));
    return *this;
}

Statement& Statement::bind(int place, std::string_view bytes) {
    check(sqlite3_bind_blob64(handle_.get(), place, bytes.data(), bytes.size(), SQLITE_STATIC));
    return *this;
}

bool Statement::next() {
    const int code = sqlite3_step(handle_.get());
    check(code);
    if (code == SQLITE_DONE) sqlite3_reset(handle_.get());
    return code == SQLITE_ROW;
}

void Statement::run() {
    while (next()) {
    }
}

std::int64_t Statement::number(int column) const {
    return sqlite3_column_int64(handle_.get(), column);
}

std::string_view Statement::bytes(int column) const {
    const void* const data = sqlite3_column_blob(handle_.get(), column);
    const int size = sqlite3_column_bytes(handle_.get(), column);
    return {static_cast<const char*>(data), static_cast<std::size_t>(size)};
}

}  // namespace seautils::queue
