// depth-plan - the depth at which to hear and be heard
#include "depth_link.hpp"
#include "depth_session.hpp"

#include "seautils/cli/commands.hpp"

using namespace seautils;

int main(int argc, char** argv) {
    cli::Commands plan{"depth-plan", "Plan the depth at which to hear and be heard.",
                       "  depth-plan acomms --loss losses.csv --min-altitude 10 states.ndjson\n"
                       "  depth-plan link-stats log.csv\n"};
    plan.add("acomms", "Where a modem is heard best", tools::acomms_main);
    plan.add("snr", "Where signal over noise is best, and the way there", tools::snr_main);
    plan.add("link-stats", "What a log says of depths and losses", tools::link_stats_main);
    return plan.main(argc, argv);
}
