#include "seautils/position/packet_header.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/horizon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace seautils::position {

namespace {

constexpr unsigned start_zeros = 16;
constexpr unsigned start_bits = 43;
constexpr unsigned version_bits = 3;
constexpr unsigned checked_reference_bits = 2;
constexpr unsigned least_check_bits = 16;  ///< that such a reference takes

/// How many positions before the last one each length of an end can say.
constexpr std::uint32_t most_before_2 = 2, most_before_5 = 6;

unsigned width_of(std::uint64_t value) { return static_cast<unsigned>(std::bit_width(value)); }

/// Elias' gamma code of a number from 1.
void put_gamma(std::uint32_t value, entropy::BitString& out) {
    out.put(0, width_of(value) - 1);
    out.put(value, width_of(value));
}

std::uint32_t get_gamma(std::uint32_t most, entropy::BitReader& in) {
    unsigned more = 0;
    while (!in.get())
        if (++more >= width_of(most)) throw DataError("packet: a number is too large");
    const std::uint64_t value = std::uint64_t{1} << more | in.get(more);
    if (value > most) throw DataError("packet: a number is too large");
    return static_cast<std::uint32_t>(value);
}

void put_end(const PacketEnd& end, entropy::BitString& out) {
    if (end.bits == 2) return out.put(end.before, 2);
    out.put(3, 2);
    if (end.bits == 5) return out.put(end.before, 3);
    out.put(7, 3);
    out.put(end.before, 15);
}

PacketEnd get_end(entropy::BitReader& in) {
    const auto get = [&in](unsigned width) { return static_cast<std::uint32_t>(in.get(width)); };
    if (const std::uint32_t before = get(2); before <= most_before_2) return {2, before};
    if (const std::uint32_t before = get(3); before <= most_before_5) return {5, before};
    return {20, get(15)};
}

void put_body(const PacketHeader& header, entropy::BitString& out) {
    const bool says_full = header.is_newest_full && !header.is_start;
    const std::uint32_t zeros = (header.ahead - 1) >> header.habit.rest_bits;
    if (header.is_alone() && !says_full && zeros < header.habit.most_zeros()) {
        out.put(0, zeros);
        out.put(true);
        return out.put(header.ahead - 1, header.habit.rest_bits);
    }
    out.put(0, header.habit.most_zeros());
    const bool has_newest = header.is_alone() || header.kind == PacketKind::peek;
    out.put(1, !has_newest ? 1 : says_full ? 4 : header.is_alone() ? 2 : 3);
    if (has_newest) put_gamma(header.ahead, out);
    if (has_newest && says_full) out.put(!header.is_alone());
    if (!header.is_alone()) put_end(header.end, out);
}

/// What stands behind the zeros that nothing usual begins with.
void get_rare(PacketHeader& header, entropy::BitReader& in) {
    header.kind = PacketKind::window;
    header.ahead = 0;
    unsigned zeros = 0;
    while (!in.get())
        if (++zeros == 4) throw DataError("packet: of no kind that is known");
    if (zeros > 0) {
        header.ahead = get_gamma(most_ahead, in);
        header.is_newest_full = zeros == 3;
        const bool is_alone = zeros == 1 || (zeros == 3 && !in.get());
        header.kind = is_alone ? PacketKind::jump : PacketKind::peek;
    }
    if (header.kind != PacketKind::jump) header.end = get_end(in);
}

void get_body(PacketHeader& header, entropy::BitReader& in) {
    std::uint32_t zeros = 0;
    while (!in.get())
        if (++zeros == header.habit.most_zeros()) return get_rare(header, in);
    const std::uint64_t rest = in.get(header.habit.rest_bits);
    header.ahead = (zeros << header.habit.rest_bits) + static_cast<std::uint32_t>(rest) + 1;
    header.kind = header.ahead == 1 ? PacketKind::window : PacketKind::jump;
}

void get_start(PacketHeader& header, entropy::BitReader& in) {
    header.is_start = true;
    const std::uint64_t version = in.get(version_bits);
    if (version > packet_version) {
        throw DataError(fmt::format("packet of version {}, newer than this program's {}", version,
                                    packet_version));
    }
    header.start_ms = static_cast<std::int64_t>(in.get(start_bits));
}

}  // namespace

void put(const PacketHeader& header, entropy::BitString& out) {
    if (header.is_start) {
        out.put(0, start_zeros);
        out.put(packet_version, version_bits);
        out.put(static_cast<std::uint64_t>(header.start_ms), start_bits);
    } else {
        if (header.is_reference_sized) put_gamma(header.reference_bits, out);
        out.put(header.reference, header.reference_bits);
    }
    put_body(header, out);
}

std::size_t bits_of(const PacketHeader& header) {
    entropy::BitString bits;
    put(header, bits);
    return bits.size();
}

PacketEnd end_of(std::size_t front_bits, std::span<const std::size_t> ended) {
    for (PacketEnd end : {PacketEnd{2, 0}, PacketEnd{5, 0}, PacketEnd{20, 0}}) {
        const std::size_t front = front_bits + end.bits;
        const std::size_t bytes_before = (front + ended.back() + 7) / 8 - 1;
        for (std::size_t k = ended.size() - 1; k > 0 && front + ended[k - 1] > 8 * bytes_before;
             --k)
            ++end.before;
        const std::uint32_t most = end.bits == 2 ? most_before_2 : most_before_5;
        if (end.before <= most || end.bits == 20) return end;
    }
    return {};
}

std::optional<Reference> get_reference(entropy::BitReader& in, unsigned check_bits) {
    entropy::BitReader ahead = in;
    if (in.left() >= start_zeros && ahead.get(start_zeros) == 0) {
        in = ahead;
        return {};
    }
    Reference reference{checked_reference_bits};
    if (check_bits < least_check_bits) reference.bits = get_gamma(ack_bits, in);
    reference.low = static_cast<std::uint32_t>(in.get(reference.bits));
    return reference;
}

PacketHeader get_packet_header(entropy::BitReader& in, const std::optional<Reference>& reference,
                               const Habit& habit) {
    PacketHeader header;
    header.habit = habit;
    if (reference) {
        header.reference_bits = reference->bits;
        header.reference = reference->low;
    } else {
        get_start(header, in);
    }
    get_body(header, in);
    if (header.is_start)
        header.is_newest_full = header.is_alone() || header.kind == PacketKind::peek;
    return header;
}

}  // namespace seautils::position
