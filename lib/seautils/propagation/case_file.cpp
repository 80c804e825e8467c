#include "seautils/propagation/case_file.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/propagation/json_fields.hpp"
#include "seautils/propagation/reflection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace seautils::propagation {

namespace {

using json_fields::json;
using json_fields::most_points;
using json_fields::Object;
using json_fields::Value;

/// The text as a tree, in which no field is given twice.
json parse(std::string_view text) {
    std::vector<std::set<std::string>> open;
    const auto callback = [&open](int, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start) open.emplace_back();
        if (event == json::parse_event_t::object_end) open.pop_back();
        if (event == json::parse_event_t::key && !open.back().insert(parsed).second)
            throw DataError("field " + quote(parsed.get<std::string>()) + " is given twice");
        return true;
    };
    try {
        return json::parse(text, callback);
    } catch (const json::parse_error& e) {
        const std::size_t at = std::min<std::size_t>(e.byte > 0 ? e.byte - 1 : 0, text.size());
        const std::string_view before = text.substr(0, at);
        const std::size_t line =
            1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
        throw DataError(fmt::format(
            "line {} column {}: this is no JSON ({})", line, at - (before.rfind('\n') + 1) + 1,
            quote(text.substr(at, text.substr(at, 20).find_first_of("\r\n")))));
    } catch (const json::out_of_range&) {
        throw DataError("a number is beyond the range of its type");
    }
}

class Reader {
public:
    explicit Reader(const json& tree) : tree_(tree) {}

    Case read() {
        Object root({tree_, ""}, result_.remarks);
        Environment& e = result_.environment;
        root.known({"name", "reference_run", "typical_run", "box", "analytic"});
        if (const auto title = root.get("title")) e.title = title->text();
        e.frequency_hz = root.need("frequency_hz").number();
        source(root.need("source"));
        e.receivers = receivers(root.need("receivers"), true);
        water(root.need("water"));
        surface(root.get("surface"));
        bottom(root.need("bottom"));
        fan(root.get("fan"));
        if (const auto wanted = root.get("arrivals")) result_.arrivals = receivers(*wanted, false);
        root.end();
        return std::move(result_);
    }

private:
    void source(const Value& value) {
        Object object(value, result_.remarks);
        Source& s = result_.environment.source;
        s.depth_m = object.need("depth_m").number();
        if (const auto type = object.get("type"))
            s.line = type->one_of<bool>({{"point", false}, {"line", true}});
        if (const auto pattern = object.get("beam_pattern_deg_db"))
            for (const auto& [angle, level] : pattern->rows<2>())
                s.pattern.push_back({angle, level});
        object.end();
    }

    /// {start, stop, count}, a list, or one number.
    std::vector<double> axis(const Value& value) {
        if (value.raw().is_array()) return value.numbers();
        if (value.raw().is_number()) return {value.number()};
        Object object(value, result_.remarks);
        const double start = object.need("start").number(), stop = object.need("stop").number();
        const std::uint64_t count = object.need("count").whole(1, most_points);
        object.end();
        std::vector<double> all(count, start);
        for (std::size_t k = 1; k < count; ++k)
            all[k] =
                start + (stop - start) * static_cast<double>(k) / static_cast<double>(count - 1);
        return all;
    }

    Receivers receivers(const Value& value, bool is_grid) {
        Object object(value, result_.remarks);
        Receivers r{axis(object.need("depth_m")), axis(object.need("range_m"))};
        if (const auto layout = object.get("layout"))
            r.pairs = layout->one_of<bool>({{"rectilinear", false}, {"irregular", true}});
        if (!is_grid) object.known({"beams", "engine"});
        object.end();
        return r;
    }

    void water(const Value& value) {
        Object object(value, result_.remarks);
        WaterColumn& w = result_.environment.water;
        bool bilinear = false;
        if (const auto how = object.get("ssp_interpolation")) {
            bilinear = how->raw() == "bilinear-quad";
            if (!bilinear)
                w.interpolation =
                    how->one_of<SpeedInterpolation>({{"c-linear", SpeedInterpolation::c_linear},
                                                     {"n2-linear", SpeedInterpolation::n2_linear},
                                                     {"pchip", SpeedInterpolation::pchip},
                                                     {"spline", SpeedInterpolation::spline},
                                                     {"cubic-spline", SpeedInterpolation::spline},
                                                     {"bilinear-quad", {}}});
        }
        for (const auto& [depth, speed] : object.need("profile_z_c").rows<2>())
            w.profile.push_back({depth, speed});
        w.density_gcm3 = object.number("density_g_cm3", 1);
        if (const auto mesh = object.get("range_dependent")) speed_mesh(*mesh);
        if (bilinear && !w.mesh)
            throw DataError("water.range_dependent is not given, which 'bilinear-quad' needs");
        if (const auto how = object.get("absorption")) absorption(*how);
        object.end();
    }

