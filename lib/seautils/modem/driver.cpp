#include "seautils/modem/driver.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::modem {

namespace {

using record::ModemEvent;
using record::Raw;
using record::Result;
using Kind = Command::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds silence{10};   ///< of the modem, until it is asked whether it is there
constexpr seconds settling{2};   ///< after it started, before it is spoken to
constexpr seconds starting{10};  ///< after CCMSC, in which a start is no surprise
constexpr seconds query_end{2};  ///< without CACFG: all settings have been told

constexpr seconds gateway_pause{30};  ///< between words to a gateway buoy

constexpr unsigned pad_before_build = 35490;  ///< firmware before this needs data of even length

Command setting(const Setting& s) {
    return {Kind::setting, compose("CCCFG", s), compose("CACFG", s), {}};
}

}  // namespace

Driver::Driver(Options options)
    : options_(std::move(options)),
      generation_(options_.generation),
      listener_(options_.sound_speed_mps) {
    options_.check();
}

void Driver::opened(Moment now) {
    open_ = true;
    heard_ = now.steady_ns;
    gateway_due_ = now.steady_ns;
    zero_based_ = false;
    if (was_lost_) event(ModemEvent::Event::device_back, {}, now);
    configure();
    if (options_.reset) {
        const std::string id = std::to_string(options_.id);
        dialog_.push({Kind::reset, "CCMSC," + id + "," + id + ",0", "CAREV", {}});
    }
    dialog_.push({Kind::clock, {}, {}, {}});
    if (options_.query) dialog_.push({Kind::query, {}, {}, {}});
    dialog_.push({Kind::ready, {}, {}, {}});
    step(now);
}

/// All settings: what ends a reception must be told (CST), who we are, and when it starts or hears
/// something (REV, RXP).
void Driver::configure() {
    dialog_.clear();
    ready_ = false;
    if (options_.reset_settings && !options_.gateway) dialog_.push(setting({"ALL", "0"}));
    dialog_.push(setting({"CST", "1"}));
    for (const Setting& s : options_.settings) dialog_.push(setting(s));
    if (options_.lbl.turnaround_ms != Lbl{}.turnaround_ms)
        dialog_.push(setting({"TAT", std::to_string(options_.lbl.turnaround_ms)}));
    dialog_.push(setting({"SRC", std::to_string(options_.id)}));
    dialog_.push(setting({"REV", "1"}));
    dialog_.push(setting({"RXP", "1"}));
}

void Driver::lost(const std::string& why, Moment now) {
    if (!open_) return;
    event(ModemEvent::Event::device_lost, why, now);
    close("the device was lost", now);
}

/// Until it is opened again.
void Driver::close(const std::string& why, Moment now) {
    open_ = false;
    was_lost_ = true;
    end(Result::Outcome::failed, why, now);
    poll_.reset();
    asked_.reset();
    listener_.reset(out_.records);
    dialog_.clear();
    ready_ = false;
}

/// The modem started by itself: what was under way is lost, and so are its clock and settings.
void Driver::restarted(Moment now) {
    event(ModemEvent::Event::reboot, {}, now);
    end(Result::Outcome::failed, "the modem started anew", now);
    poll_.reset();
    listener_.reset(out_.records);
    configure();
    dialog_.push_front({Kind::pause, {}, {}, settling});
    dialog_.push({Kind::clock, {}, {}, {}});
    dialog_.push({Kind::ready, {}, {}, {}});
}

void Driver::event(ModemEvent::Event what, std::string text, Moment now) {
    add_event(out_.records, now.utc, what, std::move(text));
}

void Driver::raw(Raw::Direction direction, std::string_view line, const std::string& fault,
                 Moment now) {
    if (!options_.raw && fault.empty()) return;
    Raw r;
    r.direction = direction;
    r.line = raw_text(line);
    r.fault = fault;
    add(out_.records, now.utc, std::move(r));
}

void Driver::write(const std::string& body, Moment now) {
    std::string line;
    stream::append_sentence(line, body);
    raw(Raw::Direction::out, line, {}, now);
    if (options_.gateway) out_.to_modem += fmt::format("#M{}", *options_.gateway);
    out_.to_modem += line;
}

