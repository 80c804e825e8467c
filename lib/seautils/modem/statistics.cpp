#include "seautils/modem/statistics.hpp"

#include "seautils/core/error.hpp"
#include "seautils/modem/fields.hpp"

#include <fmt/format.h>

#include <chrono>

namespace seautils::modem {

namespace {

using record::ReceiveStatistics;
using record::TransmitStatistics;
using record::UtcTime;

/// Puts fields, from left to right, into members.
class Reader {
public:
    Reader(const Fields& fields, std::size_t first) : fields_(fields), at_(first) {}

    std::string_view text() { return fields_.text(at_++); }
    void whole(std::optional<std::uint32_t>& to, std::uint32_t most) {
        if (const auto value = fields_.maybe_whole(at_++, 0, most))
            to = static_cast<std::uint32_t>(*value);
    }
    void whole(std::optional<std::int32_t>& to) {
        if (const auto value = fields_.maybe_whole(at_++, -1'000'000, 1'000'000))
            to = static_cast<std::int32_t>(*value);
    }
    void real(std::optional<double>& to) { to = fields_.maybe_real(at_++); }

private:
    const Fields& fields_;
    std::size_t at_;
};

/// `hhmmss.ffff`, or `yyyymmddHHMMSS.ffff`.
std::optional<UtcTime> arrival_of(std::string_view text, std::optional<UtcTime> near) {
    const bool dated = text.substr(0, text.find('.')).size() == 14;
    const auto time = time_of_day_ns(dated ? text.substr(8) : text);
    if (!time) return {};
    if (!dated) return near ? std::optional(nearest_day(*time, *near)) : std::nullopt;
    const auto date = date_ns(text.substr(0, 8));
    return date ? std::optional(UtcTime{*date + *time}) : std::nullopt;
}

/// `4125000,5000` at the end: the comma behind the noise is missing in this firmware.
void split_noise(ReceiveStatistics& s) {
    if (!s.noise_db || *s.noise_db < 10'000 || s.bandwidth_hz) return;
    s.bandwidth_hz = s.carrier_hz;
    const auto joined = static_cast<std::int64_t>(*s.noise_db);
    s.noise_db = static_cast<double>(joined / 100'000);
    s.carrier_hz = static_cast<double>(joined % 100'000);
}

void read_packet(Reader& r, ReceiveStatistics& s) {
    r.whole(s.rate, 14);
    r.whole(s.src, 127);
    r.whole(s.dest, 127);
    r.whole(s.psk_error, 255);
    r.whole(s.packet_type, 255);
    r.whole(s.frames, 255);
    r.whole(s.bad_frames, 255);
    r.whole(s.snr_rss_db);
    r.real(s.snr_in_db);
    r.real(s.snr_out_db);
    r.real(s.snr_symbols_db);
    r.real(s.mse_db);
    r.whole(s.dqf);
    r.real(s.doppler_mps);
    r.real(s.noise_db);
    r.real(s.carrier_hz);
    r.real(s.bandwidth_hz);
}

template <class T>
std::string cell(const std::optional<T>& value) {
    return value ? fmt::format("{}", *value) : std::string();
}

std::string cell(const std::optional<bool>& value) {
    return value ? (*value ? "1" : "0") : std::string();
}

/// `yyyymmdd<separator>HHMMSS.ffffff`.
std::string stamp(const std::optional<UtcTime>& time, std::string_view separator) {
    namespace chr = std::chrono;
    if (!time) return std::string(separator);
    const chr::sys_time<chr::microseconds> us{chr::microseconds{time->ns / 1000}};
    const auto day = chr::floor<chr::days>(us);
    const chr::year_month_day date{day};
    const chr::hh_mm_ss clock{us - day};
    return fmt::format("{:04}{:02}{:02}{}{:02}{:02}{:02}.{:06}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       separator, clock.hours().count(), clock.minutes().count(),
                       clock.seconds().count(), clock.subseconds().count());
}

}  // namespace

record::ReceiveStatistics receive_statistics(const stream::Sentence& cacst,
                                             std::optional<UtcTime> near) {
    const Fields fields(cacst);
    // Versions begin with 6; what stands first without one is the mode, 0 to 2.
    const std::size_t first = fields.whole(1, 99) >= 6 ? 2 : 1;
    fields.need(first);
    Reader r(fields, first);
    ReceiveStatistics s;
    r.whole(s.mode, 2);
    s.arrival = arrival_of(r.text(), near);
    r.whole(s.clock_mode, 255);
    for (auto* value : {&s.mfd_peak, &s.mfd_power_db, &s.mfd_ratio, &s.spl_db, &s.shf_again,
                        &s.shf_ashift, &s.shf_ainp_shift, &s.shf_amfd_shift, &s.shf_p2b_db}) {
        r.whole(*value);
    }
    read_packet(r, s);
    if (first == 1 && fields.count() == 28) split_noise(s);
    return s;
}

record::TransmitStatistics transmit_statistics(const stream::Sentence& caxst) {
    const Fields fields(caxst);
    fields.need(5);
    Reader r(fields, fields.text(1).size() < 8 ? 2 : 1);
    TransmitStatistics s;
    const auto date = date_ns(r.text());
    const auto time = time_of_day_ns(r.text());
    if (date && time) s.sent = UtcTime{*date + *time};
    r.whole(s.clock_mode, 255);
    r.whole(s.mode, 255);
    r.whole(s.probe_length, 1'000'000);
    r.real(s.bandwidth_hz);
    r.real(s.carrier_hz);
    r.whole(s.rate, 14);
    r.whole(s.src, 127);
    r.whole(s.dest, 127);
    std::optional<std::uint32_t> ack;
    r.whole(ack, 1);
    if (ack) s.ack_requested = *ack == 1;
    r.whole(s.frames_expected, 255);
    r.whole(s.frames_sent, 255);
    r.whole(s.packet_type, 255);
    r.whole(s.bytes, 65535);
    return s;
}

std::string_view transmit_fault(std::uint32_t mode) {
    switch (mode) {
        case 1:
            return "the power amplifier is hot";
        case 2:
            return "no external synchronization";
        case 3:
            return "transmitting is inhibited";
        case 4:
            return "the modem did not get its data in time";
        default:
            return "the modem reports a failed transmission";
    }
}

std::string compose(const ReceiveStatistics& s) {
    return fmt::format(
        "CACST,8,{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{"
        "},"
        "{}",
        cell(s.mode), stamp(s.arrival, ""), cell(s.clock_mode), cell(s.mfd_peak),
        cell(s.mfd_power_db), cell(s.mfd_ratio), cell(s.spl_db), cell(s.shf_again),
        cell(s.shf_ashift), cell(s.shf_ainp_shift), cell(s.shf_amfd_shift), cell(s.shf_p2b_db),
        cell(s.rate), cell(s.src), cell(s.dest), cell(s.psk_error), cell(s.packet_type),
        cell(s.frames), cell(s.bad_frames), cell(s.snr_rss_db), cell(s.snr_in_db),
        cell(s.snr_out_db), cell(s.snr_symbols_db), cell(s.mse_db), cell(s.dqf),
        cell(s.doppler_mps), cell(s.noise_db), cell(s.carrier_hz), cell(s.bandwidth_hz));
}

std::string compose(const TransmitStatistics& s) {
    return fmt::format("CAXST,7,{},{},{},{},{},{},{},{},{},{},{},{},{},{}", stamp(s.sent, ","),
                       cell(s.clock_mode), cell(s.mode), cell(s.probe_length), cell(s.bandwidth_hz),
                       cell(s.carrier_hz), cell(s.rate), cell(s.src), cell(s.dest),
                       cell(s.ack_requested), cell(s.frames_expected), cell(s.frames_sent),
                       cell(s.packet_type), cell(s.bytes));
}

}  // namespace seautils::modem
