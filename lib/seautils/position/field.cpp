#include "seautils/position/field.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <bit>

namespace seautils::position {

namespace {

constexpr unsigned first_width = 4;

/// The least n of a class, 0 and up.
constexpr std::size_t class_start(unsigned k) { return ((std::size_t{1} << k) - 1) << first_width; }
unsigned class_of(std::size_t n) {
    return static_cast<unsigned>(std::bit_width((n >> first_width) + 1)) - 1;
}
/// Bits of n itself.
std::size_t length_bits(std::size_t n) { return 2 * class_of(n) + 1 + first_width; }

std::size_t most_bits(std::size_t max_bytes, unsigned check_bits) {
    return 8 * max_bytes - check_bits;
}

std::size_t get_length(const std::function<bool()>& next, std::size_t most) {
    unsigned k = 0;
    while (next()) {
        if (++k > class_of(most)) throw DataError("is longer than its schema allows");
    }
    std::size_t n = 0;
    for (unsigned b = 0; b < first_width + k; ++b) n = 2 * n + (next() ? 1 : 0);
    n += class_start(k);
    if (n > most) throw DataError(fmt::format("has {} bits, more than {}", n, most));
    return n;
}

LinkOptions newest_only(LinkOptions link) {
    link.mode = LinkMode::newest;
    return link;
}

}  // namespace

std::size_t most_field_bits(std::size_t max_bytes, unsigned check_bits) {
    const std::size_t most = most_bits(max_bytes, check_bits);
    return length_bits(most) + most + check_bits;
}

void put_field(std::string_view packet, std::size_t bits, unsigned check_bits,
               entropy::BitString& out) {
    const unsigned k = class_of(bits);
    for (unsigned one = 0; one < k; ++one) out.put(true);
    out.put(false);
    out.put(bits - class_start(k), first_width + k);
    entropy::BitReader in(packet);
    for (std::size_t b = 0; b < bits; ++b) out.put(in.get());
    entropy::BitReader check(packet.substr(packet.size() - check_bits / 8));
    out.put(check.get(check_bits), check_bits);
}

std::string get_field(const std::function<bool()>& next, std::size_t max_bytes,
                      unsigned check_bits) {
    const std::size_t n = get_length(next, most_bits(max_bytes, check_bits));
    entropy::BitString packet;
    if (n == 0) return {};
    for (std::size_t b = 0; b < n; ++b) packet.put(next());
    while (packet.size() % 8 != 0) packet.put(false);
    for (unsigned b = 0; b < check_bits; ++b) packet.put(next());
    return packet.bytes();
}

FieldSender::FieldSender(LinkOptions link, const CodecOptions& codec)
    : check_bits_(link.check_bits),
      sender_(newest_only(link), *make_codec(codec), *make_horizon()) {}

void FieldSender::put(const Fix& fix, std::size_t max_bytes, entropy::BitString& out) {
    if (last_ != fix) sender_.sample(fix);
    last_ = fix;
    if (const auto packet = sender_.packet(max_bytes))
        put_field(packet->bytes, packet->bits, check_bits_, out);
    else
        out.put(0, least_field_bits);
}

Receiver make_field_receiver(const LinkOptions& link, const CodecOptions& codec) {
    return Receiver(newest_only(link), *make_codec(codec), *make_horizon());
}

}  // namespace seautils::position