/// Says what is to be said now.
void Driver::step(Moment now) {
    clock_due_.reset();
    while (open_) {
        switch (dialog_.step(now.steady_ns)) {
            case Dialog::Step::wait:
                return;
            case Dialog::Step::give_up:
                give_up(now);
                break;
            case Dialog::Step::dead:
                event(ModemEvent::Event::not_responding,
                      fmt::format("{} commands were not answered", Dialog::failures), now);
                close("the modem does not answer", now);
                out_.reopen = true;
                return;
            case Dialog::Step::say:
                if (dialog_.front().kind == Kind::clock) {
                    say_clock(now);
                    if (clock_due_) return;
                } else {
                    say_front(now);
                }
        }
    }
}

void Driver::say_front(Moment now) {
    const Command& c = dialog_.front();
    switch (c.kind) {
        case Kind::ready:
            dialog_.pop();
            ready_ = true;
            event(ModemEvent::Event::ready, {}, now);
            return;
        case Kind::pause:
            dialog_.said(now.steady_ns, c.pause);
            return;
        case Kind::query:
            write(second_generation() ? "CCCFQ,TOP" : "CCCFQ,ALL", now);
            dialog_.said(now.steady_ns, query_end);
            return;
        case Kind::reset:
            start_expected_ = now.after(starting);
            break;
        case Kind::transmission:
            if (active_ && in_time(*active_, now)) break;
            dialog_.pop();
            end(Result::Outcome::late, "it would end behind its deadline", now);
            return;
        default:
            break;
    }
    write(c.body, now);
    dialog_.said(now.steady_ns);
}

void Driver::give_up(Moment now) {
    const Command c = dialog_.front();
    dialog_.pop();
    switch (c.kind) {
        case Kind::setting:
            event(ModemEvent::Event::config_refused, c.body + " was not echoed", now);
            return;
        case Kind::transmission:
            end(Result::Outcome::failed, "the modem did not take " + c.body.substr(0, 5), now);
            return;
        case Kind::pause:
        case Kind::query:
        case Kind::ready:
            return;
        case Kind::clock:
            event(ModemEvent::Event::error, "the clock could not be set", now);
            return;
        case Kind::reset:
        case Kind::keep_alive:
            event(ModemEvent::Event::error, c.body + " was not answered", now);
            return;
    }
}

void Driver::line(std::string_view line, Moment now) {
    Sentence s;
    std::string fault = reader_.read(line, s);
    const std::size_t first = out_.records.size();
    raw(Raw::Direction::in, line, fault, now);
    if (fault.empty()) {
        heard_ = now.steady_ns;
        dialog_.heard();
        try {
            take(s, now);
        } catch (const DataError& e) {
            fault = e.what();
            if (options_.raw)
                std::get<Raw>(out_.records[first].kind).fault = fault;
            else
                raw(Raw::Direction::in, line, fault, now);
        }
    }
    if (!fault.empty()) ++bad_lines_;
    tick(now);
}

void Driver::take(const Sentence& s, Moment now) {
    const bool was_answer = answered(s, now);
    const std::uint64_t address = code(s.address());
    const std::size_t first = out_.records.size();
    switch (address) {
        case code("CACYC"):
            if (!was_answer) on_cycle(read_cycle(s), now);
            return;
        case code("CADRQ"):
            return on_data_request(read_data_request(s), now);
        case code("CATXD"):
            if (active_) active_->last_data.clear();
            return;
        case code("CATXP"):
            return on_sound(true, now);
        case code("CATXF"):
            return on_sound(false, now);
        case code("CAXST"):
            return on_transmit_statistics(s, now);
        case code("CAACK"):
            return on_acknowledgement(read_acknowledgement(s), now);
        case code("CACFG"):
            return on_setting(s, now);
        case code("CAREV"):
            return on_revision(read_revision(s), now);
        case code("CACLK"):
        case code("CATMS"):
        case code("CATMQ"):
            return on_clock(s, now);
        case code("CAERR"):
            return on_fault(read_fault(s), now);
        default:
            listener_.take(s, address, now, out_.records);
    }
    on_ranges(first, now);
}

