// The messages of schemas/seautils/plan.proto, as depth-plan has them in memory.
#ifndef SEAUTILS_TOOLS_DEPTH_SCHEMA_HPP
#define SEAUTILS_TOOLS_DEPTH_SCHEMA_HPP

#include "message_table.hpp"

#include "seautils/schema/layout.hpp"
#include "seautils/schema/values.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

/// Fields in the order of their declaration.
namespace field {

namespace contact {
enum : std::uint32_t { x_m, y_m, latitude_deg, longitude_deg, depth_m, speed_mps, heading_deg };
}
namespace state {
enum : std::uint32_t {
    time,
    depth_m,
    speed_mps,
    heading_deg,
    x_m,
    y_m,
    latitude_deg,
    longitude_deg,
    water_depth_m,
    altitude_m,
    range_m,
    range_rate_mps,
    bearing_deg,
    contact,
};
}
namespace objective {
enum : std::uint32_t { time, name, weight, depth_m, utility };
}
namespace decision {
enum : std::uint32_t {
    time,
    depth_m,
    rule,
    reason,
    utility,
    range_m,
    range_rate_mps,
    window_from_m,
    window_to_m,
    tl_db,
    loss_limit_db,
    pitch_deg,
    ahead_s,
    free_depth_m,
    bound_by,
    stale,
    curve_depth_m,
    curve_utility,
};
}
namespace loss_answer {
enum : std::uint32_t { id, error, depth_m, range_m, tl_db };
}
namespace link {
enum : std::uint32_t { time, depth_m, range_m, tl_db, rate, received };
}
namespace curve {
enum : std::uint32_t {
    range_from_m,
    range_to_m,
    samples,
    received,
    bandwidth_m,
    depth_m,
    probability,
    low,
    high,
    share,
};
}
namespace summary {
enum : std::uint32_t {
    rate,
    samples,
    received,
    received_median_db,
    lost_median_db,
    loss_limit_db,
    threshold_db,
    threshold_errors,
};
}

}  // namespace field

/// The messages, so that no file has to be read; a test compares them with the file.
class DepthSchema : MessageTable {
public:
    DepthSchema() {
        const auto& stamp = add_message("google.protobuf.Timestamp",
                                        {{"seconds", Kind::int64}, {"nanos", Kind::int32}});
        add_states(stamp);
        add_decision(stamp);
        add_statistics(stamp);
        // what of seautils.TlAnswer is of interest here
        answer_ = &add_message("seautils.TlAnswer", {{"id", Kind::uint32},
                                                     {"error", Kind::string},
                                                     reals("depth_m"),
                                                     reals("range_m"),
                                                     {"tl_db", Kind::float32, true}});
    }

    const schema::Layout& state() const { return *state_; }
    const schema::Layout& objective() const { return *objective_; }
    const schema::Layout& decision() const { return *decision_; }
    const schema::Layout& answer() const { return *answer_; }
    const schema::Layout& link() const { return *link_; }
    const schema::Layout& curve() const { return *curve_; }
    const schema::Layout& summary() const { return *summary_; }

private:
    using Kind = schema::Kind;
    static Declared real(const char* name) { return {name, Kind::float64}; }
    static Declared reals(const char* name) { return {name, Kind::float64, true}; }
    static Declared whole(const char* name) { return {name, Kind::uint32}; }

    void add_states(const schema::Layout& stamp) {
        const auto& contact =
            add_message("seautils.DepthContact",
                        {real("x_m"), real("y_m"), real("latitude_deg"), real("longitude_deg"),
                         real("depth_m"), real("speed_mps"), real("heading_deg")});
        state_ = &add_message(
            "seautils.DepthState",
            {part("time", stamp), real("depth_m"), real("speed_mps"), real("heading_deg"),
             real("x_m"), real("y_m"), real("latitude_deg"), real("longitude_deg"),
             real("water_depth_m"), real("altitude_m"), real("range_m"), real("range_rate_mps"),
             real("bearing_deg"), part("contact", contact)});
        objective_ = &add_message("seautils.DepthObjective", {part("time", stamp),
                                                              {"name", Kind::string},
                                                              real("weight"),
                                                              reals("depth_m"),
                                                              reals("utility")});
    }

