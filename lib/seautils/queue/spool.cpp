#include "seautils/queue/spool.hpp"

#include "seautils/core/error.hpp"
#include "seautils/queue/spool_database.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace seautils::queue {

namespace {

constexpr std::int64_t application_id = 0x53455175;  ///< "SEQu": whose file it is
constexpr std::int64_t version = 1;
constexpr std::uint32_t block = 256;  ///< transmission numbers reserved at once
constexpr std::uint32_t most_id = 32767;
constexpr std::uint32_t most_dest = 30;

/// Refuses what is not ours before a byte of it is changed; lays out an empty file.
Database open_database(const std::string& path) {
    Database db(path);
    db.run("PRAGMA locking_mode = EXCLUSIVE");
    db.run("PRAGMA synchronous = FULL");
    const bool is_new = db.number("SELECT count(*) FROM sqlite_master") == 0;
    const std::int64_t owner = db.number("PRAGMA application_id");
    const std::int64_t written = db.number("PRAGMA user_version");
    if (owner != application_id && !(is_new && owner == 0))
        db.fail("is another program's database");
    if (!is_new && written != version)
        db.fail(fmt::format("is of version {}, where {} is read", written, version));
    db.run("PRAGMA journal_mode = WAL");
    if (!is_new) return db;
    db.run("BEGIN EXCLUSIVE");
    db.run(fmt::format("PRAGMA application_id = {}", application_id).c_str());
    db.run(fmt::format("PRAGMA user_version = {}", version).c_str());
    // Times: steady_ns while the boot is the same, else utc_us.
    db.run(
        "CREATE TABLE message(sequence INTEGER PRIMARY KEY, id INTEGER, dest INTEGER,"
        " src INTEGER, ack INTEGER, utc_us INTEGER, steady_ns INTEGER, sends INTEGER, data BLOB)");
    db.run(
        "CREATE TABLE queue(id INTEGER, dest INTEGER, utc_us INTEGER, steady_ns INTEGER,"
        " PRIMARY KEY(id, dest)) WITHOUT ROWID");
    db.run("CREATE TABLE state(name TEXT PRIMARY KEY, value) WITHOUT ROWID");
    db.run("COMMIT");
    return db;
}

/// Whether the message asks for an acknowledgement, in a column: 0, 1, or 2 where it does not say.
std::int64_t ack_number(const std::optional<bool>& ack) { return ack ? (*ack ? 1 : 0) : 2; }

}  // namespace

struct Spool::Impl {
    Impl(const std::string& path, Now now, const std::string& boot);

    bool is_same_boot(const std::string& boot);
    void move_to(const std::string& boot, Now now);
    void load_messages();
    Accepted message_of(const Statement& row);
    void load_rest();
    void write_notes();
    template <class Body>
    void transaction(Body body);
    template <class Body>
    void try_transaction(Body& body);
    bool fold_log();
    void insert(const Accepted& accepted);

    Database db;
    Statement begin{db, "BEGIN IMMEDIATE"};
    Statement commit{db, "COMMIT"};
    Statement add{db, "INSERT INTO message VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)"};
    Statement erase{db, "DELETE FROM message WHERE sequence = ?1"};
    Statement count_send{db, "UPDATE message SET sends = ?2 WHERE sequence = ?1"};
    Statement serve{db, "INSERT OR REPLACE INTO queue VALUES(?1, ?2, ?3, ?4)"};
    Statement save{db, "INSERT OR REPLACE INTO state VALUES(CAST(?1 AS TEXT), ?2)"};
    SpoolContents contents;
    std::uint32_t reserved = 0;
    std::vector<std::uint64_t> gone;
    std::map<std::uint64_t, std::pair<Carried, Now>> sent;  ///< by sequence
};

Spool::Impl::Impl(const std::string& path, Now now, const std::string& boot)
    : db(open_database(path)) {
    fold_log();  // of a process that was killed
    if (!is_same_boot(boot)) transaction([&] { move_to(boot, now); });
    load_messages();
    load_rest();
}

/// Folds the log of commits into the database, so that its room is used again: SQLite does so by
/// itself only when the log has 1000 pages, which a nearly full disk may not have.
bool Spool::Impl::fold_log() {
    try {
        return db.number("PRAGMA wal_checkpoint(TRUNCATE)") == 0;
    } catch (const Error&) {
        return false;
    }
}

/// All or nothing. What finds no room is tried once more where the log can make some.
template <class Body>
void Spool::Impl::transaction(Body body) {
    try {
        return try_transaction(body);
    } catch (const Error& e) {
        if (e.code() != ExitCode::io || !fold_log()) throw;
    }
    try_transaction(body);
}

template <class Body>
void Spool::Impl::try_transaction(Body& body) {
    begin.run();
    try {
        body();
        commit.run();
    } catch (const Error&) {
        try {
            db.run("ROLLBACK");
        } catch (const Error&) {  // SQLite has done so itself
        }
        throw;
    }
}

