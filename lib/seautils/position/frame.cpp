#include "seautils/position/frame.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <GeographicLib/UTMUPS.hpp>

#include <charconv>
#include <cmath>

namespace seautils::position {

namespace {

namespace geo = GeographicLib;

constexpr double most_from_meridian_deg = 30;

void check(const Geographic& place) {
    const auto within = [](const char* name, double value, double least, double most) {
        if (value >= least && value <= most) return;
        throw DataError(fmt::format("{} {} is outside {} to {}", name, value, least, most));
    };
    within("latitude_deg", place.latitude_deg, -90, 90);
    within("longitude_deg", place.longitude_deg, -180, 360);
}

Frame::Metres mercator(double meridian_deg, const Geographic& place) {
    Frame::Metres at;
    geo::TransverseMercator::UTM().Forward(meridian_deg, place.latitude_deg, place.longitude_deg,
                                           at.x_m, at.y_m);
    return at;
}

double degrees(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size()) return value;
    throw DataError(quote(text) + " is no number of degrees");
}

}  // namespace

Geographic parse_datum(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == text.npos) throw DataError(quote(text) + " is not of the form 60.1,5.25");
    const Geographic place{degrees(text.substr(0, comma)), degrees(text.substr(comma + 1))};
    check(place);
    return place;
}

Frame::Frame(Kind kind, const Geographic& datum) : kind_(kind), datum_(datum) {
    check(datum);
    if (kind == Kind::local) return;
    const int zone = geo::UTMUPS::StandardZone(datum.latitude_deg, datum.longitude_deg);
    if (zone < geo::UTMUPS::MINUTMZONE)
        throw DataError(
            fmt::format("latitude_deg {} has no UTM: it is outside -80 to 84", datum.latitude_deg));
    meridian_deg_ = 6 * zone - 183;
    origin_ = mercator(meridian_deg_, datum);
}

Frame::Metres Frame::forward(const Geographic& place) const {
    check(place);
    if (kind_ == Kind::local) {
        Metres at;
        geo::AzimuthalEquidistant(geo::Geodesic::WGS84())
            .Forward(datum_.latitude_deg, datum_.longitude_deg, place.latitude_deg,
                     place.longitude_deg, at.x_m, at.y_m);
        return at;
    }
    const double from_deg = std::remainder(place.longitude_deg - meridian_deg_, 360.0);
    if (std::fabs(from_deg) > most_from_meridian_deg)
        throw DataError(
            fmt::format("longitude_deg {} is more than {} degrees from the middle of "
                        "the datum's zone, {}",
                        place.longitude_deg, most_from_meridian_deg, meridian_deg_));
    const Metres at = mercator(meridian_deg_, place);
    return {at.x_m - origin_.x_m, at.y_m - origin_.y_m};
}

Geographic Frame::reverse(const Metres& metres) const {
    Geographic place;
    if (kind_ == Kind::local)
        geo::AzimuthalEquidistant(geo::Geodesic::WGS84())
            .Reverse(datum_.latitude_deg, datum_.longitude_deg, metres.x_m, metres.y_m,
                     place.latitude_deg, place.longitude_deg);
    else
        geo::TransverseMercator::UTM().Reverse(meridian_deg_, origin_.x_m + metres.x_m,
                                               origin_.y_m + metres.y_m, place.latitude_deg,
                                               place.longitude_deg);
    return place;
}

}  // namespace seautils::position
