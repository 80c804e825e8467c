// mm-serial with a device: the driver between the serial line, the records and the clock.
#ifndef SEAUTILS_TOOLS_MM_SERIAL_SESSION_HPP
#define SEAUTILS_TOOLS_MM_SERIAL_SESSION_HPP

#include "mm_serial_options.hpp"
#include "record_io.hpp"

#include "seautils/cli/loop.hpp"
#include "seautils/modem/driver.hpp"
#include "seautils/stream/fifo.hpp"
#include "seautils/stream/serial_line.hpp"

#include <deque>
#include <memory>

namespace seautils::tools {

/// The serial line comes first: no reader of ours is ever waited for.
class MmSerialSession {
public:
    MmSerialSession(cli::Io& io, const MmSerialOptions& options, std::string device)
        : io_(io),
          options_(options),
          device_(std::move(device)),
          records_(io),
          loop_(io),
          driver_(options.modem) {
        for (const std::string& path : options.feedback) feedback_.emplace_back(path);
    }

    /// @throws Error(unavailable)  the device is not there at the start
    void run() {
        line_.emplace(device_, options_.modem.baud);
        loop_.inputs(records_.framing(), [this](std::string_view bytes) { record(bytes); });
        loop_.on_inputs_ended([this] { inputs_ended(); });
        loop_.on_wake([this] { wake(); });
        loop_.on_clock_step([this] {
            driver_.clock_stepped(now());
            pump();
        });
        start();
        loop_.run();
        gap();
        say_losses();
    }

private:
    static constexpr std::int64_t second_ns = 1'000'000'000;
    static constexpr std::int64_t reopen_ns = second_ns;  ///< between tries to open the device
    static constexpr std::int64_t rewrite_ns =
        10'000'000;  ///< until a full line is written to again
    static constexpr std::size_t most_waiting = 1U << 15;  ///< bytes without a line end

    modem::Moment now() const { return {{io_.clock.now_ns()}, io_.clock.steady_ns()}; }

    void start() {
        held_.clear();
        loop_.watch(line_->fd(), [this] { readable(); });
        driver_.opened(now());
        pump();
    }

    /// The device is gone, or nobody answers there: it is opened again when it can be.
    void close() {
        loop_.unwatch(line_->fd());
        line_.reset();
        reopen_ = now().steady_ns + reopen_ns;
    }

    void reopen() {
        try {
            line_.emplace(device_, options_.modem.baud);
        } catch (const Error& e) {
            if (e.code() != ExitCode::unavailable) throw;
            reopen_ = now().steady_ns + reopen_ns;
            return;
        }
        reopen_.reset();
        start();
    }

    void lost() {
        driver_.lost(line_->lost(), now());
        close();
        pump();
    }

    void readable() {
        const bool there = line_->read(held_);
        lines();
        if (!line_) return;
        there ? pump() : lost();
    }

    /// Gives complete lines to the driver; a modem may end them by `\r` alone.
    void lines() {
        std::size_t at = 0;
        for (;;) {
            const std::size_t end = held_.find_first_of("\r\n", at);
            if (end == held_.npos) break;
            if (end > at) driver_.line(std::string_view(held_).substr(at, end - at), now());
            at = end + 1;
        }
        held_.erase(0, at);
        if (held_.size() < most_waiting) return;
        driver_.line(held_, now());
        held_.clear();
    }

    void record(std::string_view bytes) {
        const record::Record& r = records_.read(bytes);
        if (const auto* t = r.as<record::Transmission>()) {
            driver_.transmit(*t, now());
            pump();
        }
    }

    void wake() {
        if (!line_ && reopen_ && now().steady_ns >= *reopen_) reopen();
        driver_.tick(now());
        pump();
        if (end_ && now().steady_ns >= *end_) loop_.stop();
    }

    void inputs_ended() {
        if (!options_.linger_s) return;
        end_ = now().steady_ns + static_cast<std::int64_t>(*options_.linger_s * 1e9);
        pump();
    }

