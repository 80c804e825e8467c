#include "seautils/sim/nvram.hpp"

#include <algorithm>
#include <charconv>

namespace seautils::sim {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool is_small(char c) { return c >= 'a' && c <= 'z'; }

/// Whether all of it is a whole number that 32 bits hold, which `value` is then.
bool whole(std::string_view text, int& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

// Message switches (CST, RXP, REV) are off as they come: a driver has to ask for what it needs.
Nvram::Nvram(const NodeSpec& spec)
    : generation_(spec.generation), factory_{{"AGC", "1"},  {"AGN", "250"}, {"ASD", "0"},
                                             {"BND", "3"},  {"CPR", "0"},   {"CST", "0"},
                                             {"CTO", "10"}, {"DTH", "108"}, {"DTO", "5"},
                                             {"ECD", "50"}, {"HFC", "0"},   {"MFD", "0"},
                                             {"NRL", "25"}, {"NRV", "0"},   {"POW", "-157"},
                                             {"PTH", "50"}, {"PTO", "15"},  {"REV", "0"},
                                             {"RXA", "0"},  {"RXP", "0"},   {"SHF", "0"},
                                             {"SNR", "0"},  {"SNV", "0"},   {"SPL", "215"},
                                             {"TAT", "50"}, {"TXF", "1"},   {"TXP", "1"},
                                             {"XST", "1"}} {
    factory_["SRC"] = std::to_string(spec.id);
    if (generation_ == Generation::mm2) factory_["recv.base64data"] = "0";
    values_ = factory_;
    for (const auto& [name, value] : spec.nvram)
        if (knows(name)) set(name, value);
}

bool Nvram::knows(std::string_view name) const {
    const auto all = [&](auto fits) { return std::all_of(name.begin(), name.end(), fits); };
    if (!is_dotted(name))
        return name.size() == 3 && all([](char c) { return is_capital(c) || is_digit(c); });
    return generation_ == Generation::mm2 && name.size() <= 64 && name.front() != '.' &&
           name.back() != '.' && all([](char c) {
               return is_small(c) || is_capital(c) || is_digit(c) || c == '.' || c == '_';
           });
}

void Nvram::set(std::string_view name, std::string_view value) {
    int n = 0;
    const bool is_number = whole(value, n);
    if (name == "ALL") {
        if (is_number && n == 0) values_ = factory_;
        return;
    }
    if (is_dotted(name) ? value.empty() || value.size() > 64 : !is_number) return;
    if (name == "SRC" && (n < 0 || n > 127)) return;
    if (values_.size() >= 1000 && values_.find(name) == values_.end()) return;
    values_[std::string(name)] = value;
}

std::string_view Nvram::get(std::string_view name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? std::string_view("0") : found->second;
}

int Nvram::number(std::string_view name) const {
    int value = 0;
    whole(get(name), value);
    return value;
}

}  // namespace seautils::sim
