// ssp - casts and live samples of a CTD to profiles of sound speed
#include "ssp_casts.hpp"

using namespace seautils;

int main(int argc, char** argv) {
    tools::SspOptions options;
    cli::App app{"ssp",
                 "Make profiles of sound speed from casts and live samples of a CTD.",
                 "  ssp --extend 200 cast.cnv\n",
                 {.config = true, .clock = true}};
    app.input_formats({"auto", "csv", "cnv", "ndjson", "delimited"});
    app.output_formats({"ndjson", "csv", "delimited"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        options.settle();
        tools::SspCasts(io, options).run();
    });
}
