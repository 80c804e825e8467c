#include "seautils/position/packet.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"
#include "seautils/position/hash.hpp"
#include "seautils/position/state_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace seautils::position {

namespace {

constexpr unsigned length_bits = 6;  // of a difference of times
constexpr std::uint32_t even = 1U << 15;

unsigned width_of(std::uint64_t value) { return static_cast<unsigned>(std::bit_width(value)); }

/// The bits as they are: what is coded first in a coder stands so in the packet. (Its 1 is the lower
/// half, which is a 0.)
void put_raw(std::uint64_t value, unsigned width, entropy::Encoder& out) {
    while (width > 0) out.bit((value >> --width & 1) == 0, even);
}

std::uint64_t get_raw(unsigned width, entropy::Decoder& in) {
    std::uint64_t value = 0;
    for (; width > 0; --width) value = value * 2 + (in.bit(even) ? 0 : 1);
    return value;
}

/// 0, -1, 1, -2, 2 … are 0, 1, 2, 3, 4 …
std::uint64_t zigzag(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    return value < 0 ? ~(bits << 1) : bits << 1;
}

std::int64_t unzigzag(std::uint64_t value) {
    const std::uint64_t bits = value >> 1;
    return static_cast<std::int64_t>((value & 1) != 0 ? ~bits : bits);
}

void put_axis(std::int32_t value, std::int32_t least, std::int32_t most, entropy::Encoder& out) {
    put_raw(static_cast<std::uint64_t>(value - least),
            width_of(static_cast<std::uint64_t>(most - least)), out);
}

std::int32_t get_axis(std::int32_t least, std::int32_t most, entropy::Decoder& in) {
    const auto size = static_cast<std::uint64_t>(most - least);
    const std::uint64_t value = get_raw(width_of(size), in);
    if (value > size) throw DataError("packet: a full fix is outside of the area");
    return static_cast<std::int32_t>(least + static_cast<std::int64_t>(value));
}

std::uint64_t check_of(std::string_view body, std::uint64_t seed, unsigned check_bits) {
    return check_bits == 0 ? 0 : hash(body, seed) >> (64 - check_bits);
}

std::string_view body_of(std::string_view bytes, unsigned check_bits) {
    if (bytes.size() <= check_bits / 8) throw DataError("packet is shorter than its check");
    return bytes.substr(0, bytes.size() - check_bits / 8);
}

}  // namespace

void put_full(const Fix& fix, std::int64_t expected_ms, const LinkOptions& options,
              entropy::Encoder& out) {
    const std::uint64_t late = zigzag(fix.time_ms - expected_ms);
    put_raw(width_of(late), length_bits, out);
    put_raw(late, width_of(late), out);
    put_axis(fix.cell.x, options.least.x, options.most.x, out);
    put_axis(fix.cell.y, options.least.y, options.most.y, out);
    put_axis(fix.cell.z, options.least.z, options.most.z, out);
}

Fix get_full(std::int64_t expected_ms, const LinkOptions& options, entropy::Decoder& in) {
    Fix fix;
    const std::int64_t late =
        unzigzag(get_raw(static_cast<unsigned>(get_raw(length_bits, in)), in));
    if (late < -most_time_ms || late > most_time_ms)
        throw DataError("packet: a time is out of its range");
    fix.time_ms = expected_ms + late;
    fix.cell.x = get_axis(options.least.x, options.most.x, in);
    fix.cell.y = get_axis(options.least.y, options.most.y, in);
    fix.cell.z = get_axis(options.least.z, options.most.z, in);
    return fix;
}

std::size_t least_bytes(const LinkOptions& options) {
    const Cell &a = options.least, &b = options.most;
    const auto axis = [](std::int32_t least, std::int32_t most) {
        return width_of(static_cast<std::uint64_t>(most - least));
    };
    // Of a start whose newest position is far ahead, alone. (One of many, which is marked as full, has
    // less of a header.)
    constexpr unsigned header = 16 + 3 + 43 + 3 + 29;
    constexpr unsigned time = length_bits + 43 + 2, ending = 2;
    const unsigned bits = header + time + ending + axis(a.x, b.x) + axis(a.y, b.y) + axis(a.z, b.z);
    return (bits + 7) / 8 + options.check_bits / 8;
}

