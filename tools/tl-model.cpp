// tl-model - transmission loss and arrivals in the sea, from files and for requests
#include "tl_session.hpp"

using namespace seautils;

int main(int argc, char** argv) {
    tools::TlOptions options;
    cli::App app{
        "tl-model",
        "Compute transmission loss and arrivals between a source and receivers in the sea.",
        "  tl-model --format csv CASE.json\n",
        {.config = true}};
    app.input_formats({"auto", "case", "env", "ndjson", "delimited"});
    app.output_formats({"ndjson", "csv", "delimited", "shd", "arr", "arr-binary"});
    options.add(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        options.settle();
        tools::TlSession(io, options).run();
    });
}
