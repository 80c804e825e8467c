// What depth-plan knows of its vehicle and of the contact.
#ifndef SEAUTILS_TOOLS_DEPTH_STATE_HPP
#define SEAUTILS_TOOLS_DEPTH_STATE_HPP

#include "depth_schema.hpp"

#include "seautils/core/error.hpp"
#include "seautils/plan/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

namespace seautils::tools {

/// Where something was said to be, and how it moves.
struct Track {
    std::optional<double> x_m, y_m, latitude_deg, longitude_deg;
    double speed_mps = 0, heading_deg = 0;
    std::int64_t time_ns = 0;

    bool on_plane() const { return x_m && y_m; }
    bool on_earth() const { return latitude_deg && longitude_deg; }
};

class DepthKnown {
public:
    std::optional<double> depth_m, water_depth_m, contact_depth_m;
    double speed_mps() const { return own_.speed_mps; }

    /// Merges a DepthState. @throws DataError  a value is out of its bounds: nothing of it counts
    void merge(const schema::Values& values, std::int64_t time_ns) {
        DepthKnown next = *this;
        next.take(values, time_ns);
        *this = next;
    }

    /// Range to the contact and its rate at a time; else `why` there is none.
    std::optional<plan::Separation> separation(std::int64_t now_ns, double most_age_s,
                                               std::string& why) const {
        if (range_counts_) return by_range(now_ns, most_age_s, why);
        const bool plane = own_.on_plane() && contact_.on_plane();
        const bool earth = own_.on_earth() && contact_.on_earth();
        if (!plane && !earth) {
            why = "the range to the contact is not known";
            return std::nullopt;
        }
        const double old_s = std::max(age_s(own_.time_ns, now_ns), age_s(contact_.time_ns, now_ns));
        if (is_too_old(old_s, most_age_s, why)) return std::nullopt;
        return plan::separation(mover(own_, now_ns, plane), mover(contact_, now_ns, plane));
    }

private:
    /// The values of a block, checked.
    struct Block {
        const schema::Values& values;
        std::uint32_t first;
        const schema::Layout& layout;

        std::optional<double> number(std::uint32_t f, double least, double most,
                                     const char* unit) const {
            const schema::Slot& slot = values[first + f];
            if (!slot.present) return std::nullopt;
            if (slot.d >= least && slot.d <= most) return slot.d;
            throw DataError(fmt::format("{} {} is outside {} to {}{}", layout.fields[f].name,
                                        slot.d, least, most, unit));
        }
        std::optional<double> metres(std::uint32_t f, double most) const {
            return number(f, 0, most, " m");
        }
    };

    void take(const schema::Values& values, std::int64_t time_ns) {
        namespace s = field::state;
        const Block in{values, 0, values.layout()};
        if (const auto z = in.metres(s::depth_m, 12000)) depth_m = z;
        const auto altitude = in.metres(s::altitude_m, 12000);
        if (altitude && depth_m) water_depth_m = *depth_m + *altitude;
        if (const auto w = in.number(s::water_depth_m, 0.1, 12000, " m")) water_depth_m = w;
        const bool moved = take_track(in, {s::x_m, s::y_m, s::latitude_deg, s::longitude_deg},
                                      {s::speed_mps, s::heading_deg}, own_, time_ns);
        if (moved) range_counts_ = false;
        const schema::Slot& slot = values[s::contact];
        if (slot.present) take_contact(values, static_cast<std::uint32_t>(slot.u), time_ns);
        take_range(in, time_ns);
    }

    void take_contact(const schema::Values& values, std::uint32_t first, std::int64_t time_ns) {
        namespace c = field::contact;
        const Block in{values, first, *values.layout().fields[field::state::contact].message};
        if (const auto z = in.metres(c::depth_m, 12000)) contact_depth_m = z;
        if (take_track(in, {c::x_m, c::y_m, c::latitude_deg, c::longitude_deg},
                       {c::speed_mps, c::heading_deg}, contact_, time_ns))
            range_counts_ = false;
    }

