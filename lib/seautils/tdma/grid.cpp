#include "seautils/tdma/grid.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

namespace seautils::tdma {

Origin parse_origin(std::string_view text) {
    if (text == "epoch") return {};
    if (text == "midnight") return {Origin::Kind::midnight, 0};
    const std::int64_t time_ns = parse_utc_ns(text);
    if (time_ns > last_ns) throw DataError("time " + quote(text) + " is after July 2261");
    return {Origin::Kind::instant, time_ns};
}

Era era_of(const Origin& origin, std::int64_t time_ns) {
    if (origin.kind == Origin::Kind::instant)
        return {origin.instant_ns, std::numeric_limits<std::int64_t>::max()};
    const std::int64_t begin = time_ns / day_ns * day_ns;
    return {begin, begin + day_ns};
}

std::int64_t boundary_after(const Origin& origin, std::int64_t step_ns, std::int64_t time_ns) {
    const Era era = era_of(origin, time_ns);
    if (time_ns < era.begin_ns) return era.begin_ns;
    const std::int64_t n = (time_ns - era.begin_ns) / step_ns + 1;
    return std::min(era.begin_ns + n * step_ns, era.end_ns);
}

std::int64_t boundary_from(const Origin& origin, std::int64_t step_ns, std::int64_t time_ns) {
    return time_ns == 0 ? era_of(origin, 0).begin_ns : boundary_after(origin, step_ns, time_ns - 1);
}

std::int64_t parse_seconds_ns(std::string_view text) {
    const auto digits = [](std::string_view s) {
        return std::all_of(s.begin(), s.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::string_view whole = text.substr(0, point);
    const std::string_view part = point < text.size() ? text.substr(point + 1) : "0";
    const bool shaped = !whole.empty() && !part.empty() && whole.size() <= 10 && part.size() <= 9;
    if (!shaped || !digits(whole) || !digits(part))
        throw DataError(quote(text) + " is not a number of seconds with at most 9 decimals");
    std::string all{whole};
    all.append(part).append(9 - part.size(), '0');
    std::int64_t ns = 0;
    const auto [end, error] = std::from_chars(all.data(), all.data() + all.size(), ns);
    if (error != std::errc() || ns > second_ns * second_ns)
        throw DataError(quote(text) + " is more than 1000000000 s");
    return ns;
}

}  // namespace seautils::tdma
