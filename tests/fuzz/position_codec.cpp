// Each codec of a track: any bits of a packet, and any state, after a short walk was learnt.
// Input: a byte that chooses codec and way, then bits, or a state.
#include "common.hpp"

#include "seautils/position/codec.hpp"

#include <array>
#include <memory>
#include <optional>

using namespace seautils;

namespace {

constexpr std::size_t most_positions = 64;  // of one input

position::CodecOptions options_of(unsigned choice) {
    using Kind = position::CodecOptions::Kind;
    using Model = position::CodecOptions::Model;
    constexpr std::array kinds{Kind::mix, Kind::fixed, Kind::kalman};
    constexpr std::array models{Model::adaptive, Model::gaussian, Model::uniform};
    position::CodecOptions options;
    options.kind = kinds[choice % 3];
    options.model = models[choice / 3 % 3];
    options.small = true;
    if (choice / 9 % 2 == 1) options.plan = {{0, 0, 0}, {200, 0, -40}, {200, 300, -40}};
    return options;
}

std::unique_ptr<position::Codec> learnt(unsigned choice) {
    auto codec = position::make_codec(options_of(choice));
    for (std::int32_t k = 0; k < 12; ++k) {
        const position::Cell cell{k * 14 + k % 3, k * k / 4, -k};
        if (k > 0 && codec->can_encode(cell))
            codec->learn(cell);
        else
            codec->restart(cell);
    }
    return codec;
}

/// Positions until the bits end.
void decode(const position::Codec& from, std::string_view bytes, bool alone) {
    const auto codec = from.clone();
    entropy::BitReader in(bytes);
    entropy::Decoder coder(in);
    for (std::size_t k = 0; k < most_positions; ++k) {
        std::optional<position::Cell> cell;
        const bool is_whole =
            fuzz::accepted([&] { cell = alone ? codec->decode_alone(in) : codec->decode(coder); });
        if (!is_whole || !cell) return;
        fuzz::require(position::in_limits(*cell), "a position is within limits");
    }
}

/// A state is refused and changes nothing, or is taken and kept as it is.
void load(position::Codec& codec, std::string_view state) {
    const std::string before = codec.save();
    if (!fuzz::accepted([&] { codec.load(state); }))
        return fuzz::require(codec.save() == before, "what is refused changes nothing");
    const std::string taken = codec.save();
    const auto again = codec.clone();
    again->load(taken);
    fuzz::require(again->save() == taken, "a state is kept");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    const std::string_view rest = fuzz::view(data + 1, size - 1);
    const auto codec = learnt(data[0] % 18);
    if (data[0] >= 180) load(*codec, rest);
    decode(*codec, rest, data[0] / 18 % 2 == 1);
    return 0;
}
