// Samples and profiles as ssp reads and writes them: JSON, binary and CSV (schemas/seautils/acoustics.proto).
#ifndef SEAUTILS_TOOLS_SSP_RECORDS_HPP
#define SEAUTILS_TOOLS_SSP_RECORDS_HPP

#include "ssp_schema.hpp"

#include "seautils/acoustics/profile.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/number_text.hpp"
#include "seautils/schema/values.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace seautils::tools {

/// Slots into which a profile is put.
class ProfileWriter {
public:
    /// The profile as slots, until the next call. @param source  name of its file, or empty
    const schema::Values& put(const acoustics::Profile& p, const std::string& source) {
        values_.reset(schema_.profile());
        time(SspSchema::time, p.end_ns);
        time(SspSchema::start, p.start_ns);
        number(SspSchema::latitude_deg, p.latitude_deg, 1e-7);
        number(SspSchema::longitude_deg, p.longitude_deg, 1e-7);
        if (!source.empty()) values_.set_text(SspSchema::source, source);
        if (p.direction != acoustics::Direction::none)
            whole(values_[SspSchema::direction], static_cast<std::uint64_t>(p.direction));
        put_levels(p);
        if (p.formula) values_.set_text(SspSchema::formula, acoustics::name(*p.formula));
        whole(values_[SspSchema::samples], p.dropped[acoustics::Drop::none]);
        put_drops(p.dropped);
        number(SspSchema::measured_from_m, p.measured_from_m, 1e-3);
        number(SspSchema::measured_to_m, p.measured_to_m, 1e-3);
        if (p.extension != acoustics::Extension::none)
            whole(values_[SspSchema::extension], static_cast<std::uint64_t>(p.extension));
        put_remarks(p);
        return values_;
    }

    /// The same value in the same few digits on every machine.
    static double rounded(double x, double step) {
        const double per = std::round(1 / step);
        return std::round(x * per) / per + 0.0;  // no -0
    }

private:
    void put_levels(const acoustics::Profile& p) {
        using acoustics::Level;
        list(SspSchema::depth_m, p, [](const Level& l) { return rounded(l.depth_m, 1e-3); });
        list(SspSchema::sound_speed_mps, p,
             [](const Level& l) { return rounded(l.sound_speed_mps, 1e-3); });
        list(SspSchema::standard_deviation_mps, p,
             [](const Level& l) { return rounded(l.standard_deviation_mps, 1e-3); });
        list(SspSchema::count, p, [](const Level& l) { return l.count; });
        if (std::any_of(p.levels.begin(), p.levels.end(),
                        [](const Level& l) { return l.extrapolated; }))
            list(SspSchema::extrapolated, p,
                 [](const Level& l) { return std::uint64_t{l.extrapolated}; });
        where_known(SspSchema::temperature_c, p, &Level::temperature_c);
        where_known(SspSchema::salinity, p, &Level::salinity);
    }

    template <class Get>
    void list(std::uint32_t field, const acoustics::Profile& p, Get get) {
        if (p.levels.empty()) return;
        const std::uint32_t first =
            values_.add_elements(field, static_cast<std::uint32_t>(p.levels.size()));
        for (std::uint32_t k = 0; k < p.levels.size(); ++k) {
            if constexpr (std::is_same_v<decltype(get(p.levels[k])), double>)
                real(values_[first + k], get(p.levels[k]));
            else
                whole(values_[first + k], get(p.levels[k]));
        }
    }

    /// Extended levels repeat what is nearest; where a measured one does not know it, nobody does.
    void where_known(std::uint32_t field, const acoustics::Profile& p,
                     double acoustics::Level::*member) {
        double last = acoustics::not_available;
        for (const acoustics::Level& l : p.levels) {
            if (l.count > 0 && std::isnan(l.*member)) return;
            if (std::isnan(last)) last = l.*member;
        }
        if (std::isnan(last)) return;
        list(field, p, [&last, member](const acoustics::Level& l) {
            if (!std::isnan(l.*member)) last = l.*member;
            return rounded(last, 1e-4);
        });
    }

    void put_drops(const acoustics::DropCounts& dropped) {
        if (dropped.dropped() == 0) return;
        const std::uint32_t block = values_.add_block(
            SspSchema::dropped, *schema_.profile().fields[SspSchema::dropped].message);
        for (std::uint32_t k = 1; k < acoustics::drops; ++k)
            if (dropped.count[k] > 0) whole(values_[block + k - 1], dropped.count[k]);
    }

    void put_remarks(const acoustics::Profile& p) {
        const auto say = [&](bool holds, const char* what) {
            if (holds) values_.set_text(values_.append_element(SspSchema::remark), what);
        };
        say(p.latitude_assumed, "depths are of pressures at latitude 45, as none is known");
        say(p.salinity_assumed, "salinity is assumed in some samples");
        say(p.mixed, "sound speed is the sensor's own in some samples");
    }

