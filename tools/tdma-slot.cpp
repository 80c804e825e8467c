// tdma-slot - say whose turn it is to speak, when a turn begins
#include "tdma_live.hpp"
#include "tdma_simulation.hpp"

using namespace seautils;

namespace {

void schedule(cli::Io& io, const tools::TdmaOptions& options) {
    options.check_schedule();
    tools::TdmaWriter writer(io, options);
    tools::TdmaTurns turns(io, options);
    if (!options.from.empty()) return write_period(turns, writer, options);
    tools::TdmaLive(io, options, turns, writer).run();
}

}  // namespace

int main(int argc, char** argv) {
    tools::TdmaOptions tdma;
    cli::App app{"tdma-slot",
                 "Say whose turn it is to speak, when a turn begins.",
                 "  tdma-slot --id 3 --slot src=1,length=15 --slot src=3,length=15\n",
                 {.config = true, .clock = true, .seed = true}};
    app.input_formats(tools::record_formats);
    app.output_formats({"ndjson", "delimited", "text"});
    tdma.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        if (tdma.simulates()) return tools::TdmaSimulation(io, tdma).run();
        schedule(io, tdma);
    });
}
