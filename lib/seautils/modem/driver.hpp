#ifndef SEAUTILS_MODEM_DRIVER_HPP
#define SEAUTILS_MODEM_DRIVER_HPP

#include "seautils/core/rate_table.hpp"
#include "seautils/modem/dialog.hpp"
#include "seautils/modem/line_reader.hpp"
#include "seautils/modem/listener.hpp"
#include "seautils/modem/moment.hpp"
#include "seautils/modem/options.hpp"
#include "seautils/modem/outgoing.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::modem {

/// The dialogue with one Micro-Modem, as a state machine without input, output or clock: told what
/// happened and when, it says what to write to the modem, and which records to give out.
///
///     driver.opened(now);
///     for (;;) {
///         write(driver.output());  // lines to the modem, records
///         wait for a line, a transmission, or driver.wake()
///         driver.line(…, now), driver.transmit(…, now), or driver.tick(now)
///     }
///
/// After the device was opened it writes the settings, starts the modem anew, sets its clock, and is
/// ready; after the modem started by itself, the same again. One command is outstanding at a time,
/// answered within 5 s or said again, three times at most; five answers missed in a row without a word
/// from the modem mean that nobody is there. At most one transmission is under way.
class Driver {
public:
    struct Output {
        std::string to_modem;  ///< lines with their ends
        std::vector<record::Record> records;
        bool reopen = false;  ///< nobody answers: close the device, and open it again
    };

    /// @throws DataError  a setting, address or frequency that cannot be
    explicit Driver(Options options);

    void opened(Moment now);
    /// @param why  for people: `Input/output error`
    void lost(const std::string& why, Moment now);

    /// A line from the modem, with its end or without.
    void line(std::string_view line, Moment now);
    /// Answered by one result: at once where it cannot be sent, else when it was, or was not.
    void transmit(const record::Transmission& transmission, Moment now);
    /// Time has passed. May be called at any time.
    void tick(Moment now);
    /// Somebody stepped the system's clock: the modem's is set again.
    void clock_stepped(Moment now);

    /// When tick() is due, on the steady clock.
    std::optional<std::int64_t> wake() const;
    /// What is to be done since it was taken last; the caller empties it.
    Output& output() { return out_; }

    bool ready() const { return ready_; }
    std::uint64_t bad_lines() const { return bad_lines_; }

private:
    struct Poll {  ///< another began a cycle in which we are to send
        Cycle cycle;
        std::int64_t until = 0;
        std::optional<DataRequest> request;
    };
    struct Awaited {  ///< who has still to acknowledge what
        std::uint32_t number = 0, dest = 0;
        unsigned frames = 0;             ///< bit k: frame k
        std::int64_t until = INT64_MAX;  ///< on the steady clock, once the sound has left
    };
    struct Asked {  ///< whose answer means a range
        std::uint32_t number = 0, dest = 0;
        bool transponders = false;
    };

    void configure();
    void close(const std::string& why, Moment now);
    void step(Moment now);
    void say_front(Moment now);
    void say_clock(Moment now);
    void give_up(Moment now);
    void write(const std::string& body, Moment now);
    void take(const Sentence& s, Moment now);
    bool answered(const Sentence& s, Moment now);
    void on_setting(const Sentence& s, Moment now);
    void on_revision(const Revision& revision, Moment now);
    void on_clock(const Sentence& s, Moment now);
    void clock_is_off(double error_s, Moment now);
    void check_time_of_day(std::string_view time_of_day, Moment now);
    void on_fault(const Fault& fault, Moment now);
    void restarted(Moment now);
    void event(record::ModemEvent::Event event, std::string text, Moment now);
    void raw(record::Raw::Direction direction, std::string_view line, const std::string& fault,
             Moment now);
    bool second_generation() const { return generation_ == Generation::second; }

    // Transmissions: driver_transmit.cpp
    void start(Outgoing outgoing, Moment now);
    void answer_poll(const record::Transmission& t, Moment now);
    bool in_time(const Outgoing& o, Moment now) const;
    void accepted(Moment now);
    void on_cycle(const Cycle& cycle, Moment now);
    void on_data_request(const DataRequest& request, Moment now);
    void provide(const DataRequest& request, Moment now);
    void on_sound(bool begins, Moment now);
    void on_transmit_statistics(const Sentence& s, Moment now);
    void on_acknowledgement(const Acknowledgement& a, Moment now);
    void poll_unanswered(Moment now);
    void watch(Moment now);
    void end(record::Result::Outcome outcome, std::string why, Moment now);
    void refuse(const record::Transmission& t, record::Result::Outcome outcome, std::string why,
                Moment now);
    void on_ranges(std::size_t first, Moment now);

    Options options_;
    Generation generation_;
    LineReader reader_;
    Listener listener_;
    Dialog dialog_;
    Output out_;
    bool open_ = false, ready_ = false, was_lost_ = false, zero_based_ = false, pad_even_ = false;
    // Times on the steady clock.
    std::int64_t heard_ = 0;                   ///< when the modem last said anything
    std::int64_t start_expected_ = INT64_MIN;  ///< until when a start is our own doing
    std::int64_t gateway_due_ = 0;             ///< when the buoy wants to hear from us
    std::optional<std::int64_t> clock_set_;    ///< when
    std::optional<std::int64_t> clock_due_;    ///< when it can be
    int clock_tries_ = 0;
    std::optional<Outgoing> active_;
    std::optional<Poll> poll_;
    std::optional<Awaited> awaited_;
    std::optional<Asked> asked_;
    std::uint64_t bad_lines_ = 0;
};

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_DRIVER_HPP
