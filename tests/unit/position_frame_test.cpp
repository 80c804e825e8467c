// Metres about a datum. Expected values: Geoscience Australia, GDA technical manual 2.3, chapters 4
// and 5 (GRS80, which is WGS84 to 0.1 mm here), as in the header.
#include "seautils/core/error.hpp"
#include "seautils/position/frame.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

namespace seautils::position {
namespace {

double dms(double degrees, double minutes, double seconds) {
    return degrees + minutes / 60 + seconds / 3600;
}

const Geographic flinders_peak{-dms(37, 57, 3.72030), dms(144, 25, 29.52440)};
const Geographic buninyong{-dms(37, 39, 10.15610), dms(143, 55, 35.38390)};

TEST(Frame, local_is_the_distance_and_the_bearing_of_the_geodesic) {
    const auto at = Frame(Frame::Kind::local, flinders_peak).forward(buninyong);
    EXPECT_NEAR(std::hypot(at.x_m, at.y_m), 54972.271, 0.0006);
    const double bearing_deg = std::atan2(at.x_m, at.y_m) * 180 / std::numbers::pi + 360;
    EXPECT_NEAR(bearing_deg, dms(306, 52, 5.37), 0.006 / 3600);
}

TEST(Frame, utm_is_the_difference_of_the_grid_coordinates) {
    const auto at = Frame(Frame::Kind::utm, flinders_peak).forward(buninyong);
    EXPECT_NEAR(at.x_m, 228854.052 - 273741.297, 0.0011);
    EXPECT_NEAR(at.y_m, 5828259.038 - 5796489.777, 0.0011);
}

TEST(Frame, utm_keeps_the_zone_of_the_datum_and_crosses_the_equator) {
    const Frame frame(Frame::Kind::utm, {0.01, 5.99});
    const auto south = frame.forward({-0.01, 5.99});
    EXPECT_NEAR(south.x_m, 0, 0.01);
    // A degree of the meridian at the equator is 110574.3 m (WGS84), the scale 0.9996 in the middle,
    // 1.00098 at the edge of the zone.
    EXPECT_NEAR(south.y_m, -0.02 * 110574.3 * 1.00098, 0.05);
    EXPECT_GT(frame.forward({0.01, 6.01}).x_m, 2000);
    EXPECT_NEAR(Frame(Frame::Kind::utm, {0, 179.99}).forward({0, -179.99}).x_m,
                0.02 * 111319.5 * 1.00098, 0.05);
}

TEST(Frame, the_datum_is_the_origin) {
    for (const auto kind : {Frame::Kind::local, Frame::Kind::utm}) {
        const auto at = Frame(kind, flinders_peak).forward(flinders_peak);
        EXPECT_EQ(at.x_m, 0);
        EXPECT_EQ(at.y_m, 0);
    }
}

TEST(Frame, back_is_the_inverse_of_forward) {
    EXPECT_TRUE(rc::check("reverse(forward(place)) is the place to 10 nm", [] {
        const auto between = [](int least, int most) {
            return *rc::gen::inRange(least, most) / 1e5;
        };
        const auto kind = *rc::gen::element(Frame::Kind::local, Frame::Kind::utm);
        const Geographic datum{between(-7'900'000, 8'300'000), between(-18'000'000, 18'000'000)};
        const Geographic place{datum.latitude_deg + between(-500'000, 500'000),
                               datum.longitude_deg + between(-1'000'000, 1'000'000)};
        RC_PRE(std::fabs(place.longitude_deg) <= 180);
        const Frame frame(kind, datum);
        const Geographic back = frame.reverse(frame.forward(place));
        // 10 nm are 9e-14 degrees of latitude; a double at 180 is good for 2.8e-14.
        RC_ASSERT(std::fabs(back.latitude_deg - place.latitude_deg) < 1.5e-13);
        const double wide = std::cos(place.latitude_deg * std::numbers::pi / 180);
        RC_ASSERT(std::fabs(std::remainder(back.longitude_deg - place.longitude_deg, 360.0)) *
                      wide <
                  1.5e-13);
    }));
}

std::string refusal(const char* text) {
    try {
        parse_datum(text);
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

TEST(Frame, a_datum_is_latitude_and_longitude) {
    EXPECT_EQ(parse_datum("-60.5, 5.25").latitude_deg, -60.5);
    EXPECT_EQ(parse_datum("-60.5, 5.25").longitude_deg, 5.25);
    EXPECT_EQ(refusal("60"), "'60' is not of the form 60.1,5.25");
    EXPECT_EQ(refusal("91,0"), "latitude_deg 91 is outside -90 to 90");
    EXPECT_EQ(refusal("9,361"), "longitude_deg 361 is outside -180 to 360");
    EXPECT_EQ(refusal("9,x"), "'x' is no number of degrees");
    EXPECT_EQ(refusal("nan,1"), "latitude_deg nan is outside -90 to 90");
}

TEST(Frame, utm_ends_where_it_is_not_defined) {
    EXPECT_THROW(Frame(Frame::Kind::utm, {84.5, 0}), DataError);
    EXPECT_THROW(Frame(Frame::Kind::utm, {0, 0}).forward({0, 40}), DataError);
    EXPECT_NO_THROW(Frame(Frame::Kind::local, {90, 0}).forward({89, 77}));
}

}  // namespace
}  // namespace seautils::position
