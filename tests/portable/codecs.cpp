// codecs - print a hash of all bits that each codec of a track, and the horizon, make of one random walk
//
// Built by several compilers and for several machines, it must say the same. It decodes too.
#include "seautils/position/codec.hpp"
#include "seautils/position/horizon.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <vector>

using namespace seautils;
using position::Cell;
using position::CodecOptions;

namespace {

/// Knuth's linear congruential generator of MMIX: the same on any machine.
class Random {
public:
    std::int32_t below(std::uint32_t end) {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return static_cast<std::int32_t>((state_ >> 33) % end);
    }

private:
    std::uint64_t state_ = 1;
};

/// Legs with turns, pauses, dives and leaps; it ends near the limits of a cell.
std::vector<Cell> random_walk(std::size_t count) {
    Random random;
    std::vector<Cell> walk;
    Cell at{-120, 80, -5};
    std::int32_t east = 12, north = 5, up = -1;
    for (std::size_t k = 0; k < count; ++k) {
        if (random.below(30) == 0) {
            east = random.below(31) - 15;
            north = random.below(31) - 15;
            up = random.below(5) - 2;
        }
        if (random.below(400) == 0) at.x += random.below(4000);
        if (k == count - count / 8) at = {position::cell_limit - 3000, -position::cell_limit, 0};
        const auto moved = [&](std::int32_t from, std::int32_t by) {
            return std::clamp(from + by + random.below(3) - 1, -position::cell_limit,
                              position::cell_limit);
        };
        at = {moved(at.x, east), moved(at.y, north), moved(at.z, up)};
        walk.push_back(at);
    }
    return walk;
}

/// FNV-1a of 64 bits.
class Hash {
public:
    void add(const std::string& bytes) {
        for (const char c : bytes)
            value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211U;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037U;
};

/// Sends a walk, a position or four to a packet. False: it was not decoded as it was.
bool run(const CodecOptions& options, const std::vector<Cell>& walk, Hash& hash) {
    const auto sender = position::make_codec(options);
    const auto receiver = sender->clone();
    sender->restart(walk[0]);
    receiver->restart(walk[0]);
    for (std::size_t at = 1; at < walk.size();) {
        if (!sender->can_encode(walk[at])) {
            sender->restart(walk[at]);
            receiver->restart(walk[at++]);
            continue;
        }
        entropy::BitString bits;
        if (at % 3 == 0) {
            sender->encode_alone(walk[at], bits);
            entropy::BitReader in(bits.bytes(), bits.size());
            if (receiver->decode_alone(in) != walk[at++]) return false;
        } else {
            entropy::Encoder out(bits);
            const std::size_t begin = at;
            while (at < walk.size() && at < begin + 4 && sender->can_encode(walk[at]))
                sender->encode(walk[at++], out);
            out.finish();
            entropy::BitReader reader(bits.bytes(), bits.size());
            entropy::Decoder in(reader);
            for (std::size_t k = begin; k < at; ++k) {
                if (receiver->decode(in) != walk[k]) return false;
            }
        }
        hash.add(bits.bytes());
    }
    hash.add(sender->save());
    return sender->save() == receiver->save();
}

/// Sends some positions of a walk, none of those between.
bool run_ahead(const std::vector<Cell>& walk, Hash& hash) {
    Random random;
    const auto sender = position::make_horizon(), receiver = sender->clone();
    sender->restart(walk[0]);
    receiver->restart(walk[0]);
    for (std::size_t at = 0;;) {
        const auto ahead = static_cast<std::uint32_t>(1 + random.below(12));
        if ((at += ahead) >= walk.size()) break;
        if (ahead > 1) {
            entropy::BitString bits;
            entropy::Encoder out(bits);
            sender->encode(ahead, walk[at], out);
            out.finish();
            entropy::BitReader reader(bits.bytes(), bits.size());
            entropy::Decoder in(reader);
            if (receiver->decode(ahead, in) != walk[at]) return false;
            hash.add(bits.bytes());
        }
        for (const auto& end : {sender.get(), receiver.get()}) {
            if (ahead == 1) end->learn(walk[at]);
            if (ahead > 1) end->learn_ahead(ahead, walk[at]);
        }
    }
    hash.add(sender->save());
    return sender->save() == receiver->save();
}

struct Named {
    const char* name;
    CodecOptions::Kind kind;
    CodecOptions::Model model;
    bool small = false;
};

constexpr Named codecs[] = {
    {"fixed uniform", CodecOptions::Kind::fixed, CodecOptions::Model::uniform},
    {"fixed gaussian", CodecOptions::Kind::fixed, CodecOptions::Model::gaussian},
    {"fixed adaptive", CodecOptions::Kind::fixed, CodecOptions::Model::adaptive},
    {"kalman uniform", CodecOptions::Kind::kalman, CodecOptions::Model::uniform},
    {"kalman gaussian", CodecOptions::Kind::kalman, CodecOptions::Model::gaussian},
    {"kalman adaptive", CodecOptions::Kind::kalman, CodecOptions::Model::adaptive},
    {"mix", CodecOptions::Kind::mix, CodecOptions::Model::adaptive},
    {"mix small", CodecOptions::Kind::mix, CodecOptions::Model::adaptive, true},
};

}  // namespace

int main() {
    const std::vector<Cell> walk = random_walk(500);
    Hash ahead;
    if (!run_ahead(walk, ahead)) {
        std::puts("ahead: not decoded as it was");
        return 1;
    }
    std::printf("ahead: %016llx\n", static_cast<unsigned long long>(ahead.value()));
    for (const Named& codec : codecs) {
        for (const std::int64_t interval_ms : {1'000, 10'000, 45'000}) {
            CodecOptions options;
            options.kind = codec.kind;
            options.model = codec.model;
            options.small = codec.small;
            options.interval_ms = interval_ms;
            Hash hash;
            if (!run(options, walk, hash)) {
                std::printf("%s: not decoded as it was\n", codec.name);
                return 1;
            }
            std::printf("%s, %lld ms: %016llx\n", codec.name, static_cast<long long>(interval_ms),
                        static_cast<unsigned long long>(hash.value()));
            if (codec.kind == CodecOptions::Kind::mix) break;  // it has no use for the interval
        }
    }
}
