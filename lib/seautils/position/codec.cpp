#include "seautils/position/codec.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/mix_codec.hpp"
#include "seautils/position/thesis.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace seautils::position {

void Codec::encode_alone(const Cell& next, entropy::BitString& out) {
    entropy::Encoder coder(out);
    encode(next, coder);
    coder.finish();
}

std::optional<Cell> Codec::decode_alone(entropy::BitReader& in) {
    entropy::Decoder coder(in);
    return decode(coder);
}

void Codec::learn_ahead(std::uint32_t ahead, const Cell& from, const Cell& to) {
    restart(on_the_way(from, to, ahead - 1, ahead));
    if (can_encode(to))
        learn(to);
    else
        restart(to);
}

void Codec::encode_end(entropy::Encoder&) {
    throw std::logic_error("this codec has no code for the end");
}

namespace {

void check(const char* what, std::int64_t value, std::int64_t most, const char* unit) {
    if (value < 1 || value > most)
        throw ConfigError(fmt::format("{} {} is outside 1 to {} {}", what, value, most, unit));
}

}  // namespace

std::unique_ptr<Codec> make_codec(const CodecOptions& options) {
    check("interval", options.interval_ms, 86'400'000, "ms");
    check("speed", options.speed_mmps, 100'000, "mm/s");
    check("resolution", options.resolution_mm, 1'000'000, "mm");
    if (options.plan.size() > PlanModel::most_waypoints)
        throw ConfigError("plan has more than 65535 waypoints");
    for (const Cell& waypoint : options.plan)
        if (!in_limits(waypoint))
            throw ConfigError("plan has a waypoint beyond the limits of the grid");
    if (options.kind == CodecOptions::Kind::mix) return std::make_unique<MixCodec>(options);
    return std::make_unique<ThesisCodec>(options);
}

}  // namespace seautils::position
