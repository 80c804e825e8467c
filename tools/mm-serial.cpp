// mm-serial - the dialogue with a WHOI Micro-Modem on a serial line
#include "mm_serial_session.hpp"

#include "seautils/modem/replay.hpp"

using namespace seautils;

namespace {

/// Lines of logs, or records of lines, as the records that they mean.
class MmReplay {
public:
    MmReplay(cli::Io& io, const tools::MmSerialOptions& options)
        : io_(io),
          records_(io),
          replay_(options.id == 0 ? std::nullopt : std::optional(options.id),
                  options.modem.sound_speed_mps, options.modem.raw) {}

    void run() {
        io_.for_each(records_.framing(), [this](std::string_view bytes) { take(bytes); });
        replay_.end(found_);
        give();
    }

private:
    void take(std::string_view bytes) {
        const bool is_record =
            records_.framing() == cli::Framing::delimited || bytes.starts_with('{');
        try {
            is_record ? record(bytes) : replay_.line(bytes, found_);
        } catch (const DataError&) {
            give();
            throw;
        }
        give();
    }

    void record(std::string_view bytes) {
        const record::Record& r = records_.read(bytes);
        if (const auto* raw = r.as<record::Raw>()) {
            const bool out = raw->direction == record::Raw::Direction::out;
            replay_.sentence(raw->line, out, r.time, found_);
        }
    }

    void give() {
        for (const record::Record& r : found_)
            records_.codec().write(r, records_.out_form(), io_.out.buffer());
        io_.out.commit();
        found_.clear();
    }

    cli::Io& io_;
    tools::RecordIo records_;
    modem::Replay replay_;
    std::vector<record::Record> found_;
};

void run(cli::Io& io, tools::MmSerialOptions& options) {
    options.settle();
    if (options.replay) return MmReplay(io, options).run();
    if (io.files.empty()) throw Error(ExitCode::usage, "DEVICE is required (try --help)");
    if (io.clock.is_input())
        throw Error(ExitCode::usage, "option --clock: a modem does not wait for records");
    const std::string device = io.files.front();
    io.files.erase(io.files.begin());
    tools::MmSerialSession(io, options, device).run();
}

}  // namespace

int main(int argc, char** argv) {
    tools::MmSerialOptions options;
    cli::App app{"mm-serial",
                 "Hold the dialogue with a WHOI Micro-Modem: DEVICE [FILE]..., or --replay FILE...",
                 "  queue-sched --id 3 | mm-serial --id 3 /dev/ttyS0 | dccl-decode -s nav.proto\n"
                 "  mm-serial --replay modem.log | jq .reception\n",
                 {.config = true, .clock = true}};
    app.input_formats(tools::record_formats);
    app.output_formats(tools::record_formats);
    options.add_to(app);
    return app.main(argc, argv, [&](cli::Io& io) { run(io, options); });
}
