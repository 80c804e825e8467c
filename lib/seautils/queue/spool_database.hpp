// SQLite as the spool wants it: values that close themselves, faults that are exceptions of ours.
#ifndef SEAUTILS_QUEUE_SPOOL_DATABASE_HPP
#define SEAUTILS_QUEUE_SPOOL_DATABASE_HPP

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace seautils::queue {

/// An open database. Throws as Spool says.
class Database {
public:
    explicit Database(const std::string& path);
    Database(Database&&) noexcept = default;

    void run(const char* sql);
    std::int64_t number(const char* sql);  ///< the first column of the first row; 0: no row
    [[noreturn]] void fail(int code) const;
    [[noreturn]] void fail(const std::string& what) const;  ///< DataError: `spool 'path' what`
    sqlite3* get() const { return handle_.get(); }

private:
    struct Close {
        void operator()(sqlite3* handle) const;
    };
    std::string path_;
    std::unique_ptr<sqlite3, Close> handle_;
};

/// A statement, prepared once and run many times. Outlived by its database.
class Statement {
public:
    Statement(Database& database, const char* sql);

    /// Values for ?1, ?2, …; bytes stay the caller's until the statement has run.
    Statement& bind(int place, std::int64_t value);
    Statement& bind(int place, std::string_view bytes);
    void run();   ///< to its end; then it can be bound anew
    bool next();  ///< to the next row; false: there is none, and it can be bound anew

    std::int64_t number(int column) const;
    std::string_view bytes(int column) const;  ///< until the next call

private:
    void check(int code) const;

    struct Finalize {
        void operator()(sqlite3_stmt* handle) const;
    };
    Database& database_;
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_SPOOL_DATABASE_HPP
