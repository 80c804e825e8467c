// depth-plan link-stats: what a log of transmissions says about depths and losses.
#ifndef SEAUTILS_TOOLS_DEPTH_LINK_HPP
#define SEAUTILS_TOOLS_DEPTH_LINK_HPP

#include "depth_options.hpp"
#include "depth_schema.hpp"
#include "gnuplot.hpp"
#include "record_form.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/cli/io.hpp"
#include "seautils/plan/link_csv.hpp"
#include "seautils/plan/receipt.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/number_text.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::tools {

class LinkOptions {
public:
    plan::ReceiptOptions receipt;
    std::optional<double> least_depth_m, most_depth_m;
    double depth_step_m = 1;
    std::vector<plan::RangeWindow> bins;
    std::optional<plan::LossField> losses;
    Gnuplot::Target plot;

    void add(CLI::App& app) {
        app.add_option("--ranges", bins_, "A bin of ranges; may repeat (all)")
            ->allow_extra_args(false)
            ->option_text("FROM,TO");
        add_number(app, "--bandwidth", receipt.bandwidth_m, "Half width of the kernel (by the log)",
                   {0.001, 1e4, " m"}, "METRES");
        add_number(app, "--min-depth", least_depth_m, "Of the curve (the log's)", {0, 12000, " m"},
                   "METRES");
        add_number(app, "--max-depth", most_depth_m, "Of the curve (the log's)", {0, 12000, " m"},
                   "METRES");
        add_number(app, "--depth-step", depth_step_m, "Of the curve (1)", {0.01, 1e4, " m"},
                   "METRES");
        add_number(app, "--min-share", receipt.least_share,
                   "Say nothing where less was sent nearby (0.01)", {0, 1, ""}, "SHARE");
        app.add_option("--loss", loss_file_, "Losses where the log has none")->option_text("FILE");
        app.add_option("--plot", plot_file_, "Draw the curves: .png or .svg")->option_text("FILE");
    }
    void settle() {
        for (const std::string& bin : bins_) {
            const plan::DepthBand band = parse_band(bin, "--ranges");
            bins.push_back({band.from_m, band.to_m});
        }
        plot = Gnuplot::target(plot_file_);
        if (!loss_file_.empty()) losses = read_loss_file(loss_file_);
    }

private:
    std::vector<std::string> bins_;
    std::string loss_file_, plot_file_;
};

/// The receipt over depth of one bin of ranges.
struct ReceiptBin {
    std::optional<plan::RangeWindow> ranges;
    std::vector<plan::LinkSample> samples;
    double bandwidth_m = 0;
    std::vector<plan::ReceiptPoint> points;

    std::size_t received() const {
        return static_cast<std::size_t>(std::count_if(
            samples.begin(), samples.end(), [](const plan::LinkSample& s) { return s.received; }));
    }
    std::string title() const {
        return ranges ? fmt::format("{:g} to {:g} m", ranges->from_m, ranges->to_m) : "all ranges";
    }
};

class LinkSession {
public:
    LinkSession(cli::Io& io, const LinkOptions& options) : io_(io), options_(options) {}

    void run() {
        const std::vector<std::string> files =
            io_.files.empty() ? std::vector<std::string>{"-"} : io_.files;
        for (const std::string& file : files) {
            io_.files = {file};
            csv_ = {};
            io_.for_each(cli::Framing::lines, [this](std::string_view line) { take(line); });
        }
        if (samples_.empty()) return;
        std::vector<ReceiptBin> bins = make_bins();
        for (ReceiptBin& bin : bins) fill(bin);
        io_.format == "csv" ? write_table(bins) : write_records(bins);
        if (options_.plot.is_wanted()) Gnuplot::draw(options_.plot, script(bins));
    }

private:
    static constexpr std::size_t most_samples = 10'000'000, most_points = 20'000;

