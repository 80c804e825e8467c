#include "seautils/schema/number_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>

namespace seautils::schema {

namespace {

constexpr std::array<double, 13> powers = {1,   1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                           1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
constexpr unsigned most_short = 6;  ///< decimals of a short number

/// Appends n / 10^decimals, |n| < 2^53, written with all of these decimals.
void append_scaled(std::string& out, std::int64_t n, unsigned decimals) {
    std::array<char, 32> digits;
    char* end = digits.data() + digits.size();
    char* at = end;
    auto rest = static_cast<std::uint64_t>(n < 0 ? -n : n);
    for (unsigned k = 0; k < decimals; ++k, rest /= 10) *--at = static_cast<char>('0' + rest % 10);
    if (decimals > 0) *--at = '.';
    do {
        *--at = static_cast<char>('0' + rest % 10);
        rest /= 10;
    } while (rest != 0);
    if (n < 0) *--at = '-';
    out.append(at, end);
}

/// Numbers of few decimals, which nearly all measurements are: the fewest digits d such that
/// n / 10^d, correctly rounded by the division, is x. False where there are none.
template <class Same>
bool append_short(std::string& out, double x, Same same) {
    if (!(std::fabs(x) < 1e9) || (x == 0 && std::signbit(x))) return false;
    for (unsigned d = 0; d <= most_short; ++d) {
        const double scaled = x * powers[d];
        const auto n = static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
        if (!same(static_cast<double>(n) / powers[d])) continue;
        append_scaled(out, n, d);
        return true;
    }
    return false;
}

}  // namespace

void append_integer(std::string& out, std::int64_t x) {
    const fmt::format_int text(x);
    out.append(text.data(), text.size());
}

void append_integer(std::string& out, std::uint64_t x) {
    const fmt::format_int text(x);
    out.append(text.data(), text.size());
}

void append_double(std::string& out, double x) {
    if (append_short(out, x, [x](double y) { return y == x; })) return;
    fmt::format_to(std::back_inserter(out), "{}", x);
}

void append_float(std::string& out, float x) {
    if (append_short(out, static_cast<double>(x),
                     [x](double y) { return static_cast<float>(y) == x; }))
        return;
    fmt::format_to(std::back_inserter(out), "{}", x);
}

void append_fixed(std::string& out, double x, unsigned decimals) {
    const double scaled = x * powers[decimals];
    if (!(std::fabs(scaled) < 0x1p53)) return append_double(out, x);
    append_scaled(out, static_cast<std::int64_t>(scaled < 0 ? scaled - 0.5 : scaled + 0.5),
                  decimals);
}

}  // namespace seautils::schema