    void speed_mesh(const Value& value) {
        Object object(value, result_.remarks);
        WaterColumn& w = result_.environment.water;
        SpeedMesh mesh;
        mesh.range_m = object.need("ranges_m").numbers();
        for (const SpeedPoint& point : w.profile) mesh.depth_m.push_back(point.depth_m);
        const Value rows = object.need("c_rows_by_depth");
        if (rows.length() != w.profile.size())
            rows.refuse(fmt::format("has {} rows where water.profile_z_c has {}", rows.length(),
                                    w.profile.size()));
        for (std::size_t k = 0; k < rows.length(); ++k) {
            const std::vector<double> row = rows[k].numbers();
            if (row.size() != mesh.range_m.size())
                rows[k].refuse(fmt::format("has {} elements where ranges_m has {}", row.size(),
                                           mesh.range_m.size()));
            mesh.sound_speed_mps.insert(mesh.sound_speed_mps.end(), row.begin(), row.end());
        }
        object.end();
        w.mesh = std::move(mesh);
    }

    void absorption(const Value& value) {
        Object object(value, result_.remarks);
        Absorption& a = result_.environment.water.absorption;
        a.model = object.need("model").one_of<AbsorptionModel>(
            {{"none", AbsorptionModel::none},
             {"thorp-jkps", AbsorptionModel::thorp},
             {"thorp", AbsorptionModel::thorp},
             {"francois-garrison", AbsorptionModel::francois_garrison},
             {"ainslie-mccolm", AbsorptionModel::ainslie_mccolm},
             {"fixed", AbsorptionModel::fixed}});
        a.temperature_c = object.number("temperature_c", a.temperature_c);
        a.salinity = object.number("salinity_psu", a.salinity);
        a.ph = object.number("ph", a.ph);
        a.depth_m = object.number("depth_m", a.depth_m);
        if (a.model == AbsorptionModel::fixed) a.db_per_km = object.need("db_per_km").number();
        object.end();
    }

    static Line line(Object& object) {
        Line l;
        if (const auto how = object.get("interp"))
            l.curved =
                how->one_of<bool>({{"L", false}, {"C", true}, {"linear", false}, {"curved", true}});
        for (const auto& [range, depth] : object.need("points").rows<2>()) {
            l.range_m.push_back(range);
            l.depth_m.push_back(depth);
        }
        object.end();
        return l;
    }

    std::optional<Line> line_of(const std::optional<Value>& value) {
        if (!value) return std::nullopt;
        Object object(*value, result_.remarks);
        return line(object);
    }

    static std::vector<ReflectionRow> table(const Value& value) {
        std::vector<ReflectionRow> rows;
        for (const auto& [grazing, magnitude, phase] : value.rows<3>())
            rows.push_back({grazing, magnitude, phase});
        return rows;
    }

    std::vector<SedimentLayer> layers(const Value& value) {
        const std::size_t n = value.length();
        if (n > Bounds::most_layers)
            value.refuse(fmt::format("has {} elements, more than {}", n, Bounds::most_layers));
        std::vector<SedimentLayer> all(n);
        for (std::size_t k = 0; k < n; ++k) all[k] = layer(value[k]);
        return all;
    }

    SedimentLayer layer(const Value& value) {
        Object object(value, result_.remarks);
        SedimentLayer l;
        l.thickness_m = object.need("thickness_m").number();
        if (const auto speed = object.get("sound_speed_m_s")) {
            l.sound_speed_top_mps = l.sound_speed_bottom_mps = speed->number();
            for (const char* key : {"sound_speed_top_m_s", "sound_speed_bottom_m_s"})
                if (const auto end = object.get(key))
                    end->refuse("is given beside sound_speed_m_s");
        } else {
            l.sound_speed_top_mps = object.need("sound_speed_top_m_s").number();
            l.sound_speed_bottom_mps = object.need("sound_speed_bottom_m_s").number();
        }
        const auto shear = object.get("shear_speed_m_s");
        if (shear && shear->number() != 0)
            shear->refuse(fmt::format("{} is not 0 m/s: layers are fluid", shear->number()));
        l.density_gcm3 = object.number("density_g_cm3", l.density_gcm3);
        l.attenuation_db_per_wavelength = object.number("attenuation_db_per_wavelength", 0);
        object.end();
        return l;
    }

