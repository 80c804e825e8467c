// dccl-decode - unpack the bytes of the Dynamic Compact Control Language into messages
#include "dccl_options.hpp"
#include "dccl_position.hpp"
#include "dccl_records.hpp"

#include "seautils/core/text.hpp"
#include "seautils/dccl/raw_stream.hpp"
#include "seautils/schema/csv.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/stream/hex.hpp"

#include <optional>
#include <string>
#include <string_view>

using namespace seautils;

namespace {

class Tool {
public:
    Tool(cli::Io& io, const tools::DcclOptions& options,
         const tools::ReceptionRecordOptions& records, tools::PositionTracks& positions)
        : io_(io), options_(options), types_(options.load(io)), positions_(positions) {
        if (records.records) receptions_.emplace(io, records);
        const auto usage = [](const std::string& what) { throw Error(ExitCode::usage, what); };
        if ((io.format == "csv" || io.format == "delimited") && !types_.single())
            usage(io.format + " holds messages of one type: choose it with -m");
        if (io.format == "csv")
            csv_.emplace(*types_.types()[0].layout, dccl::repeats(types_.types()[0]));
        if (io.format != "ndjson" && io.format != "csv" && types_.types()[0].legacy != nullptr)
            usage("messages of DCCL 1 are written as ndjson or csv only");
        if (csv_) csv_->header(io.out.buffer());
    }

    /// A line or a delimited record: one frame, of one message or of several back to back.
    void record(std::string_view record) {
        if (receptions_)
            return receptions_->frames(record, [&](std::string_view bytes) { frame(bytes); });
        if (io_.input_format == "hex")
            stream::from_hex(record, bytes_);
        else if (io_.input_format == "base64")
            bytes_ = from_base64(record);
        else
            bytes_ = record;
        frame(bytes_);
    }

    /// One message or several back to back, and zeros that fill the frame up.
    void frame(std::string_view bytes) {
        if (options_.header_only)
            message(bytes);
        else
            dccl::decode_record(types_, bytes, decode_, options_.lenient);
    }

    /// Messages back to back, up to the first byte at which none begins; beyond it with --resync.
    void unframed(bool resync) {
        const auto refuse = [&](std::uint64_t offset, const std::string& what) {
            if (!resync) io_.stop_at(offset, what + " (--resync looks on for the next message)");
            io_.refuse_at(offset, what);
        };
        dccl::RawStream stream(types_, decode_, refuse);
        io_.for_each_block([&](std::string_view bytes, std::uint64_t offset, bool ended) {
            return stream.take(bytes, offset, ended);
        });
    }

private:
    /// Decodes the message that the bytes begin with, writes it, and returns how many it took.
    std::size_t message(std::string_view bytes) {
        // Times are near to the record's, or to the clock's.
        const bool logged = receptions_ && receptions_->time_ns() > 0;
        types_.set_now(logged ? receptions_->time_ns() / 1'000'000'000 : io_.now_us() / 1'000'000);
        positions_.set_src(receptions_ ? receptions_->src() : 0);
        const dccl::TypeSet::Decoded decoded = types_.decode(bytes, values_);
        positions_.settle();
        if (receptions_ && receptions_->is_again(bytes.substr(0, decoded.bytes)))
            return decoded.bytes;
        std::string& out = io_.out.buffer();
        if (io_.format == "ndjson") {
            const std::size_t start = out.size();
            schema::write_json(values_, out, types_.single() ? "" : decoded.type->name);
            if (receptions_) receptions_->add_received(out, start);
        } else if (io_.format == "text") {
            const std::size_t start = out.size();
            if (!types_.single()) out += "|" + decoded.type->name + "| ";
            schema::write_text(values_, out);
            // An empty line is no record: a message of which nothing is set shows its type.
            if (out.size() == start) out += "|" + decoded.type->name + "|";
        } else if (csv_) {
            csv_->row(values_, out);
        } else {
            binary_.clear();
            schema::write_binary(values_, binary_);
            stream::append_delimited(out, binary_);
        }
        if (io_.format == "ndjson" || io_.format == "text") out += '\n';
        io_.out.commit();
        return decoded.bytes;
    }

    cli::Io& io_;
    const tools::DcclOptions& options_;
    dccl::TypeSet types_;
    tools::PositionTracks& positions_;
    std::optional<schema::CsvWriter> csv_;
    std::optional<tools::ReceptionReader> receptions_;
    schema::Values values_;
    std::string bytes_, binary_;
    const dccl::RawStream::Decode decode_ = [this](std::string_view b) { return message(b); };
};

}  // namespace

int main(int argc, char** argv) {
    tools::DcclOptions dccl;
    tools::ReceptionRecordOptions records;
    tools::PositionOptions position;
    bool resync = false;
    cli::App app{"dccl-decode",
                 "Unpack the bytes of the Dynamic Compact Control Language into messages.",
                 "  dccl-decode -s status.proto status.hex\n",
                 {.schema = true, .config = true, .time = true}};
    app.input_formats({"hex", "base64", "delimited", "raw", "ndjson"});
    app.output_formats({"ndjson", "text", "delimited", "csv"});
    dccl.add_type_options(app.options());
    dccl.add_frame_options(app.options());
    app.options().add_flag("--full-time-resolution", dccl.full_time_resolution,
                           "Keep the digits of times that only option resolution states");
    app.options().add_flag("--resync", resync,
                           "raw: after bytes of no message, look on for the next");
    records.add(app.options());
    position.add(app.options(), "Write acknowledgements of positions, for dccl-encode");
    return app.main(argc, argv, [&](cli::Io& io) {
        records.check();
        tools::settle_record_format(records.records, app.options(), "--input-format",
                                    io.input_format);
        tools::PositionTracks positions(io, tools::PositionEnd::receiver, position);
        dccl.field_codecs = tools::position_codecs(positions);
        Tool tool(io, dccl, records, positions);
        if (io.input_format == "raw") return tool.unframed(resync);
        const auto framing =
            io.input_format == "delimited" ? cli::Framing::delimited : cli::Framing::lines;
        io.for_each(framing, [&](std::string_view record) { tool.record(record); });
    });
}