    void add_decision(const schema::Layout& stamp) {
        const auto& rule =
            add_enumeration("seautils.DepthDecision.Rule",
                            {"NONE", "BEST", "FOLLOW", "APPROACH", "STEEPEST", "LIMIT"});
        decision_ = &add_message("seautils.DepthDecision", {part("time", stamp),
                                                            real("depth_m"),
                                                            choice("rule", rule),
                                                            {"reason", Kind::string},
                                                            real("utility"),
                                                            real("range_m"),
                                                            real("range_rate_mps"),
                                                            real("window_from_m"),
                                                            real("window_to_m"),
                                                            real("tl_db"),
                                                            real("loss_limit_db"),
                                                            real("pitch_deg"),
                                                            real("ahead_s"),
                                                            real("free_depth_m"),
                                                            {"bound_by", Kind::string, true},
                                                            {"stale", Kind::boolean},
                                                            reals("curve_depth_m"),
                                                            reals("curve_utility")});
    }

    void add_statistics(const schema::Layout& stamp) {
        link_ = &add_message("seautils.LinkSample", {part("time", stamp),
                                                     real("depth_m"),
                                                     real("range_m"),
                                                     real("tl_db"),
                                                     whole("rate"),
                                                     {"received", Kind::boolean}});
        curve_ = &add_message("seautils.ReceiptCurve",
                              {real("range_from_m"), real("range_to_m"), whole("samples"),
                               whole("received"), real("bandwidth_m"), reals("depth_m"),
                               reals("probability"), reals("low"), reals("high"), reals("share")});
        summary_ =
            &add_message("seautils.LossSummary",
                         {whole("rate"), whole("samples"), whole("received"),
                          real("received_median_db"), real("lost_median_db"), real("loss_limit_db"),
                          real("threshold_db"), whole("threshold_errors")});
    }

    const schema::Layout *state_ = nullptr, *objective_ = nullptr, *decision_ = nullptr,
                         *answer_ = nullptr, *link_ = nullptr, *curve_ = nullptr,
                         *summary_ = nullptr;
};

/// The same value in the same few digits on every machine.
inline double rounded(double x, double per) { return std::round(x * per) / per + 0.0; }

/// Puts values into a message's slots; what is not known is left out.
class SlotWriter {
public:
    explicit SlotWriter(const schema::Layout& layout) { values_.reset(layout); }

    void real(std::uint32_t f, double x, double per) {
        if (std::isnan(x)) return;
        values_[f].d = std::isfinite(x) ? rounded(x, per) : x;
        values_[f].present = true;
    }
    void real(std::uint32_t f, const std::optional<double>& x, double per) {
        if (x) real(f, *x, per);
    }
    void whole(std::uint32_t f, std::uint64_t x) {
        values_[f].u = x;
        values_[f].present = true;
    }
    void text(std::uint32_t f, std::string_view x) { values_.set_text(f, x); }
    void add_text(std::uint32_t f, std::string_view x) {
        values_.set_text(values_.append_element(f), x);
    }
    void reals(std::uint32_t f, const std::vector<double>& x, double per) {
        if (x.empty()) return;
        const auto n = static_cast<std::uint32_t>(x.size());
        const std::uint32_t first = values_.add_elements(f, n);
        for (std::uint32_t k = 0; k < n; ++k) {
            values_[first + k].d = std::isfinite(x[k]) ? rounded(x[k], per) : x[k];
            values_[first + k].present = true;
        }
    }
    /// @param ns  since 1970; 0: not known
    void time(std::uint32_t f, std::int64_t ns) {
        if (ns <= 0) return;
        const std::uint32_t block = values_.add_block(f, *values_.layout().fields[f].message);
        if (ns / 1'000'000'000 != 0) whole(block, static_cast<std::uint64_t>(ns / 1'000'000'000));
        if (ns % 1'000'000'000 != 0)
            whole(block + 1, static_cast<std::uint64_t>(ns % 1'000'000'000));
    }
    const schema::Values& values() const { return values_; }

private:
    schema::Values values_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_SCHEMA_HPP