std::string seal(const entropy::BitString& bits, std::uint64_t seed, unsigned check_bits) {
    std::string bytes = bits.bytes();
    const std::uint64_t check = check_of(bytes, seed, check_bits);
    for (unsigned left = check_bits; left > 0; left -= 8)
        bytes += static_cast<char>(check >> (left - 8) & 0xFF);
    return bytes;
}

std::optional<entropy::BitReader> unseal(std::string_view bytes, std::uint64_t seed,
                                         unsigned check_bits) {
    if (bytes.size() <= check_bits / 8) return {};
    const std::string_view body = body_of(bytes, check_bits);
    std::uint64_t check = 0;
    for (const char c : bytes.substr(body.size()))
        check = check << 8 | static_cast<unsigned char>(c);
    if (check != check_of(body, seed, check_bits)) return {};
    return entropy::BitReader(body);
}

entropy::BitReader unsealed(std::string_view bytes, unsigned check_bits) {
    return entropy::BitReader(body_of(bytes, check_bits));
}

std::string encode_ack(const Ack& ack, std::uint64_t seed, unsigned check_bits) {
    entropy::BitString bits;
    bits.put(ack.is_lost);
    bits.put(ack.number, ack_bits);
    return seal(bits, seed, check_bits);
}

Ack peek_ack(std::string_view bytes, unsigned check_bits) {
    if (bytes.size() != (1 + ack_bits + check_bits) / 8)
        throw DataError(fmt::format("acknowledgement has {} bytes, not {}", bytes.size(),
                                    (1 + ack_bits + check_bits) / 8));
    entropy::BitReader in = unsealed(bytes, check_bits);
    Ack ack;
    ack.is_lost = in.get();
    ack.number = static_cast<std::uint32_t>(in.get(ack_bits));
    return ack;
}

std::uint32_t digest(std::string_view packet) {
    return static_cast<std::uint32_t>(hash(packet, 0) >> (64 - ack_bits));
}

std::uint64_t agreed(const LinkOptions& options) {
    StateWriter all(packet_version);
    all.number(options.interval_ms);
    for (const Cell& corner : {options.least, options.most}) {
        all.number(corner.x);
        all.number(corner.y);
        all.number(corner.z);
    }
    all.number(options.check_bits);
    all.number(static_cast<std::int64_t>(options.agreed));
    return hash(all.finish(), 0);
}

void check(const LinkOptions& options) {
    const auto within = [](const char* what, std::uint64_t value, std::uint64_t least,
                           std::uint64_t most, const char* unit) {
        if (value < least || value > most)
            throw ConfigError(
                fmt::format("{} {} is outside {} to {} {}", what, value, least, most, unit));
    };
    if (options.interval_ms < 1 || options.interval_ms > 86'400'000)
        throw ConfigError(
            fmt::format("interval {} is outside 1 to 86400000 ms", options.interval_ms));
    const Cell &a = options.least, &b = options.most;
    if (!in_limits(a) || !in_limits(b) || a.x > b.x || a.y > b.y || a.z > b.z)
        throw ConfigError(
            fmt::format("area ({}, {}, {}) to ({}, {}, {}) is empty or beyond {} cells", a.x, a.y,
                        a.z, b.x, b.y, b.z, cell_limit));
    if (options.check_bits % 8 != 0) throw ConfigError("the check has 0, 8, 16, 24 or 32 bits");
    within("check", options.check_bits, 0, 32, "bits");
    within("pending", options.most_pending, 2, 32'000, "positions");
}

bool in_area(const Cell& cell, const LinkOptions& options) {
    const auto within = [](std::int32_t v, std::int32_t a, std::int32_t b) {
        return v >= a && v <= b;
    };
    return within(cell.x, options.least.x, options.most.x) &&
           within(cell.y, options.least.y, options.most.y) &&
           within(cell.z, options.least.z, options.most.z);
}

}  // namespace seautils::position
