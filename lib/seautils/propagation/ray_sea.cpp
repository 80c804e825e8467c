#include "seautils/propagation/ray_sea.hpp"

#include "seautils/propagation/absorption.hpp"
#include "seautils/propagation/ray_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seautils::propagation {
namespace {

constexpr double db_per_km_of_neper_per_m = 8685.889638;
/// A strip is so narrow that its gradient over depth differs from that of the mesh by no more than
/// 0.02 m/s a layer.
constexpr double strip_error_mps = 0.02;
constexpr double most_strips = 2000;

std::size_t piece_at(const std::vector<double>& edges, double x) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
}

/// Speeds at edges: what both a profile and a mesh are made into.
struct Table {
    std::vector<double> range_m, depth_m, speed_mps;  ///< [depth][range]
    double at(std::size_t depth, std::size_t range) const {
        return speed_mps[depth * range_m.size() + range];
    }
};

Table table_of(const WaterColumn& water, std::vector<std::string>& remarks) {
    Table table;
    if (water.mesh) return {water.mesh->range_m, water.mesh->depth_m, water.mesh->sound_speed_mps};
    table.range_m = {0};
    for (const auto& point : linear_profile(water.profile, water.interpolation, remarks)) {
        table.depth_m.push_back(point.depth_m);
        table.speed_mps.push_back(point.sound_speed_mps);
    }
    return table;
}

/// Linear in depth, then in range; constant beyond the ends.
double speed_at(const Table& table, double range_m, double depth_m) {
    const auto place = [](const std::vector<double>& edges, double x) {
        if (edges.size() == 1 || x <= edges.front()) return std::pair<std::size_t, double>{0, 0};
        std::size_t k = piece_at(edges, x);
        k = std::min(k, edges.size() - 2);
        return std::pair{k, std::min(1., (x - edges[k]) / (edges[k + 1] - edges[k]))};
    };
    const auto [i, down] = place(table.depth_m, depth_m);
    const auto [j, along] = place(table.range_m, range_m);
    const auto row = [&, j = j, along = along](std::size_t depth) {
        const double from = table.at(depth, j);
        return along == 0 ? from : from + (table.at(depth, j + 1) - from) * along;
    };
    const double above = row(i);
    return down == 0 ? above : above + (row(i + 1) - above) * down;
}

/// The greatest |c_rz|·Δz·Δr of the mesh between two of its ranges.
double twist_of(const Table& table, std::size_t j) {
    double most = 0;
    for (std::size_t i = 0; i + 1 < table.depth_m.size(); ++i)
        most = std::max(most, std::abs(table.at(i + 1, j + 1) - table.at(i + 1, j) -
                                       table.at(i, j + 1) + table.at(i, j)));
    return most;
}

std::vector<double> strip_edges(const Table& table, double end_m) {
    std::vector<double> edges{-far_m};
    const double fair_share = most_strips / static_cast<double>(table.range_m.size());
    for (std::size_t j = 0; table.range_m.size() > 1 && j < table.range_m.size(); ++j) {
        edges.push_back(table.range_m[j]);
        if (j + 1 == table.range_m.size()) break;
        const double from_m = table.range_m[j], width_m = table.range_m[j + 1] - from_m;
        const double parts = std::ceil(
            std::clamp(twist_of(table, j) / (2 * strip_error_mps), 1., std::max(1., fair_share)));
        for (double k = 1; k < parts; ++k) {
            const double edge = from_m + width_m * k / parts;
            if (edge > 0 && edge < end_m) edges.push_back(edge);
        }
    }
    edges.push_back(far_m);
    return edges;
}

std::vector<double> layer_edges(const Table& table, const Environment& environment,
                                const RaySea& sea) {
    std::vector<double> edges = table.depth_m;
    edges.push_back(environment.source.depth_m);
    if (sea.surface.level) edges.push_back(sea.surface.depth_m);
    if (sea.bottom.level) edges.push_back(sea.bottom.depth_m);
    edges.insert(edges.end(), {-far_m, far_m});
    std::sort(edges.begin(), edges.end());
    const auto same = [](double a, double b) { return b - a <= 1e-9 * (1 + std::abs(a)); };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    return edges;
}

/// Where a rectangle is measured from: its middle, or its only near edge.
double centre(double from, double to) {
    if (from <= -far_m) return to >= far_m ? 0 : to;
    return to >= far_m ? from : 0.5 * (from + to);
}

Cell cell_of(const Table& table, double r0, double r1, double z0, double z1) {
    Cell cell;
    cell.range_m = centre(r0, r1);
    cell.depth_m = centre(z0, z1);
    cell.speed_mps = speed_at(table, cell.range_m, cell.depth_m);
    const bool wide = r0 > -far_m && r1<far_m, high = z0> - far_m && z1 < far_m;
    const auto c = [&](double r, double z) { return speed_at(table, r, z); };
    if (wide) cell.range_gradient = (c(r1, cell.depth_m) - c(r0, cell.depth_m)) / (r1 - r0);
    if (high) cell.depth_gradient = (c(cell.range_m, z1) - c(cell.range_m, z0)) / (z1 - z0);
    if (wide && high)
        cell.twist = (c(r1, z1) - c(r1, z0) - c(r0, z1) + c(r0, z0)) / ((r1 - r0) * (z1 - z0));
    return cell;
}