/// Takes off the command that this answers.
bool Driver::answered(const Sentence& s, Moment now) {
    if (!dialog_.is_answer(s)) return false;
    const Kind kind = dialog_.front().kind;
    dialog_.pop();
    if (kind == Kind::transmission) accepted(now);
    return true;
}

/// A setting that was echoed with another value is said again.
void Driver::on_setting(const Sentence& s, Moment now) {
    if (dialog_.outstanding(Kind::query)) dialog_.wait_until(now.after(query_end));
    if (!dialog_.outstanding(Kind::setting)) return;
    const std::string& wanted = dialog_.front().reply;
    const std::string name = fmt::format("CACFG,{},", s[1]);
    if (wanted.starts_with(name)) dialog_.refused();
}

void Driver::on_revision(const Revision& revision, Moment now) {
    if (const auto major = revision.major_number();
        major && options_.generation == Generation::unknown) {
        generation_ = *major >= 2 ? Generation::second : Generation::first;
    }
    if (const auto build = revision.build_number())
        pad_even_ = second_generation() && *build < pad_before_build;
    if (!revision.started()) return check_time_of_day(revision.time_of_day, now);
    if (now.steady_ns >= start_expected_) return restarted(now);
    dialog_.forgotten();
    dialog_.push_front({Kind::pause, {}, {}, settling});
}

void Driver::on_fault(const Fault& fault, Moment now) {
    event(ModemEvent::Event::error, std::string(fault.text), now);
    if (fault.data_timeout) {
        if (active_ && active_->accepted)
            end(Result::Outcome::failed, "the modem did not get its data in time", now);
        return;
    }
    if (dialog_.outstanding(Kind::pause)) return;  // about nothing that was said
    const bool of_front = dialog_.outstanding() && !fault.module.empty() &&
                          dialog_.front().body.compare(0, 2, "CC") == 0 &&
                          dialog_.front().body.compare(2, fault.module.size(), fault.module) == 0;
    if (of_front && dialog_.front().kind == Kind::transmission)
        return end(Result::Outcome::failed, "the modem refused it: " + std::string(fault.text),
                   now);
    if (!fault.unknown_command && !of_front) return;
    if (dialog_.outstanding()) {
        // A modem that does not know one generation's way to set its clock is of the other.
        if (dialog_.front().kind == Kind::clock && options_.generation == Generation::unknown)
            generation_ = second_generation() ? Generation::first : Generation::second;
        dialog_.refused();
    } else if (active_ && !active_->last_data.empty() && active_->data_tries < Dialog::tries) {
        ++active_->data_tries;
        write(active_->last_data, now);
    }
}

void Driver::tick(Moment now) {
    if (!open_) return;
    listener_.tick(now, out_.records);
    watch(now);
    if (now.steady_ns >= heard_ + std::chrono::nanoseconds(silence).count() && dialog_.empty()) {
        const bool second = second_generation();
        dialog_.push({Kind::keep_alive,
                      second ? "CCTMQ,0" : "CCCFQ,SRC",
                      second ? "CATMQ" : "CACFG,SRC",
                      {}});
    }
    if (options_.gateway && now.steady_ns >= gateway_due_) {
        out_.to_modem += fmt::format("#G{}\r\n", *options_.gateway);
        gateway_due_ = now.after(gateway_pause);
    }
    step(now);
}

std::optional<std::int64_t> Driver::wake() const {
    if (!open_) return {};
    std::int64_t due = heard_ + std::chrono::nanoseconds(silence).count();
    const auto sooner = [&](std::optional<std::int64_t> t) { due = t ? std::min(due, *t) : due; };
    if (!dialog_.empty()) due = INT64_MAX;
    sooner(dialog_.wake());
    sooner(clock_due_);
    sooner(listener_.wake());
    if (active_ && active_->accepted) sooner(active_->gives_up);
    if (poll_) sooner(poll_->until);
    if (options_.gateway) sooner(gateway_due_);
    return due == INT64_MAX ? std::nullopt : std::optional(due);
}

}  // namespace seautils::modem
