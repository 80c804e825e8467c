#include "seautils/toolbox/companions.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/toolbox/list_directed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace seautils::toolbox {

namespace pg = propagation;

namespace {

constexpr std::int64_t most_rows = 2'000'000;

std::int64_t count_of(ListDirected& file, std::string_view what) {
    std::int64_t n = 0;
    file.read([&](ListDirected::Read& r) {
        if (!r.whole(n, what, 1, most_rows)) file.refuse(fmt::format("{} is not given", what));
    });
    return n;
}

/// A value that must be there.
double real_of(ListDirected& file, ListDirected::Read& r, std::string_view name) {
    double x = 0;
    if (!r.real(x, name)) file.refuse(fmt::format("{} is not given", name));
    return x;
}

}  // namespace

pg::Line read_boundary_file(std::string_view text, std::vector<std::string>& remarks) {
    ListDirected file(text);
    std::string type;
    file.read([&](ListDirected::Read& r) { r.text(type, "the type"); });
    if (type.empty() || (type[0] != 'L' && type[0] != 'C'))
        throw DataError(fmt::format("line 1: type {} is neither L nor C", quote(type)));
    if (type.size() > 1 && type[1] == 'L')
        remarks.emplace_back("the bottom's properties over range are left alone");
    pg::Line line;
    line.curved = type[0] == 'C';
    for (std::int64_t n = count_of(file, "the number of points"); n > 0; --n)
        file.read([&](ListDirected::Read& r) {
            line.range_m.push_back(metres(real_of(file, r, "range")));
            line.depth_m.push_back(real_of(file, r, "depth"));
        });
    return line;
}

pg::SpeedMesh read_ssp_file(std::string_view text, const std::vector<double>& depth_m) {
    ListDirected file(text);
    const std::int64_t n = count_of(file, "the number of profiles");
    pg::SpeedMesh mesh;
    mesh.depth_m = depth_m;
    file.read([&](ListDirected::Read& r) {
        for (std::int64_t k = 0; k < n; ++k)
            mesh.range_m.push_back(metres(real_of(file, r, "range")));
    });
    for (std::size_t z = 0; z < depth_m.size(); ++z)
        file.read([&](ListDirected::Read& r) {
            for (std::int64_t k = 0; k < n; ++k)
                mesh.sound_speed_mps.push_back(real_of(file, r, "sound speed"));
        });
    return mesh;
}

std::vector<pg::PatternPoint> read_sbp_file(std::string_view text) {
    ListDirected file(text);
    std::vector<pg::PatternPoint> pattern;
    for (std::int64_t n = count_of(file, "the number of angles"); n > 0; --n)
        file.read([&](ListDirected::Read& r) {
            const double angle_deg = real_of(file, r, "angle");
            pattern.push_back({angle_deg, real_of(file, r, "level")});
        });
    return pattern;
}

std::vector<pg::ReflectionRow> read_reflection_file(std::string_view text) {
    ListDirected file(text);
    std::vector<pg::ReflectionRow> rows;
    for (std::int64_t n = count_of(file, "the number of angles"); n > 0; --n)
        file.read([&](ListDirected::Read& r) {
            const double grazing_deg = real_of(file, r, "angle");
            const double magnitude = real_of(file, r, "magnitude");
            rows.push_back({grazing_deg, magnitude, real_of(file, r, "phase")});
        });
    return rows;
}

FieldFile read_flp_file(std::string_view text) {
    ListDirected file(text);
    FieldFile flp;
    std::string title, option;
    file.read([&](ListDirected::Read& r) { r.text(title, "the title"); });
    file.read([&](ListDirected::Read& r) { r.text(option, "the option"); });
    option.resize(std::max<std::size_t>(option.size(), 4), ' ');
    flp.line_source = option[0] == 'X';
    flp.coherent = option[3] != 'I';
    double modes = 0;
    file.read([&](ListDirected::Read& r) { r.real(modes, "the number of modes"); });
    if (file.vector("range of a profile", most_rows).size() > 1)
        throw DataError(
            fmt::format("line {}: modes over more than one profile are not read", file.line()));
    flp.range_m = file.vector_km("receiver range", most_rows);
    flp.source_depth_m = file.vector("source depth", most_rows);
    flp.receiver_depth_m = file.vector("receiver depth", most_rows);
    return flp;
}

}  // namespace seautils::toolbox