    void take(std::string_view line) {
        std::optional<plan::LinkSample> s;
        const std::size_t first = line.find_first_not_of(" \t");
        if (io_.input_format == "ndjson" ||
            (io_.input_format == "auto" && first != line.npos && line[first] == '{'))
            s = read_record(line);
        else
            s = csv_.read(line);
        if (!s) return;
        if (samples_.size() >= most_samples)
            throw DataError(fmt::format("more than {} transmissions", most_samples));
        if (std::isnan(s->loss_db) && options_.losses && !std::isnan(s->range_m)) {
            s->loss_db = plan::loss_at_db(*options_.losses, s->depth_m, s->range_m);
            if (std::isinf(s->loss_db)) s->loss_db = plan::not_known;
        }
        samples_.push_back(*s);
    }

    plan::LinkSample read_record(std::string_view line) {
        namespace f = field::link;
        reader_.read(line, schema_.link(), values_);
        const auto real = [this](std::uint32_t k) {
            return values_[k].present ? values_[k].d : plan::not_known;
        };
        plan::LinkSample s;
        if (!values_[f::depth_m].present) throw DataError("depth_m is not there");
        if (!values_[f::received].present) throw DataError("received is not there");
        s.depth_m = real(f::depth_m);
        s.range_m = real(f::range_m);
        s.loss_db = real(f::tl_db);
        s.received = values_[f::received].i != 0;
        if (values_[f::rate].present)
            s.rate = static_cast<std::int32_t>(std::min<std::uint64_t>(values_[f::rate].u, 1001));
        check(s);
        return s;
    }

    std::vector<ReceiptBin> make_bins() const {
        std::vector<ReceiptBin> bins;
        if (options_.bins.empty())
            bins.push_back({.ranges = {}, .samples = samples_, .points = {}});
        for (const plan::RangeWindow& window : options_.bins) {
            bins.push_back({.ranges = window, .samples = {}, .points = {}});
            for (const plan::LinkSample& s : samples_)
                if (s.range_m >= window.from_m && s.range_m < window.to_m)
                    bins.back().samples.push_back(s);
        }
        return bins;
    }

    void fill(ReceiptBin& bin) const {
        if (bin.samples.empty()) return;
        const auto [low, high] =
            std::minmax_element(bin.samples.begin(), bin.samples.end(),
                                [](const auto& a, const auto& b) { return a.depth_m < b.depth_m; });
        const double step = options_.depth_step_m;
        const double from = options_.least_depth_m.value_or(std::floor(low->depth_m / step) * step);
        const double to = options_.most_depth_m.value_or(std::ceil(high->depth_m / step) * step);
        if ((to - from) / step > static_cast<double>(most_points))
            throw Error(ExitCode::usage,
                        fmt::format("option --depth-step: more than {} depths", most_points));
        std::vector<double> depth_m;
        for (std::size_t k = 0; from + static_cast<double>(k) * step <= to + step * 1e-6; ++k)
            depth_m.push_back(from + static_cast<double>(k) * step);
        bin.bandwidth_m =
            options_.receipt.bandwidth_m.value_or(plan::default_bandwidth_m(bin.samples));
        bin.points = receipt_curve(bin.samples, depth_m, options_.receipt);
        std::erase_if(bin.points, [](const plan::ReceiptPoint& p) { return p.suppressed; });
    }

    void put(const schema::Values& values) {
        append_record(values, io_.format, io_.out.buffer());
        io_.out.commit();
    }

    void write_records(const std::vector<ReceiptBin>& bins) {
        for (const ReceiptBin& bin : bins) put(record(bin));
        write_summary(std::nullopt, samples_);
        std::map<std::int32_t, std::vector<plan::LinkSample>> by_rate;
        for (const plan::LinkSample& s : samples_)
            if (s.rate) by_rate[*s.rate].push_back(s);
        for (const auto& [rate, of_rate] : by_rate) write_summary(rate, of_rate);
    }

    schema::Values record(const ReceiptBin& bin) const {
        namespace f = field::curve;
        SlotWriter w(schema_.curve());
        if (bin.ranges) {
            w.real(f::range_from_m, bin.ranges->from_m, 1000);
            w.real(f::range_to_m, bin.ranges->to_m, 1000);
        }
        w.whole(f::samples, bin.samples.size());
        w.whole(f::received, bin.received());
        w.real(f::bandwidth_m, bin.bandwidth_m, 1000);
        const auto list = [&](std::uint32_t field, double plan::ReceiptPoint::*member) {
            std::vector<double> all;
            for (const plan::ReceiptPoint& p : bin.points) all.push_back(p.*member);
            w.reals(field, all, 1e6);
        };
        list(f::depth_m, &plan::ReceiptPoint::depth_m);
        list(f::probability, &plan::ReceiptPoint::probability);
        list(f::low, &plan::ReceiptPoint::low);
        list(f::high, &plan::ReceiptPoint::high);
        list(f::share, &plan::ReceiptPoint::share);
        return w.values();
    }