    /// Does what the driver says.
    void pump() {
        modem::Driver::Output& out = driver_.output();
        bool there = true;
        if (line_) there = line_->write(out.to_modem);
        out.to_modem.clear();
        std::vector<record::Record> given = std::move(out.records);
        out.records.clear();
        for (const record::Record& r : given) give(r);
        if (!there) return lost();
        if (std::exchange(out.reopen, false) && line_) close();
        schedule();
    }

    void schedule() {
        std::optional<std::int64_t> due = driver_.wake();
        const auto sooner = [&](std::optional<std::int64_t> t) {
            if (t && (!due || *t < *due)) due = t;
        };
        sooner(reopen_);
        sooner(end_);
        if (line_ && line_->pending()) sooner(now().steady_ns + rewrite_ns);
        loop_.wake_at_steady(due);
    }

    void give(const record::Record& r) {
        bytes_.clear();
        try {
            records_.codec().write(r, records_.out_form(), bytes_);
        } catch (const DataError& e) {
            io_.warn(e.what());
            ++lost_;
            return;
        }
        if (!gap() || !stream::try_write(STDOUT_FILENO, bytes_)) ++lost_;
        if (is_feedback(r)) {
            for (stream::FeedbackFifo& fifo : feedback_) fifo.write(bytes_);
        }
        if (const auto* e = r.as<record::ModemEvent>()) say(*e);
    }

    /// Says that records were lost, before the next one. @return false: there is no room yet
    bool gap() {
        if (lost_ == 0) return true;
        record::ModemEvent e;
        e.event = record::ModemEvent::Event::gap;
        e.count = static_cast<std::uint32_t>(lost_);
        std::string bytes;
        records_.codec().write({now().utc, e}, records_.out_form(), bytes);
        if (!stream::try_write(STDOUT_FILENO, bytes)) return false;
        lost_ = 0;
        return true;
    }

    static bool is_feedback(const record::Record& r) {
        const auto* e = r.as<record::ModemEvent>();
        const bool heard = e != nullptr && e->event == record::ModemEvent::Event::heard;
        return heard || r.as<record::Ack>() != nullptr || r.as<record::Result>() != nullptr ||
               r.as<record::Slot>() != nullptr;
    }

    void say(const record::ModemEvent& e) const {
        using Event = record::ModemEvent::Event;
        const auto with = [&](const std::string& what) {
            return device_ + ": " + what + (e.text.empty() ? "" : ": " + e.text);
        };
        switch (e.event) {
            case Event::device_lost:
                return io_.warn(with("lost"));
            case Event::device_back:
                return io_.warn(with("is back"));
            case Event::not_responding:
                return io_.warn(with("the modem does not answer"));
            case Event::reboot:
                return io_.warn(with("the modem started anew"));
            case Event::config_refused:
                return io_.warn(with("a setting was refused"));
            case Event::error:
                return io_.inform(with("the modem says"));
            case Event::ready:
                return io_.inform(with("ready"));
            default:
                return;
        }
    }

    void say_losses() const {
        if (driver_.bad_lines() > 0)
            io_.warn(device_ + ": " + counted(driver_.bad_lines(), "line") + " could not be used");
        for (std::size_t k = 0; k < feedback_.size(); ++k) {
            if (feedback_[k].dropped() == 0) continue;
            io_.warn(options_.feedback[k] + ": " + counted(feedback_[k].dropped(), "record") +
                     " found no room");
        }
    }

    cli::Io& io_;
    const MmSerialOptions& options_;
    std::string device_;
    RecordIo records_;
    cli::Loop loop_;
    modem::Driver driver_;
    std::optional<stream::SerialLine> line_;
    std::deque<stream::FeedbackFifo> feedback_;
    std::string held_, bytes_;
    std::optional<std::int64_t> reopen_, end_;
    std::uint64_t lost_ = 0;  ///< records that standard output had no room for
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_MM_SERIAL_SESSION_HPP
