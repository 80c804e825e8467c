#include "seautils/sim/table.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seautils::sim {

Curve::Curve(std::vector<std::pair<double, double>> points) : points_(std::move(points)) {
    if (points_.empty()) throw ConfigError("a table without points");
    for (std::size_t k = 1; k < points_.size(); ++k) {
        if (points_[k].first > points_[k - 1].first) continue;
        throw ConfigError(fmt::format("{} follows {}: the first column must increase",
                                      points_[k].first, points_[k - 1].first));
    }
}

double Curve::at(double x) const {
    const auto above = std::upper_bound(points_.begin(), points_.end(), x,
                                        [](double v, const auto& p) { return v < p.first; });
    if (above == points_.begin()) return points_.front().second;
    if (above == points_.end()) return points_.back().second;
    const auto& [x0, y0] = *(above - 1);
    const auto& [x1, y1] = *above;
    return y0 + (y1 - y0) * ((x - x0) / (x1 - x0));
}

double number(std::string_view what, std::string_view text, double least, double most,
              std::string_view unit) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        throw ConfigError(fmt::format("{} {} is not a number", what, quote(text)));
    if (value < least || value > most) {
        throw ConfigError(fmt::format("{} {} is outside {} to {}{}{}", what, quote(text), least,
                                      most, unit.empty() ? "" : " ", unit));
    }
    return value;
}

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> words;
    for (;;) {
        const std::size_t at = text.find(separator);
        words.push_back(trim(text.substr(0, at)));
        if (at == text.npos) return words;
        text.remove_prefix(at + 1);
    }
}

Csv::Csv(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {
    std::string_view first;
    if (!line(first)) throw ConfigError(name_ + ": no line of column names");
    names_ = split(first, ',');
}

int Csv::column(const std::vector<std::string_view>& names) const {
    for (const std::string_view name : names) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found != names_.end()) return static_cast<int>(found - names_.begin());
    }
    return -1;
}

bool Csv::next(std::vector<std::string_view>& values) {
    std::string_view row;
    if (!line(row)) return false;
    values = split(row, ',');
    if (values.size() != names_.size())
        fault(fmt::format("{} where {} are named", counted(values.size(), "value"), names_.size()));
    return true;
}

void Csv::fault(const std::string& what) const {
    throw ConfigError(fmt::format("{}:{}: {}", name_, number_, what));
}

bool Csv::line(std::string_view& line) {
    while (!rest_.empty()) {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        line = trim(rest_.substr(0, end));
        rest_.remove_prefix(std::min(rest_.size(), end + 1));
        ++number_;
        if (!line.empty() && line.front() != '#') return true;
    }
    return false;
}

}  // namespace seautils::sim