    /// What a surface and a bottom have in common.
    void boundary(Object& object, Boundary& b, BoundaryKind otherwise) {
        b.kind = otherwise;
        if (const auto type = object.get("type"))
            b.kind = type->one_of<BoundaryKind>({{"pressure-release", BoundaryKind::vacuum},
                                                 {"vacuum", BoundaryKind::vacuum},
                                                 {"rigid", BoundaryKind::rigid},
                                                 {"fluid-halfspace", BoundaryKind::half_space},
                                                 {"elastic-halfspace", BoundaryKind::half_space},
                                                 {"halfspace", BoundaryKind::half_space},
                                                 {"grain-size", BoundaryKind::half_space},
                                                 {"reflection-table", BoundaryKind::table}});
        if (const auto phi = object.get("grain_size_phi")) return grain(*phi, object, b);
        const bool has_speed = b.kind == BoundaryKind::half_space;
        const auto number = [&](const char* key, double& x) {
            const auto value = object.get(key);
            if (value) x = value->number();
        };
        if (has_speed) b.sound_speed_mps = object.need("sound_speed_m_s").number();
        number("sound_speed_m_s", b.sound_speed_mps);
        number("shear_speed_m_s", b.shear_speed_mps);
        number("shear_sound_speed_m_s", b.shear_speed_mps);
        number("density_g_cm3", b.density_gcm3);
        number("attenuation_db_per_wavelength", b.attenuation_db_per_wavelength);
        number("shear_attenuation_db_per_wavelength", b.shear_attenuation_db_per_wavelength);
        number("roughness_m", b.roughness_m);
        const auto rows = object.get("table_deg_mag_phasedeg");
        if (b.kind == BoundaryKind::table)
            b.table = table(rows ? *rows : object.need("table_deg_mag_phasedeg"));
    }

    /// A sediment below the water that is known by then.
    void grain(const Value& phi, Object& object, Boundary& b) {
        const WaterColumn& w = result_.environment.water;
        if (b.kind != BoundaryKind::half_space || w.profile.empty())
            phi.refuse("is for a bottom of type 'grain-size', below a profile");
        const double roughness_m = object.number("roughness_m", 0);
        b = grain_half_space(phi.number(), w.profile.back().sound_speed_mps, w.density_gcm3);
        b.roughness_m = roughness_m;
    }

    void surface(const std::optional<Value>& value) {
        if (!value) return;
        Object object(*value, result_.remarks);
        boundary(object, result_.environment.surface, BoundaryKind::vacuum);
        result_.environment.surface_line = line_of(object.get("altimetry"));
        object.end();
    }

    void bottom(const Value& value) {
        Object object(value, result_.remarks);
        Environment& e = result_.environment;
        boundary(object, e.bottom, BoundaryKind::half_space);
        if (const auto above = object.get("layers")) e.bottom.layers = layers(*above);
        e.bottom_line = line_of(object.get("bathymetry"));
        const auto depth = object.get("depth_m");
        if (depth)
            e.bottom_depth_m = depth->number();
        else if (e.bottom_line && !e.bottom_line->depth_m.empty())
            e.bottom_depth_m =
                *std::max_element(e.bottom_line->depth_m.begin(), e.bottom_line->depth_m.end());
        else
            throw DataError("bottom.depth_m is not given");
        object.end();
    }

    void fan(const std::optional<Value>& value) {
        if (!value) return;
        Object object(*value, result_.remarks);
        Fan& f = result_.environment.fan;
        f.least_deg = object.need("min_deg").number();
        f.most_deg = object.need("max_deg").number();
        const auto sign = object.get("positive");
        if (sign && sign->one_of<bool>({{"down", false}, {"up", true}}))
            f = {-f.most_deg, -f.least_deg, 0};
        object.end();
    }

    const json& tree_;
    Case result_;
};

}  // namespace

Case read_case(std::string_view text) {
    const json tree = parse(text);
    return Reader(tree).read();
}

}  // namespace seautils::propagation