    struct Place {
        std::uint32_t x, y, latitude, longitude;
    };
    struct Motion {
        std::uint32_t speed, heading;
    };
    /// @return whether it said a position
    static bool take_track(const Block& in, Place place, Motion motion, Track& track,
                           std::int64_t time_ns) {
        // what was before moves on with the motion of before
        if (const auto v = in.number(motion.speed, 0, 50, " m/s")) track.speed_mps = *v;
        if (const auto h = in.number(motion.heading, -360, 360, " degrees")) track.heading_deg = *h;
        const auto x = in.number(place.x, -1e7, 1e7, " m"), y = in.number(place.y, -1e7, 1e7, " m");
        const auto latitude = in.number(place.latitude, -90, 90, " degrees");
        const auto longitude = in.number(place.longitude, -360, 360, " degrees");
        if (x.has_value() != y.has_value()) throw DataError("x_m and y_m come together");
        if (latitude.has_value() != longitude.has_value())
            throw DataError("latitude_deg and longitude_deg come together");
        if (!x && !latitude) return false;
        track.x_m = x;
        track.y_m = y;
        track.latitude_deg = latitude;
        track.longitude_deg = longitude;
        track.time_ns = time_ns;
        return true;
    }

    void take_range(const Block& in, std::int64_t time_ns) {
        namespace s = field::state;
        const auto rate = in.number(s::range_rate_mps, -100, 100, " m/s");
        const auto bearing = in.number(s::bearing_deg, -360, 360, " degrees");
        const auto range = in.metres(s::range_m, 1e7);
        if (!range) return;
        const double since_s = age_s(range_ns_, time_ns);
        const bool again = range_counts_ && time_ns > range_ns_ && since_s >= 1 && since_s <= 600;
        if (rate)
            rate_mps_ = *rate;
        else if (bearing)  // the contact lies ahead where heading and bearing are the same
            rate_mps_ = plan::range_rate_mps(own_.speed_mps, own_.heading_deg - *bearing + 180);
        else
            rate_mps_ = again ? std::clamp((*range - range_m_) / since_s, -100.0, 100.0) : 0;
        range_m_ = *range;
        range_ns_ = time_ns;
        range_counts_ = true;
    }

    std::optional<plan::Separation> by_range(std::int64_t now_ns, double most_age_s,
                                             std::string& why) const {
        const double age = age_s(range_ns_, now_ns);
        if (is_too_old(age, most_age_s, why)) return std::nullopt;
        return plan::Separation{std::max(range_m_ + rate_mps_ * age, 0.0), rate_mps_};
    }

    static bool is_too_old(double age, double most_s, std::string& why) {
        if (age <= most_s) return false;
        why = fmt::format("where the contact is was said {:.0f} s ago, at most {:g} s count", age,
                          most_s);
        return true;
    }

    /// A clock that was stepped back makes nothing older.
    static double age_s(std::int64_t then_ns, std::int64_t now_ns) {
        return std::max(static_cast<double>(now_ns - then_ns) * 1e-9, 0.0);
    }

    plan::Mover mover(const Track& track, std::int64_t now_ns, bool plane) const {
        plan::Mover m{.speed_mps = track.speed_mps, .heading_deg = track.heading_deg};
        if (plane) {
            m.x_m = *track.x_m;
            m.y_m = *track.y_m;
        } else {
            const plan::PlanePoint p = plan::on_plane(*track.latitude_deg, *track.longitude_deg,
                                                      *own_.latitude_deg, *own_.longitude_deg);
            m.x_m = p.x_m;
            m.y_m = p.y_m;
        }
        return m.after(age_s(track.time_ns, now_ns));
    }

    Track own_, contact_;
    bool range_counts_ = false;  ///< else positions do
    double range_m_ = 0, rate_mps_ = 0;
    std::int64_t range_ns_ = 0;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_STATE_HPP
