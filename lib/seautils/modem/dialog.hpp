#ifndef SEAUTILS_MODEM_DIALOG_HPP
#define SEAUTILS_MODEM_DIALOG_HPP

#include "seautils/stream/nmea.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace seautils::modem {

/// Something to be said to a modem, or to be waited for before more is said.
struct Command {
    enum class Kind : std::uint8_t {
        setting,       ///< CCCFG
        reset,         ///< CCMSC
        pause,         ///< says nothing for a while
        clock,         ///< CCCLK or CCTMS, at the right moment of a second
        query,         ///< CCCFQ of all settings: answered until it falls silent
        keep_alive,    ///< any answer will do
        transmission,  ///< CCCYC, CCMPC …
        ready,         ///< nothing: all before it is done
    };
    Kind kind = Kind::setting;
    std::string body;   ///< address and fields
    std::string reply;  ///< what the body of the answer begins with, whole fields: `CACFG,SRC,1`
    std::chrono::nanoseconds pause{};
};

/// The commands to a modem, one after the other: the next one is said when the last was answered, and
/// again when that takes too long.
class Dialog {
public:
    static constexpr std::chrono::seconds answer_time{5};
    static constexpr int tries = 3;  ///< of a command, then it is dropped
    static constexpr int failures =
        5;  ///< answers missed without hearing anything: nobody is there

    enum class Step {
        wait,     ///< for an answer until wake(), or for a command
        say,      ///< say front(), then call said()
        give_up,  ///< front() was not answered three times, or was refused: take it off with pop()
        dead,     ///< nobody is there
    };

    void push(Command command) { queue_.push_back(std::move(command)); }
    void push_front(Command command);
    void clear();

    Step step(std::int64_t steady_ns);
    const Command& front() const { return queue_.front(); }
    /// Words front() anew.
    void word(std::string body, std::string reply);
    /// front() was said, and is to be answered within a time.
    void said(std::int64_t steady_ns, std::chrono::nanoseconds within = answer_time);
    /// What answers front() piece by piece has not ended yet.
    void wait_until(std::int64_t steady_ns) { due_ = steady_ns; }
    void pop();

    /// Whether the sentence answers front(), which is then for the caller to take off.
    bool is_answer(const stream::Sentence& s) const;
    /// The modem did not understand front(): it is said again at once, or given up.
    void refused() { again_ = tries_ > 0; }
    /// The modem forgot that front() was said: it is as if it had not been.
    void forgotten();
    /// Anything was heard: somebody is there.
    void heard() { unanswered_ = 0; }

    bool empty() const { return queue_.empty(); }
    bool outstanding() const { return tries_ > 0; }
    bool outstanding(Command::Kind kind) const { return tries_ > 0 && front().kind == kind; }
    /// When step() has something new to say, on the steady clock.
    std::optional<std::int64_t> wake() const;

private:
    std::deque<Command> queue_;
    int tries_ = 0;       ///< how often front() was said
    bool again_ = false;  ///< it is time to say it again
    int unanswered_ = 0;
    std::int64_t due_ = 0;
};

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_DIALOG_HPP