    void write_summary(std::optional<std::int32_t> rate,
                       const std::vector<plan::LinkSample>& samples) {
        namespace f = field::summary;
        const plan::LossStatistics s = plan::loss_statistics(samples);
        if (s.samples == 0) return;
        SlotWriter w(schema_.summary());
        if (rate) w.whole(f::rate, static_cast<std::uint64_t>(*rate));
        w.whole(f::samples, s.samples);
        w.whole(f::received, s.received);
        w.real(f::received_median_db, s.received_median_db, 1000);
        w.real(f::lost_median_db, s.lost_median_db, 1000);
        w.real(f::loss_limit_db, s.loss_limit_db, 1000);
        w.real(f::threshold_db, s.threshold_db, 1000);
        w.whole(f::threshold_errors, s.threshold_errors);
        put(w.values());
    }

    void write_table(const std::vector<ReceiptBin>& bins) {
        std::string& out = io_.out.buffer();
        out += "range_from_m,range_to_m,depth_m,probability,low,high,share\n";
        for (const ReceiptBin& bin : bins) {
            for (const plan::ReceiptPoint& p : bin.points) {
                if (bin.ranges) schema::append_double(out, bin.ranges->from_m);
                out += ',';
                if (bin.ranges) schema::append_double(out, bin.ranges->to_m);
                for (const double x : {p.depth_m, p.probability, p.low, p.high, p.share}) {
                    out += ',';
                    schema::append_double(out, rounded(x, 1e6));
                }
                out += '\n';
                io_.out.commit();
            }
        }
    }

    /// Probability to the right, depth down; the band as a filled curve.
    std::string script(const std::vector<ReceiptBin>& bins) const {
        std::string text = "set terminal " + options_.plot.terminal +
                           "\nset encoding utf8\nset grid\nset key bottom right\n"
                           "set xlabel 'probability of receipt'\nset ylabel 'depth, m'\n"
                           "set yrange [*:*] reverse\nset xrange [0:1]\n";
        std::string list;
        for (std::size_t k = 0; k < bins.size(); ++k) {
            if (bins[k].points.empty()) continue;
            text += fmt::format("$b{} << END\n", k);
            for (const plan::ReceiptPoint& p : bins[k].points)
                text += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}\n", p.depth_m, p.probability,
                                    p.low, p.high);
            text += "END\n";
            const std::string style = Gnuplot::style(k);
            for (const int column : {3, 4})
                list += fmt::format("{} $b{} using {}:1 with lines notitle {} lw 1",
                                    list.empty() ? "" : ",", k, column,
                                    style.substr(0, style.find(" dt")));
            list +=
                fmt::format(", $b{} using 2:1 with lines title '{}' {}", k, bins[k].title(), style);
        }
        return list.empty() ? text + "plot NaN notitle\n" : text + "plot" + list + "\n";
    }

    cli::Io& io_;
    const LinkOptions& options_;
    plan::LinkCsv csv_;
    DepthSchema schema_;
    schema::JsonReader reader_;
    schema::Values values_;
    std::vector<plan::LinkSample> samples_;
};

inline int link_stats_main(int argc, char** argv) {
    LinkOptions options;
    cli::App app{"depth-plan link-stats",
                 "Say how likely it was to be received at each depth, and up to which loss.",
                 "  depth-plan link-stats --ranges 0,500 --ranges 500,1000 log.csv\n",
                 {.config = true}};
    app.input_formats({"auto", "csv", "ndjson"});
    app.output_formats({"ndjson", "csv", "delimited"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        options.settle();
        LinkSession(io, options).run();
    });
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_DEPTH_LINK_HPP
