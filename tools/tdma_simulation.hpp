// tdma-slot --simulate and --subsets: what vehicles would do, and how long it would take them.
#ifndef SEAUTILS_TOOLS_TDMA_SIMULATION_HPP
#define SEAUTILS_TOOLS_TDMA_SIMULATION_HPP

#include "tdma_options.hpp"

namespace seautils::tools {

class TdmaSimulation {
public:
    TdmaSimulation(cli::Io& io, const TdmaOptions& options)
        : io_(io),
          options_(options),
          text_(io.format == "text"),
          slot_ns_(tdma::parse_seconds_ns(options.length)) {
        survey_.network = {options.excitation(), options.p_collide, io.seed};
        survey_.start = options.start;
        survey_.runs = options.runs;
        survey_.limit = options.limit;
    }

    void run() {
        if (io_.format == "delimited") usage("simulations are written as ndjson or text");
        if (options_.subsets == 0 && options_.draw > 0) usage("option --draw needs --subsets");
        tdma::Summary all;
        if (options_.subsets > 0)
            all = sets();
        else if (options_.runs == 1)
            all = time_line(tdma::parse_addresses(options_.simulate));
        else
            all = set(tdma::parse_addresses(options_.simulate));
        if (!text_)
            append_summary_json(all, io_.out.buffer());
        else if (all.runs > 1)
            append_summary_text(all, io_.out.buffer());
        io_.out.commit();
    }

private:
    /// One run, slot by slot, and two cycles more when all take turns again.
    tdma::Summary time_line(const std::vector<int>& addresses) {
        tdma::NetworkOptions network_options = survey_.network;
        network_options.seed = splitmix64(network_options.seed);
        tdma::Network shown(addresses, survey_.start, network_options);
        if (text_) append_head_text(shown, io_.out.buffer());
        tdma::Network network = shown;
        const tdma::Outcome outcome = tdma::run(network, survey_.limit);
        const std::uint64_t end =
            outcome.succeeded ? network.settled() + 2 * (addresses.size() + 1) : network.slot();
        while (shown.slot() < end) step(shown);
        if (text_) append_outcome_text(network, outcome, slot_ns_, io_.out.buffer());
        tdma::Summary summary;
        summary.add(outcome);
        return summary;
    }

    void step(tdma::Network& network) {
        std::vector<std::size_t> known;
        for (const tdma::Vehicle& vehicle : network.vehicles())
            known.push_back(vehicle.world.size());
        network.step();
        if (text_)
            append_step_text(network, known, slot_ns_, io_.out.buffer());
        else
            append_step_json(network, slot_ns_, io_.out.buffer());
        io_.out.commit();
    }

    tdma::Summary set(const std::vector<int>& addresses) {
        tdma::Summary summary;
        tdma::survey(addresses, survey_, summary);
        if (text_)
            append_set_text(addresses, summary, io_.out.buffer());
        else
            append_set_json(addresses, summary, io_.out.buffer());
        io_.out.commit();
        return summary;
    }

    tdma::Summary sets() {
        const auto [first, last] = tdma::parse_pool(options_.pool);
        try {
            const std::uint64_t count = tdma::count_subsets(options_.subsets, first, last);
            if (options_.draw > 0)
                return tdma::survey_drawn(options_.draw, options_.subsets, first, last, survey_);
            if (count > most_sets)
                usage(
                    fmt::format("{} sets are more than {} (--draw takes some)", count, most_sets));
        } catch (const DataError& e) {
            usage(std::string("option --subsets: ") + e.what());
        }
        tdma::Summary all;
        tdma::for_each_subset(options_.subsets, first, last,
                              [&](const std::vector<int>& addresses) {
                                  survey_.first_run = all.runs;
                                  all.add(set(addresses));
                              });
        return all;
    }

    static constexpr std::uint64_t most_sets = 10'000'000;

    cli::Io& io_;
    const TdmaOptions& options_;
    bool text_;
    std::int64_t slot_ns_;
    tdma::SurveyOptions survey_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TDMA_SIMULATION_HPP
