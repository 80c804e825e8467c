// dccl-encode - pack messages into the few bytes of the Dynamic Compact Control Language
#include "dccl_options.hpp"
#include "dccl_position.hpp"
#include "dccl_records.hpp"

#include "seautils/core/text.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/stream/hex.hpp"

using namespace seautils;

namespace {

class Tool {
public:
    Tool(cli::Io& io, const tools::DcclOptions& options, const tools::MessageRecordOptions& records,
         tools::PositionTracks& positions)
        : io_(io), types_(options.load(io)), positions_(positions) {
        if (records.wanted()) records_.emplace(io, records);
        if (io.input_format != "ndjson" && types_.types()[0].legacy != nullptr) {
            throw Error(ExitCode::usage, "messages of DCCL 1 are read from ndjson only");
        }
        if (io.input_format == "delimited" && types_.usual() == nullptr) {
            throw Error(ExitCode::usage,
                        "delimited records do not say their type: choose it with -m");
        }
    }

    void record(std::string_view record) {
        const dccl::Type& type = read(record);
        types_.set_now(io_.now_us() / 1'000'000);
        bytes_.clear();
        positions_.hear();
        types_.encode(type, values_, bytes_);
        positions_.settle();
        const bool told = records_ || io_.format == "delimited";
        if (bytes_.empty() && !told)
            throw DataError("the message takes no bytes, which only delimited can hold");
        records_ ? records_->write(type, values_, bytes_) : write();
    }

private:
    /// Fills values_ and returns their type.
    const dccl::Type& read(std::string_view record) {
        if (io_.input_format == "ndjson") {
            const std::string name =
                record.find("\"@type\"") == record.npos ? std::string() : json_.type_of(record);
            const dccl::Type& type = named(name);
            json_.read(record, *type.layout, values_);
            return type;
        }
        std::string name;
        if (io_.input_format == "text" && record.starts_with('|')) {
            const std::size_t end = record.find('|', 1);
            if (end == record.npos) throw DataError("the type has no closing '|'");
            name = record.substr(1, end - 1);
            record.remove_prefix(end + 1);
        }
        const dccl::Type& type = named(name);
        if (io_.input_format == "text")
            schema::read_text(record, types_.pool(), *type.layout, values_);
        else
            schema::read_binary(record, *type.layout, values_);
        return type;
    }

    const dccl::Type& named(const std::string& name) const {
        if (!name.empty()) return types_.type(name);
        if (types_.usual() != nullptr) return *types_.usual();
        throw DataError("the record does not say its type (\"@type\", |TYPE|, or option -m)");
    }

    void write() {
        std::string& out = io_.out.buffer();
        if (io_.format == "hex")
            stream::append_hex(out, bytes_);
        else if (io_.format == "base64")
            append_base64(out, bytes_);
        else if (io_.format == "delimited")
            stream::append_delimited(out, bytes_);
        else
            out += bytes_;
        if (io_.format == "hex" || io_.format == "base64") out += '\n';
        io_.out.commit();
    }

    cli::Io& io_;
    dccl::TypeSet types_;
    tools::PositionTracks& positions_;
    schema::JsonReader json_;
    schema::Values values_;
    std::optional<tools::MessageRecordWriter> records_;
    std::string bytes_;
};

}  // namespace

int main(int argc, char** argv) {
    tools::DcclOptions dccl;
    tools::MessageRecordOptions records;
    tools::PositionOptions position;
    cli::App app{"dccl-encode",
                 "Pack messages into the few bytes of the Dynamic Compact Control Language.",
                 "  dccl-encode -s status.proto status.ndjson\n",
                 {.schema = true, .config = true, .time = true}};
    app.input_formats({"ndjson", "text", "delimited"});
    app.output_formats({"hex", "base64", "delimited", "raw", "ndjson"});
    dccl.add_type_options(app.options());
    dccl.add_frame_options(app.options());
    records.add(app.options());
    position.add(app.options(), "Acknowledgements of positions, from dccl-decode");
    return app.main(argc, argv, [&](cli::Io& io) {
        records.check();
        tools::settle_record_format(records.wanted(), app.options(), "--format", io.format);
        tools::PositionTracks positions(io, tools::PositionEnd::sender, position);
        dccl.field_codecs = tools::position_codecs(positions);
        Tool tool(io, dccl, records, positions);
        const auto framing =
            io.input_format == "delimited" ? cli::Framing::delimited : cli::Framing::lines;
        io.for_each(framing, [&](std::string_view record) { tool.record(record); });
    });
}
