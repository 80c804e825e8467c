#ifndef SEAUTILS_PROPAGATION_RAYS_HPP
#define SEAUTILS_PROPAGATION_RAYS_HPP

#include "seautils/propagation/field.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace seautils::propagation {

/// Loss by geometric beams around rays, in the conventions of the Acoustics Toolbox. The profile is
/// traced in at most 2000 layers of linear c, a mesh in at most as many strips of range; a ray ends
/// after 200,000 legs, or after less in a fan of more than 10,000; an automatic fan has at most
/// 100,000 beams. The basis remarks on what was cut. Each column is met where a ray crosses it;
/// rays end at range 0. The same bits whatever the number of threads.
/// @throws DataError  check() does
Field ray_field(const Environment& environment, const FieldOptions& options);

/// The same fields, one after another, to the same bits, whatever was computed before. Kept of the
/// last seas is what does not hang on the receivers: the sea in layers, the fan, and of each ray
/// the legs of its cycle, or where the sea depends on range where it passed the marks. Then rays
/// begin just before the first receiver; columns at ranges where they were before, at the same
/// depths, are not computed at all. A sea is known again when all numbers of it are the same;
/// rays are kept from its second field on.
/// Rays of coherent sums are traced from the source.
class RayFields {
public:
    /// @param legs  so many are kept, at 100 bytes; 0: nothing is
    explicit RayFields(std::size_t legs);
    ~RayFields();
    RayFields(const RayFields&) = delete;
    RayFields& operator=(const RayFields&) = delete;

    /// As ray_field().
    /// @param environment  check()ed
    Field field(const Environment& environment, const FieldOptions& options);

private:
    struct Kept;
    struct Work;
    Kept& kept(const Environment& environment, const FieldOptions& options);
    void add_pressures(Kept& known, const Environment& environment, const FieldOptions& options,
                       Field& field);
    void add_intensities(Kept& known, const Environment& environment, const FieldOptions& options,
                         Field& field);
    void drop();

    std::size_t most_legs_;
    std::vector<std::unique_ptr<Kept>> kept_;  ///< the last used is first
};

/// All paths from the source to each receiver, depth by depth, each refined to its own launch
/// angle: to 1e-7 rad, and its delay to 1e-9 s. Pairs of rays that lie closer than 4
/// millionths of the fan's spacing may be missed. None at range 0.
/// @throws DataError  check() does; finding them would take minutes
std::vector<ReceiverArrivals> ray_arrivals(const Environment& environment,
                                           const FieldOptions& options);

/// How a ray runs: points on it, closely enough for a picture.
struct RayPath {
    double launch_deg = 0;  ///< positive down
    std::vector<double> range_m, depth_m;
};

/// Rays at `count` launch angles, evenly over the fan, as far as the farthest receiver; each ends where
/// its boundaries have left less than options.least_amplitude, or after 20,000 points.
/// @param count  1 to 1000
/// @throws DataError  check() does
std::vector<RayPath> ray_paths(const Environment& environment, const FieldOptions& options,
                               std::size_t count);

}  // namespace seautils::propagation

#endif  // SEAUTILS_PROPAGATION_RAYS_HPP
