// Tables of losses, logs of a link, states of a vehicle: any text gives what can be planned with, or a decent refusal; and
// whatever was accepted, a decision obeys the limits.
#include "common.hpp"

#include "../../tools/depth_sea.hpp"
#include "../../tools/depth_state.hpp"
#include "seautils/plan/acomms_depth.hpp"
#include "seautils/plan/limits.hpp"
#include "seautils/plan/link_csv.hpp"
#include "seautils/plan/loss_csv.hpp"
#include "seautils/plan/max_snr_depth.hpp"
#include "seautils/plan/receipt.hpp"
#include "seautils/schema/json.hpp"

#include <algorithm>
#include <cmath>

namespace sp = seautils::plan;
namespace st = seautils::tools;

namespace {

const sp::Limits limits{.least_depth_m = 2,
                        .most_depth_m = 500,
                        .least_altitude_m = 5,
                        .excluded = {{20, 30}, {60, 61}}};

void check_depth(const std::optional<double>& depth_m, const sp::Situation& situation) {
    if (!depth_m) return;
    fuzz::require(forbidden_by(limits, situation, *depth_m).empty(), "limits are obeyed");
}

void plan_in(const sp::LossField& field, sp::RangeWindow window, const sp::Situation& situation) {
    const sp::AcommsCurve curve = acomms_curve({&field, 1}, window, {.loss_limit_db = {}});
    for (const double u : curve.objective.utility)
        fuzz::require(std::isnan(u) || (u >= 0 && u <= 1), "utility is 0 to 1");
    check_depth(choose_depth(curve.objective, limits, situation).depth_m, situation);
    const sp::SnrOptions options{.horizon_s = 600};
    const auto none = [](double) { return 0.0; };
    const auto forecast = forecast_snr({&field, 1}, window.from_m,
                                       (window.to_m - window.from_m) / 600, none, none, options);
    const sp::SnrDecision d = decide(forecast, limits, situation, 1.5, options);
    check_depth(d.depth_m, situation);
    fuzz::require(std::abs(d.pitch_deg) <= options.most_pitch_deg + 1e-9, "pitch is bounded");
}

template <class Line>
void for_each_line(std::string_view text, Line line) {
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        line(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

void read_losses(std::string_view text) {
    fuzz::accepted([&] {
        const sp::LossField field =
            text.starts_with('{') ? st::AnswerReader().read(text) : sp::read_loss_csv(text);
        for (const double r : {0.0, 150.0, 1e7})
            plan_in(field, {r, r + 200}, {.depth_m = 40, .water_depth_m = 100});
    });
    fuzz::accepted([&] { sp::read_depth_table(text); });
}

void read_link(std::string_view text) {
    sp::LinkCsv csv;
    std::vector<sp::LinkSample> samples;
    for_each_line(text, [&](std::string_view line) {
        fuzz::accepted([&] {
            if (const auto s = csv.read(line)) samples.push_back(*s);
        });
    });
    const std::vector<double> where{0, 10, 20, 50, 100, 12000};
    for (const sp::ReceiptPoint& p : receipt_curve(samples, where, {}))
        fuzz::require(p.suppressed || (p.low <= p.probability + 1e-9 &&
                                       p.probability <= p.high + 1e-9 && p.low >= 0 && p.high <= 1),
                      "the probability lies in its band");
    const sp::LossStatistics s = sp::loss_statistics(samples);
    fuzz::require(s.threshold_errors <= samples.size(), "errors are counted");
}

void read_states(std::string_view text) {
    static const st::DepthSchema schema;
    static const sp::LossField field{{10, 30, 60}, {100, 200}, {80, 82, 70, 72, 75, HUGE_VALF}};
    st::DepthKnown known;
    std::int64_t now_ns = 0;
    for_each_line(text, [&](std::string_view line) {
        seautils::schema::JsonReader json;
        seautils::schema::Values values;
        now_ns += (line.size() % 5 == 0 ? -1 : 1) * 30'000'000'000;
        fuzz::accepted([&] {
            json.read(line, schema.state(), values);
            known.merge(values, now_ns);
        });
        std::string why;
        const auto where = known.separation(now_ns, 600, why);
        fuzz::require(where || !why.empty(), "a reason is given");
        if (!where || !known.depth_m) return;
        fuzz::require(where->range_m >= 0 && std::isfinite(where->range_m), "a range is one");
        plan_in(field, sp::range_window(where->range_m, where->range_rate_mps, 120),
                {*known.depth_m, known.water_depth_m});
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text = fuzz::view(data + 1, size - 1);
    fuzz::context = text;
    switch (data[0] % 3) {
        case 0:
            read_losses(text);
            break;
        case 1:
            read_link(text);
            break;
        default:
            read_states(text);
    }
    return 0;
}
