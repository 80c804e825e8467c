// Fixes as navigation logs hold them, and the samples made of them: each is in the area, after the one
// before by one interval or a start, and what is written of it reads back as the same cell.
#include "common.hpp"

#include "seautils/position/fix_reader.hpp"
#include "seautils/position/fix_writer.hpp"

using namespace seautils;

namespace {

position::Sampler::Options sampling() {
    position::Sampler::Options options;
    options.gap_ms = 100'000;
    position::set_area(options.grid, "x=-50000:50000,y=-50000:50000");
    return options;
}

position::FixReader::Options reading() {
    position::FixReader::Options options;
    options.first_is_datum = true;
    return options;
}

void same_again(const position::Sample& sample, const position::Grid& grid) {
    for (const auto form : {position::FixWriter::Form::csv, position::FixWriter::Form::ndjson}) {
        const position::FixWriter writer(form, grid, {});
        position::FixReader reader({});
        std::string head, line;
        writer.header(head);
        if (!head.empty()) reader.read(std::string_view(head).substr(0, head.size() - 1));
        writer.write(sample.time_ms, sample.cell, line);
        const auto fix = reader.read(std::string_view(line).substr(0, line.size() - 1));
        fuzz::require(fix && fix->time_us == sample.time_ms * 1000, "the time reads back");
        fuzz::require(position::cell_of(grid, fix->place) == sample.cell, "the cell reads back");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    const position::Sampler::Options options = sampling();
    position::FixReader reader(reading());
    position::Sampler sampler(options);
    std::int64_t last_ms = -1;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        at = end + 1;
        fuzz::context = line;
        fuzz::accepted([&] {
            const auto fix = reader.read(line);
            if (!fix) return;
            const auto& samples = sampler.add(*fix);
            fuzz::require(samples.size() <= 11, "few samples a fix");
            for (const position::Sample& sample : samples) {
                fuzz::require(position::in_area(options.grid, sample.cell), "in the area");
                fuzz::require(sample.starts || sample.time_ms == last_ms + 10'000, "evenly spaced");
                last_ms = sample.time_ms;
                same_again(sample, options.grid);
            }
        });
    }
    return 0;
}
