#include "seautils/core/rate_table.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace seautils {

namespace {

using std::chrono::milliseconds;

constexpr std::array columns = {"kind",     "rate",    "frames",  "frame_bytes",
                                "packet_s", "probe_s", "cycle_s", "ack_s"};
using Cells = std::array<std::string_view, columns.size()>;

/// The words of a line, up to a comment. @throws std::invalid_argument  too many, or too few
bool split(std::string_view line, Cells& cells) {
    line = line.substr(0, line.find('#'));
    std::size_t count = 0;
    for (;;) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
        if (line.empty()) break;
        const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
        if (count < cells.size()) cells[count] = line.substr(0, length);
        ++count;
        line.remove_prefix(length);
    }
    if (count == 0) return false;
    if (count != cells.size()) {
        throw std::invalid_argument(fmt::format("{} where there should be {}: {}",
                                                counted(count, "column"), cells.size(),
                                                fmt::join(columns, " ")));
    }
    return true;
}

unsigned whole(const Cells& cells, std::size_t k, unsigned least, unsigned most) {
    const std::string_view cell = cells[k];
    unsigned value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || value < least || value > most) {
        throw std::invalid_argument(fmt::format("{} {} is not a whole number {} to {}", columns[k],
                                                quote(cell), least, most));
    }
    return value;
}

Rate::Time seconds(const Cells& cells, std::size_t k, double least) {
    const std::string_view cell = cells[k];
    double value = 0;
    const auto [end, error] =
        std::from_chars(cell.data(), cell.data() + cell.size(), value, std::chars_format::fixed);
    const bool whole_cell = error == std::errc() && end == cell.data() + cell.size();
    if (!whole_cell || !(value >= least && value <= 600)) {
        throw std::invalid_argument(
            fmt::format("{} {} is not a time of {} to 600 s", columns[k], quote(cell), least));
    }
    return Rate::Time{static_cast<Rate::Time::rep>(value * 1e6 + 0.5)};
}

Rate rate_of(const Cells& cells) {
    Rate r;
    r.rate = whole(cells, 1, 0, 14);
    r.frames = whole(cells, 2, 1, 8);
    r.frame_bytes = whole(cells, 3, 1, 2048);
    r.packet = seconds(cells, 4, 0.001);
    r.probe = seconds(cells, 5, 0);
    r.cycle = seconds(cells, 6, 0);
    r.ack = seconds(cells, 7, 0);
    return r;
}

void insert(std::vector<Rate>& rates, const Rate& rate) {
    const auto place = std::find_if(rates.begin(), rates.end(),
                                    [&](const Rate& other) { return other.rate >= rate.rate; });
    if (place != rates.end() && place->rate == rate.rate)
        throw std::invalid_argument(fmt::format("rate {} comes twice", rate.rate));
    rates.insert(place, rate);
}

const Rate& find(const std::vector<Rate>& rates, unsigned rate, const char* kind) {
    for (const Rate& r : rates) {
        if (r.rate == rate) return r;
    }
    std::vector<unsigned> there;
    for (const Rate& r : rates) there.push_back(r.rate);
    throw DataError(fmt::format("{} rate {} is none of {}", kind, rate, fmt::join(there, " ")));
}

}  // namespace

Rate::Time Rate::packet_time(unsigned n) const {
    if (n < 1 || n > frames) {
        throw std::out_of_range(fmt::format("{} where a packet of rate {} has 1 to {}",
                                            counted(n, "frame"), rate, frames));
    }
    return probe + packet * n / frames;
}

Rate::Time Rate::air_time(unsigned n, bool ack_requested) const {
    return cycle + packet_time(n) + (ack_requested ? ack : Time{});
}

RateTable::RateTable()
    : data_{{0, 1, 32, milliseconds{3200}, milliseconds{0}, milliseconds{900}, milliseconds{900}},
            {1, 3, 64, milliseconds{6100}, milliseconds{300}, milliseconds{0}, milliseconds{900}},
            {2, 3, 64, milliseconds{3100}, milliseconds{300}, milliseconds{0}, milliseconds{900}},
            {3, 2, 256, milliseconds{3400}, milliseconds{300}, milliseconds{0}, milliseconds{900}},
            {4, 2, 256, milliseconds{3200}, milliseconds{300}, milliseconds{0}, milliseconds{900}},
            {5, 8, 256, milliseconds{3100}, milliseconds{300}, milliseconds{0}, milliseconds{900}},
            {6, 6, 32, milliseconds{2950}, milliseconds{300}, milliseconds{0}, milliseconds{900}}},
      flexible_{
          {1, 3, 64, milliseconds{6100}, milliseconds{300}, milliseconds{0}, milliseconds{0}},
          {3, 1, 100, milliseconds{700}, milliseconds{300}, milliseconds{0}, milliseconds{0}},
          {5, 8, 256, milliseconds{3100}, milliseconds{300}, milliseconds{0}, milliseconds{0}}} {}

RateTable RateTable::parse(std::string_view text, const std::string& name) {
    RateTable table;
    table.data_.clear();
    table.flexible_.clear();
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        try {
            Cells cells;
            if (split(text.substr(0, length), cells)) {
                const bool flexible = cells[0] == "flexible";
                if (!flexible && cells[0] != "data")
                    throw std::invalid_argument("kind " + quote(cells[0]) +
                                                " is neither data nor flexible");
                insert(flexible ? table.flexible_ : table.data_, rate_of(cells));
            }
        } catch (const std::invalid_argument& e) {
            throw ConfigError(fmt::format("{}:{}: {}", name, line, e.what()));
        }
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    if (table.data_.empty()) throw ConfigError(name + ": no rate of kind data");
    return table;
}

const Rate& RateTable::data(unsigned rate) const { return find(data_, rate, "data"); }

const Rate& RateTable::flexible(unsigned rate) const { return find(flexible_, rate, "flexible"); }

}  // namespace seautils