bool Spool::Impl::is_same_boot(const std::string& boot) {
    Statement row(db, "SELECT value FROM state WHERE name = 'boot'");
    return row.next() && row.bytes(0) == boot;
}

/// Gives everything its place on a steady clock that has begun anew, as accept() does.
void Spool::Impl::move_to(const std::string& boot, Now now) {
    save.bind(1, "boot").bind(2, boot).run();
    for (const char* const table : {"message", "queue"}) {
        const std::string sql = fmt::format(
            "UPDATE {} SET steady_ns = ?1 - max(0, min(?2 - utc_us, {})) * 1000", table, oldest_us);
        Statement(db, sql.c_str()).bind(1, now.steady_ns).bind(2, now.utc_us).run();
    }
}

Accepted Spool::Impl::message_of(const Statement& row) {
    const auto within = [&](int column, std::int64_t most) {
        const std::int64_t value = row.number(column);
        if (value < 0 || value > most)
            db.fail(fmt::format("is damaged: message {} has no sense", row.number(0)));
        return static_cast<std::uint32_t>(value);
    };
    Accepted accepted;
    accepted.sequence = static_cast<std::uint64_t>(row.number(0));
    Message& message = accepted.message;
    message.queue = {within(1, most_id), within(2, most_dest)};
    message.src = within(3, most_dest);
    if (const std::uint32_t ack = within(4, 2); ack != 2) message.ack_requested = ack == 1;
    message.created_us = row.number(5);
    accepted.born_ns = row.number(6);
    accepted.sends = within(7, std::numeric_limits<std::uint32_t>::max());
    message.data = row.bytes(8);
    if (message.data.empty()) within(0, -1);
    return accepted;
}

void Spool::Impl::load_messages() {
    Statement rows(db,
                   "SELECT sequence, id, dest, src, ack, utc_us, steady_ns, sends, data"
                   " FROM message ORDER BY sequence");
    while (rows.next()) contents.messages.push_back(message_of(rows));
    if (!contents.messages.empty()) contents.next_sequence = contents.messages.back().sequence + 1;
}

void Spool::Impl::load_rest() {
    Statement queues(db, "SELECT id, dest, steady_ns FROM queue");
    while (queues.next()) {
        const QueueKey key{static_cast<std::uint32_t>(queues.number(0)),
                           static_cast<std::uint32_t>(queues.number(1))};
        contents.last_ns.emplace_back(key, queues.number(2));
    }
    reserved = static_cast<std::uint32_t>(
        db.number("SELECT value FROM state WHERE name = 'transmission'"));
    contents.next_transmission = std::max<std::uint32_t>(1, reserved);
}

void Spool::Impl::insert(const Accepted& accepted) {
    const Message& m = accepted.message;
    add.bind(1, static_cast<std::int64_t>(accepted.sequence))
        .bind(2, m.queue.id)
        .bind(3, m.queue.dest)
        .bind(4, m.src)
        .bind(5, ack_number(m.ack_requested))
        .bind(6, m.created_us.value_or(0))
        .bind(7, accepted.born_ns)
        .bind(8, accepted.sends)
        .bind(9, m.data)
        .run();
}

void Spool::Impl::write_notes() {
    for (const auto& [sequence, note] : sent) {
        const auto& [carried, now] = note;
        count_send.bind(1, static_cast<std::int64_t>(carried.sequence))
            .bind(2, carried.sends)
            .run();
        serve.bind(1, carried.queue.id)
            .bind(2, carried.queue.dest)
            .bind(3, now.utc_us)
            .bind(4, now.steady_ns)
            .run();
    }
    for (const std::uint64_t sequence : gone)
        erase.bind(1, static_cast<std::int64_t>(sequence)).run();
}

Spool::Spool(const std::string& path, Now now, const std::string& boot)
    : impl_(std::make_unique<Impl>(path, now, boot)) {}

Spool::~Spool() = default;

SpoolContents Spool::take_contents() { return std::move(impl_->contents); }

void Spool::store(std::span<const Accepted> messages) {
    Impl& s = *impl_;
    s.transaction([&] {
        s.write_notes();
        for (const Accepted& accepted : messages) s.insert(accepted);
    });
    s.sent.clear();
    s.gone.clear();
}

void Spool::note_gone(std::uint64_t sequence) { impl_->gone.push_back(sequence); }

void Spool::note_sent(const Carried& carried, Now now) {
    impl_->sent.insert_or_assign(carried.sequence, std::pair(carried, now));
}

bool Spool::has_notes() const { return !impl_->gone.empty() || !impl_->sent.empty(); }

void Spool::flush() {
    if (has_notes()) store({});
}

void Spool::reserve(std::uint32_t next_transmission) {
    Impl& s = *impl_;
    if (next_transmission < s.reserved) return;
    const std::uint32_t reserved = next_transmission + block;
    s.transaction([&] { s.save.bind(1, "transmission").bind(2, std::int64_t{reserved}).run(); });
    s.reserved = reserved;
}

}  // namespace seautils::queue
