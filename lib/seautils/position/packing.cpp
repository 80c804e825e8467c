#include "seautils/position/packing.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <bit>

namespace seautils::position {

void check(const Fix& fix, const LinkOptions& options) {
    if (fix.time_ms < 0 || fix.time_ms > most_time_ms)
        throw DataError(fmt::format("time {} ms is outside 0 to {} ms", fix.time_ms, most_time_ms));
    if (in_area(fix.cell, options)) return;
    throw DataError(
        fmt::format("position ({}, {}, {}) is outside of the area ({}, {}, {}) to ({}, {}, {})",
                    fix.cell.x, fix.cell.y, fix.cell.z, options.least.x, options.least.y,
                    options.least.z, options.most.x, options.most.y, options.most.z));
}

void set_reference(PacketHeader& header, const TrackState& known, std::uint64_t most,
                   const LinkOptions& options) {
    header.is_start = known.number() == 0;
    header.start_ms = known.start_ms();
    header.habit = known.habit();
    header.is_reference_sized = options.check_bits < 16;
    if (header.is_reference_sized)
        header.reference_bits = static_cast<unsigned>(std::bit_width(most));
    header.reference = static_cast<std::uint32_t>(
        known.number() & ((std::uint64_t{1} << header.reference_bits) - 1));
}

Packet packed(const PacketHeader& header, const entropy::BitString& bits, const TrackState& known,
              const Fix& newest, const LinkOptions& options) {
    Packet packet;
    const std::uint64_t seed = header.is_start ? agreed(options) : known.mark();
    packet.bytes = seal(bits, seed, options.check_bits);
    packet.kind = header.kind;
    packet.is_start = header.is_start;
    packet.positions = header.count + (header.kind == PacketKind::peek ? 1 : 0);
    packet.newest = newest;
    packet.header_bits = bits_of(header);
    packet.bits = bits.size();
    return packet;
}

void RunCoder::put_newest(const Step& newest) {
    state_.encode_peek(newest, coder_);
    note_end();
}

Step RunCoder::put(const Fix& fix) {
    bits_before_ = bits_;
    coder_before_ = coder_;
    const Step step = state_.step_to(fix, 1);
    state_.encode(step, coder_);
    note_end();
    return step;
}

void RunCoder::take_back() {
    bits_ = bits_before_;
    coder_ = coder_before_;
    ended_.pop_back();
}

std::size_t RunCoder::say_end(PacketHeader& header) const {
    header.end = {};
    header.end = end_of(bits_of(header) - header.end.bits, ended_);
    return bits_of(header) + ended_.back();
}

void RunCoder::finish(entropy::BitString& out) {
    coder_.finish();
    for (entropy::BitReader in(bits_.bytes(), bits_.size()); in.left() > 0;) out.put(in.get());
}

}  // namespace seautils::position
