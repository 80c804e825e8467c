#ifndef SEAUTILS_QUEUE_SPOOL_HPP
#define SEAUTILS_QUEUE_SPOOL_HPP

#include "seautils/queue/message.hpp"
#include "seautils/queue/scheduler.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace seautils::queue {

/// What a spool held when it was opened.
struct SpoolContents {
    std::vector<Accepted> messages;                          ///< by sequence
    std::vector<std::pair<QueueKey, std::int64_t>> last_ns;  ///< when queues were served last
    std::uint64_t next_sequence = 1;                         ///< greater than any of them
    std::uint32_t next_transmission = 1;                     ///< greater than any that was reserved
};

/// Accepted messages on disk, so that a kill or a power cut loses none: an SQLite database in WAL
/// mode whose commits are synchronised. What is under way is not kept: after a restart it waits
/// again, so that delivery is at least once.
///
/// The steady clock of Now goes on over restarts of the program within one `boot`; after another
/// boot, ages come from the wall clock.
///
/// Each call throws, where the file fails, and the spool stays as it was and can be used on:
/// Error io (no space left, or another failure), DataError (damaged).
class Spool {
public:
    /// Opens the file, or makes it; one process at a time, for as long as it lives.
    /// @param boot  names the run of the steady clock, such as the kernel's boot_id
    /// @throws DataError  not a database, another program's or version's, damaged
    /// @throws Error      cannot_create: not to be opened; try_again: another process has it
    Spool(const std::string& path, Now now, const std::string& boot);
    ~Spool();
    Spool(const Spool&) = delete;
    Spool& operator=(const Spool&) = delete;

    /// What it held; once.
    SpoolContents take_contents();

    /// Stores messages, all or none, and all that was noted before; they are safe when it returns.
    void store(std::span<const Accepted> messages);

    /// To be stored with the next call of store() or flush(); until then only remembered, so that a
    /// crash costs a repetition.
    void note_gone(std::uint64_t sequence);
    void note_sent(const Carried& carried, Now now);
    bool has_notes() const;
    void flush();

    /// No number below this one will be given out after a restart. Writes at every 256th number.
    void reserve(std::uint32_t next_transmission);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_SPOOL_HPP