    void time(std::uint32_t field, std::int64_t ns) {
        if (ns == acoustics::no_time) return;
        const std::uint32_t block =
            values_.add_block(field, *schema_.profile().fields[field].message);
        if (ns / 1'000'000'000 != 0)
            whole(values_[block], static_cast<std::uint64_t>(ns / 1'000'000'000));
        if (ns % 1'000'000'000 != 0)
            whole(values_[block + 1], static_cast<std::uint64_t>(ns % 1'000'000'000));
    }
    void number(std::uint32_t field, const std::optional<double>& x, double step) {
        if (x) real(values_[field], rounded(*x, step));
    }
    static void real(schema::Slot& slot, double x) {
        slot.d = x;
        slot.present = true;
    }
    static void whole(schema::Slot& slot, std::uint64_t x) {
        slot.u = x;
        slot.present = true;
    }

    SspSchema schema_;
    schema::Values values_;
};

/// A profile as rows of a table, which ssp itself reads again.
class ProfileCsv {
public:
    void write(const acoustics::Profile& p, std::string& out) {
        if (profiles_++ == 0)
            out +=
                "profile,time,depth_m,sound_speed_mps,standard_deviation_mps,count,"
                "temperature_c,salinity,extrapolated\n";
        const std::string time = p.end_ns == acoustics::no_time ? "" : format_utc_ns(p.end_ns);
        for (const acoustics::Level& l : p.levels) {
            schema::append_integer(out, profiles_);
            out.append(",").append(time);
            cell(out, l.depth_m, 1e-3);
            cell(out, l.sound_speed_mps, 1e-3);
            cell(out, l.standard_deviation_mps, 1e-3);
            out += ',';
            schema::append_integer(out, l.count);
            cell(out, l.temperature_c, 1e-4);
            cell(out, l.salinity, 1e-4);
            out += l.extrapolated ? ",1\n" : ",0\n";
        }
    }

private:
    static void cell(std::string& out, double x, double step) {
        out += ',';
        if (!std::isnan(x)) schema::append_double(out, ProfileWriter::rounded(x, step));
    }

    std::uint64_t profiles_ = 0;
};

/// Scans of samples and of whole profiles, in JSON or binary.
class SampleReader {
public:
    /// Calls `scan` for the sample, or for each level of a profile (a profile has a list of depths).
    /// @throws DataError
    template <class Scan>
    void read(std::string_view bytes, bool json, Scan scan) {
        if (json ? holds_profile(bytes) : false) return read_profile(bytes, scan);
        json ? json_.read(bytes, schema_.sample(), values_, schema::Unknown::skip)
             : schema::read_binary(bytes, schema_.sample(), values_);
        acoustics::Reading reading;
        if (values_[0].present) reading.time_ns = time_of(static_cast<std::uint32_t>(values_[0].u));
        for (std::uint32_t k = 1; k < acoustics::quantities; ++k)
            if (values_[k].present) reading.value[k] = values_[k].d;
        scan(reading);
    }

private:
    /// Whether the first `"depth_m"` is followed by a list.
    static bool holds_profile(std::string_view json) {
        constexpr std::string_view key = "\"depth_m\"";
        const std::size_t at = json.find(key);
        if (at == json.npos) return false;
        const std::size_t value = json.find_first_not_of(" \t:", at + key.size());
        return value != json.npos && json[value] == '[';
    }

    template <class Scan>
    void read_profile(std::string_view bytes, Scan scan) {
        json_.read(bytes, schema_.profile(), values_, schema::Unknown::skip);
        const schema::Slot depth = values_[SspSchema::depth_m],
                           speed = values_[SspSchema::sound_speed_mps];
        if (depth.aux != speed.aux)
            throw DataError("depth_m has " + counted(depth.aux, "value") + ", sound_speed_mps " +
                            std::to_string(speed.aux));
        acoustics::Reading reading;
        if (values_[SspSchema::time].present)
            reading.time_ns = time_of(static_cast<std::uint32_t>(values_[SspSchema::time].u));
        optional(reading, acoustics::Quantity::latitude_deg, SspSchema::latitude_deg);
        optional(reading, acoustics::Quantity::longitude_deg, SspSchema::longitude_deg);
        for (std::uint32_t k = 0; k < depth.aux; ++k) {
            reading[acoustics::Quantity::depth_m] =
                values_[static_cast<std::uint32_t>(depth.u) + k].d;
            reading[acoustics::Quantity::sound_speed_mps] =
                values_[static_cast<std::uint32_t>(speed.u) + k].d;
            scan(reading);
        }
    }

    void optional(acoustics::Reading& reading, acoustics::Quantity q, std::uint32_t field) const {
        if (values_[field].present) reading[q] = values_[field].d;
    }

    std::int64_t time_of(std::uint32_t block) const {
        const std::int64_t seconds = values_[block].i, nanos = values_[block + 1].i;
        if (seconds < 0 || seconds > 9'223'372'035 || nanos < 0 || nanos > 999'999'999)
            throw DataError("a time is outside the years 1970 to 2262");
        return seconds * 1'000'000'000 + nanos;
    }

    SspSchema schema_;
    schema::JsonReader json_;
    schema::Values values_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_SSP_RECORDS_HPP