void fill_cells(RaySea& sea, const Table& table) {
    const auto& strips = sea.strip_edge_m;
    const auto& layers = sea.layer_edge_m;
    sea.cell.reserve((strips.size() - 1) * (layers.size() - 1));
    for (std::size_t j = 0; j + 1 < strips.size(); ++j)
        for (std::size_t i = 0; i + 1 < layers.size(); ++i)
            sea.cell.push_back(cell_of(table, strips[j], strips[j + 1], layers[i], layers[i + 1]));
}

Facet straight(double r0, double z0, double r1, double z1) {
    Facet facet{r0, r1, z0, z1};
    const double length_m = std::hypot(r1 - r0, z1 - z0);
    facet.cosine = facet.cosine_from = facet.cosine_to = (r1 - r0) / length_m;
    facet.sine = facet.sine_from = facet.sine_to = (z1 - z0) / length_m;
    return facet;
}

/// Between curved points a facet has the mean direction of its neighbours at each end, and the
/// curvature that takes the one to the other.
void bend(std::vector<Facet>& facets) {
    const auto angle = [&](std::size_t k) { return std::atan2(facets[k].sine, facets[k].cosine); };
    for (std::size_t k = 1; k + 1 < facets.size(); ++k) {
        const double from = 0.5 * (angle(k - 1) + angle(k)), to = 0.5 * (angle(k) + angle(k + 1));
        auto& f = facets[k];
        f.cosine_from = std::cos(from);
        f.sine_from = std::sin(from);
        f.cosine_to = std::cos(to);
        f.sine_to = std::sin(to);
        const double length_m = (f.end_m - f.range_m) / f.cosine;
        f.curvature_from = f.curvature_to = (to - from) / length_m;
    }
    for (std::size_t k = 1; k < facets.size(); ++k) {
        const double mean = 0.5 * (facets[k - 1].curvature_to + facets[k].curvature_from);
        facets[k - 1].curvature_to = facets[k].curvature_from = mean;
    }
}

Wall wall_of(const Boundary& boundary, const std::optional<Line>& line, double depth_m) {
    Wall wall{boundary, true, depth_m, {}};
    if (!line) return wall;
    const auto& r = line->range_m;
    const auto& z = line->depth_m;
    wall.depth_m = z.front();
    wall.level = std::all_of(z.begin(), z.end(), [&](double d) { return d == z.front(); });
    if (wall.level) return wall;
    wall.facet.push_back(straight(-far_m, z.front(), r.front(), z.front()));
    for (std::size_t k = 0; k + 1 < r.size(); ++k)
        wall.facet.push_back(straight(r[k], z[k], r[k + 1], z[k + 1]));
    wall.facet.push_back(straight(r.back(), z.back(), far_m, z.back()));
    if (line->curved) bend(wall.facet);
    return wall;
}

}  // namespace

std::size_t Wall::facet_at(double range_m) const {
    const auto above = std::upper_bound(facet.begin() + 1, facet.end(), range_m,
                                        [](double r, const Facet& f) { return r < f.range_m; });
    return static_cast<std::size_t>(above - facet.begin()) - 1;
}

double Wall::depth_at(double range_m) const {
    if (level) return depth_m;
    const auto& f = facet[facet_at(range_m)];
    return f.depth_m + (range_m - f.range_m) / f.cosine * f.sine;
}

std::size_t RaySea::strip_at(double range_m) const { return piece_at(strip_edge_m, range_m); }

double reach_m(const Environment& environment) {
    const double last_m = environment.receivers.range_m.back();
    for (const double decade : {1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7})
        for (const double part : {1., 1.2, 1.5, 2., 2.5, 3., 4., 5., 6., 8.})
            if (last_m <= part * decade) return part * decade;
    return last_m;
}

RaySea make_ray_sea(const Environment& environment, std::vector<std::string>& remarks) {
    RaySea sea;
    sea.surface = wall_of(environment.surface, environment.surface_line, 0);
    sea.bottom = wall_of(environment.bottom, environment.bottom_line, environment.bottom_depth_m);
    sea.bottom.slices = slices_of(environment.bottom.layers,
                                  2 * std::numbers::pi * environment.frequency_hz, slices_of_rays);
    const Table table = table_of(environment.water, remarks);
    sea.strip_edge_m = strip_edges(table, reach_m(environment));
    sea.layer_edge_m = layer_edges(table, environment, sea);
    fill_cells(sea, table);
    sea.periodic = sea.surface.level && sea.bottom.level && sea.strip_edge_m.size() == 2;
    sea.frequency_hz = environment.frequency_hz;
    sea.density_gcm3 = environment.water.density_gcm3;
    sea.source_depth_m = environment.source.depth_m;
    sea.source_speed_mps = speed_at(table, 0, sea.source_depth_m);
    sea.absorption_np_per_m =
        absorption_db_per_km(environment.water.absorption, environment.frequency_hz) /
        db_per_km_of_neper_per_m;
    return sea;
}

}  // namespace seautils::propagation
