#ifndef SEAUTILS_CLI_LOOP_HPP
#define SEAUTILS_CLI_LOOP_HPP

#include "seautils/cli/io.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::cli {

/// For tools that wait for several things at once: records from the inputs of the command line,
/// from FIFOs and from a socket, descriptors of their own, times and signals.
///
/// One thread, one thing at a time. Before it waits it calls before_wait() and flushes standard
/// output. With `--clock input` nothing is waited for but input: advance() runs the wakes that are
/// due before a record.
///
/// SIGTERM and SIGINT end run(); when the tool has cleaned up, App raises the signal again, so that
/// the shell and systemd see a death by it. A second one kills at once.
class Loop {
public:
    using OnRecord = std::function<void(std::string_view record)>;
    /// @param client  names who sent it, for reply()
    using OnPacket = std::function<void(std::string_view packet, std::uint64_t client)>;

    explicit Loop(Io& io);
    ~Loop();
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    /// Reads FILE... in turn, as Io::for_each does: a DataError that `record` throws is reported at
    /// its place, counted and dropped. A FIFO among them is read with --follow beyond its end.
    void inputs(Framing framing, OnRecord record);
    /// `file:LINE: ` or `file:record N (byte OFFSET): `, of the record that `record` is called with: for what turns out
    /// to be wrong later.
    std::string place() const;
    /// Its line or number, from 1 in each file; 0 before the first.
    std::uint64_t record_number() const;
    /// Called when these have ended. Without this, run() returns then.
    void on_inputs_ended(std::function<void()> action);

    /// Reads a FIFO, made where there is none, which never ends.
    /// @throws Error(cannot_create)
    void fifo(const std::string& path, Framing framing, OnRecord record);

    /// Takes packets of at most max_packet bytes on a Unix socket (stream/packet_socket.hpp), which
    /// is removed at the end. A DataError that `packet` throws is sent back as `error: what`.
    /// @throws Error(cannot_create)
    void listen(const std::string& path, OnPacket packet);
    static constexpr std::size_t max_packet = 4096;
    /// Answers; a client that has gone, or does not take its answers, is forgotten.
    void reply(std::uint64_t client, std::string_view answer);

    /// Calls `ready` whenever reading from the descriptor would not wait (or it hung up). The
    /// descriptor stays the caller's.
    void watch(int fd, std::function<void()> ready);
    void unwatch(int fd);

    /// Calls `action` at or after a time, once, UTC or on the steady clock (Clock); nothing: not any
    /// more. There is one of each.
    void on_wake(std::function<void()> action);
    void wake_at(std::optional<std::int64_t> utc_ns);
    void wake_at_steady(std::optional<std::int64_t> steady_ns);
    /// Called when somebody stepped the system's clock; wake_at() times are looked at anew.
    void on_clock_step(std::function<void()> action);
    void on_signal(int number, std::function<void()> action);
    void before_wait(std::function<void()> action);

    /// With `--clock input`: time has come to this; wakes that are due run first, each at its time.
    void advance(std::int64_t utc_ns);

    /// Until the inputs have ended, stop(), or SIGTERM or SIGINT.
    void run();
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_LOOP_HPP
