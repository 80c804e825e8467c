// dccl-info - say what messages cost on the link, field by field, and what is wasteful in them
#include "dccl_options.hpp"
#include "dccl_position.hpp"

#include "seautils/dccl/survey.hpp"

using namespace seautils;

int main(int argc, char** argv) {
    tools::DcclOptions dccl;
    cli::App app{"dccl-info",
                 "Say what messages cost on the link, field by field, and what is wasteful.",
                 "  dccl-info -s status.proto\n",
                 {.schema = true, .config = true, .stream = false, .time = true}};
    app.output_formats({"text", "ndjson"});
    dccl.add_type_options(app.options());
    return app.main(argc, argv, [&](cli::Io& io) {
        dccl.keep_collisions = io.messages.empty();  // types that are named must load together
        tools::PositionTracks positions(io, tools::PositionEnd::none);
        dccl.field_codecs = tools::position_codecs(positions);
        const dccl::TypeSet types = dccl.load(io);
        for (const dccl::Survey& survey : dccl::survey(types, io.now_us() / 1'000'000)) {
            std::string& out = io.out.buffer();
            if (io.format == "text") {
                append_table(survey, out);
            } else {
                append_json(survey, out);
                out += '\n';
            }
            io.out.commit();
        }
    });
}
