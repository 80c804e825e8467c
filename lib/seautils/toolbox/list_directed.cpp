#include "seautils/toolbox/list_directed.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace seautils::toolbox {

namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::string_view separators = " \t\r\n,/";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number as Fortran writes it: `1.5d3`, `2+3` and `5.` too.
std::optional<double> real_of(std::string_view token) {
    std::string plain;
    for (std::size_t k = 0; k < token.size(); ++k) {
        const char c = token[k];
        if (c == 'd' || c == 'D' || c == 'q' || c == 'Q') {
            plain += 'e';
        } else if ((c == '+' || c == '-') && k > 0 &&
                   (is_digit(token[k - 1]) || token[k - 1] == '.')) {
            plain += 'e';
            plain += c;
        } else {
            plain += c;
        }
    }
    std::string_view text = plain;
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.empty() || text.find_first_not_of("0123456789.eE+-") != text.npos) return {};
    const std::size_t exponent = text.find_first_of("eE");
    std::string cleaned(text);
    if (exponent != text.npos && text.substr(exponent + 1).starts_with('+'))
        cleaned.erase(exponent + 1, 1);
    double x = 0;
    const char* const end = cleaned.data() + cleaned.size();
    const auto [at, fault] = std::from_chars(cleaned.data(), end, x);
    if (fault != std::errc() || at != end) return {};
    return x;
}

}  // namespace

double metres(double km) {
    const double micrometres = km * 1e9;
    return std::fabs(micrometres) < 1e15 ? std::round(micrometres) / 1e6 : km * 1000;
}

void ListDirected::refuse(std::string_view what) const {
    throw DataError(fmt::format("line {}: {}", line_, what));
}

void ListDirected::skip_line() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == text_.npos ? text_.size() : end + 1;
    if (end != text_.npos) ++line_;
}

/// Goes to what is no blank, over lines. False: there is nothing.
bool ListDirected::skip_blanks() {
    for (;;) {
        at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
        if (at_ == text_.size()) return false;
        if (text_[at_] != '\n') return true;
        skip_line();
    }
}

bool ListDirected::Read::next(std::string_view name) {
    if (is_ended_) return false;
    if (repeats_ > 0) {
        --repeats_;
        return !is_null_;
    }
    ListDirected& f = from_;
    if (!f.skip_blanks()) f.refuse(fmt::format("the file ends where {} is expected", name));
    is_ended_ = f.text_[f.at_] == '/';
    if (is_ended_) return false;
    take_repeats(name);
    is_null_ = f.at_ == f.text_.size() || separators.find(f.text_[f.at_]) != separators.npos;
    is_quoted_ = !is_null_ && (f.text_[f.at_] == '\'' || f.text_[f.at_] == '"');
    if (is_quoted_) take_quoted(name);
    if (!is_null_ && !is_quoted_) {
        const std::size_t end = std::min(f.text_.find_first_of(separators, f.at_), f.text_.size());
        token_ = f.text_.substr(f.at_, end - f.at_);
        f.at_ = end;
    }
    const std::size_t comma = f.text_.find_first_not_of(blanks, f.at_);
    if (comma != f.text_.npos && f.text_[comma] == ',') f.at_ = comma + 1;
    return !is_null_;
}

/// `3*`, if that is what comes.
void ListDirected::Read::take_repeats(std::string_view name) {
    ListDirected& f = from_;
    std::size_t end = f.at_;
    while (end < f.text_.size() && is_digit(f.text_[end])) ++end;
    if (end == f.at_ || end == f.text_.size() || f.text_[end] != '*') return;
    const std::string_view count = f.text_.substr(f.at_, end - f.at_);
    const auto [at, fault] = std::from_chars(count.data(), count.data() + count.size(), repeats_);
    if (fault != std::errc() || repeats_ < 1)
        f.refuse(fmt::format("{} cannot be there {} times", name, quote(count)));
    --repeats_;
    f.at_ = end + 1;
}

/// A text up to its closing quote; two quotes in it are one.
void ListDirected::Read::take_quoted(std::string_view name) {
    ListDirected& f = from_;
    const char mark = f.text_[f.at_++];
    token_.clear();
    for (;; ++f.at_) {
        if (f.at_ >= f.text_.size() || f.text_[f.at_] == '\n')
            f.refuse(fmt::format("the quotes of {} are not closed", name));
        if (f.text_[f.at_] == mark) {
            const bool is_double = f.at_ + 1 < f.text_.size() && f.text_[f.at_ + 1] == mark;
            ++f.at_;
            if (!is_double) return;
        }
        token_ += f.text_[f.at_];
    }
}

bool ListDirected::Read::real(double& x, std::string_view name) {
    if (!next(name)) return false;
    const std::optional<double> value = is_quoted_ ? std::nullopt : real_of(token_);
    if (!value || !std::isfinite(*value))
        from_.refuse(fmt::format("{} {} is not a number", name, quote(token_)));
    x = *value;
    return true;
}

bool ListDirected::Read::whole(std::int64_t& x, std::string_view name, std::int64_t least,
                               std::int64_t most) {
    double value = 0;
    if (!real(value, name)) return false;
    const bool is_within =
        value >= static_cast<double>(least) && value <= static_cast<double>(most);
    if (value != std::floor(value) || !is_within)
        from_.refuse(fmt::format("{} {} is not a whole number of {} to {}", name, quote(token_),
                                 least, most));
    x = static_cast<std::int64_t>(value);
    return true;
}

bool ListDirected::Read::text(std::string& x, std::string_view name) {
    if (!next(name)) return false;
    x = token_;
    return true;
}

std::vector<double> ListDirected::vector(std::string_view name, std::size_t most) {
    return values(name, most, [](double x) { return x; });
}
std::vector<double> ListDirected::vector_km(std::string_view name, std::size_t most) {
    return values(name, most, metres);
}

std::vector<double> ListDirected::values(std::string_view name, std::size_t most,
                                         double (*unit)(double)) {
    std::int64_t n = 0;
    read([&](Read& r) {
        if (!r.whole(n, fmt::format("the number of {}", name), 1, static_cast<std::int64_t>(most)))
            refuse(fmt::format("the number of {} is not given", name));
    });
    const auto count = static_cast<std::size_t>(n);
    std::vector<double> x;
    const std::size_t start = line_;
    read([&](Read& r) {
        double value = 0;
        for (; x.size() < count && r.real(value, name);) x.push_back(unit(value));
        if (x.size() < count && !r.is_ended())
            refuse(fmt::format("{}: value {} is left out", name, x.size() + 1));
    });
    if (x.size() == count) return x;
    if (x.empty() || x.size() > 2 || count < 3)
        throw DataError(
            fmt::format("line {}: {}: there are {} of {} values", start, name, x.size(), count));
    const double first = x.front(), last = x.back();
    x.resize(count, first);
    for (std::size_t k = 1; k < count; ++k)
        x[k] = first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1);
    return x;
}

}  // namespace seautils::toolbox
