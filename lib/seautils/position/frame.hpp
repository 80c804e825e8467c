#ifndef SEAUTILS_POSITION_FRAME_HPP
#define SEAUTILS_POSITION_FRAME_HPP

#include <string_view>

namespace seautils::position {

/// A place on WGS84.
struct Geographic {
    double latitude_deg = 0;   ///< north positive, -90 to 90
    double longitude_deg = 0;  ///< east positive, -180 to 180 (read: to 360)
};

/// `60.1,5.25`: latitude and longitude in degrees. @throws DataError
Geographic parse_datum(std::string_view text);

/// Metres east and north of a datum on the surface. Depth is no part of it: it stays what the
/// pressure says.
///
/// | kind  | x, y are | error |
/// |-------|----------|-------|
/// | local | the geodesic from the datum: its length in the direction in which it leaves (azimuthal equidistant) | distance and bearing from the datum are true; between two places s from it, lengths across the radius are too long by s^2/6R^2: 4e-7 at 10 km, 4e-5 at 100 km |
/// | utm   | UTM in the zone of the datum, less the datum's own easting and northing | scale 0.9996 to 1.001 in the zone; y is turned from north by up to 3 degrees at 60 degrees latitude |
///
/// Not a Cartesian tangent plane (x, y, z of the chord): there, x and y of a vehicle depend on its
/// depth (1.6 m at 10 km and 1000 m), and z of the surface on the distance (-7.8 m at 10 km). On
/// the surface both agree to s^3/6R^2: 4 mm at 10 km, 4 m at 100 km.
///
/// Forward and back agree within 10 nm (C. F. F. Karney, J. Geodesy 87, 43-55 (2013) and 85,
/// 475-485 (2011); GeographicLib).
/// Check values (Geoscience Australia, GDA technical manual 2.3, ch. 4 and 5): from Flinders Peak,
/// 37 57'03.72030"S 144 25'29.52440"E, Buninyong, 37 39'10.15610"S 143 55'35.38390"E, is 54972.271 m
/// away at 306 52'05.37"; in zone 55 it is 44887.245 m west and 31769.261 m north of it.
class Frame {
public:
    enum class Kind { local, utm };
    struct Metres {
        double x_m = 0, y_m = 0;
    };

    /// @throws DataError  the datum is no place; utm: its latitude is outside -80 to 84
    Frame(Kind kind, const Geographic& datum);

    /// @throws DataError  no place; utm: more than 30 degrees from the zone's middle
    Metres forward(const Geographic& place) const;
    /// The inverse. @param metres  within 4,200 km of the datum
    Geographic reverse(const Metres& metres) const;

    const Geographic& datum() const { return datum_; }

private:
    Kind kind_;
    Geographic datum_;
    double meridian_deg_ = 0;  ///< utm: the zone's middle
    Metres origin_;            ///< utm: the datum, from that meridian and the equator
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_FRAME_HPP
