// The thesis's codecs: laws for each observer and model, and the reference figures on whole tracks.
// Those lie outside of the tree, where SEAUTILS_SHARED says (default ../shared).
#include "position_tracks.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/thesis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::position {
namespace {

using Kind = CodecOptions::Kind;
using Model = CodecOptions::Model;
using nlohmann::json;

CodecOptions options_of(Kind kind, Model model) {
    CodecOptions options;
    options.kind = kind;
    options.model = model;
    return options;
}

std::vector<CodecOptions> all_options() {
    std::vector<CodecOptions> all;
    for (const Kind kind : {Kind::fixed, Kind::kalman}) {
        for (const Model model : {Model::uniform, Model::gaussian, Model::adaptive})
            all.push_back(options_of(kind, model));
    }
    return all;
}

std::string message_of(const std::function<void()>& what) {
    try {
        what();
    } catch (const DataError& e) {
        return e.what();
    }
    return "nothing thrown";
}

/// A codec that knows a vehicle at (0, 0, -10) which has gone 15 m east in the last 10 s.
ThesisCodec eastbound(Kind kind, Model model) {
    ThesisCodec codec(options_of(kind, model));
    codec.restart({0, 0, -10});
    codec.learn({15, 0, -10});
    return codec;
}

std::size_t bits_alone(Codec& codec, const Cell& next) {
    entropy::BitString bits;
    codec.encode_alone(next, bits);
    return bits.size();
}

TEST(Thesis, FixedObserverGoesOnAtItsSpeedAndHeading) {
    // 101 values reach 50 m from where it is expected: (30, 0, -10).
    ThesisCodec codec = eastbound(Kind::fixed, Model::uniform);
    EXPECT_TRUE(codec.can_encode({30 + 50, 50, -60}));
    EXPECT_TRUE(codec.can_encode({30 - 50, -50, 40}));
    EXPECT_FALSE(codec.can_encode({30 + 51, 0, -10}));
    EXPECT_FALSE(codec.can_encode({30 - 51, 0, -10}));
    EXPECT_FALSE(codec.can_encode({30, 51, -10}));
    EXPECT_FALSE(codec.can_encode({30, 0, -61}));
    // 30 east and 40 north are 3 and 4 of 5: it goes on by 9 and 12, and dives by 2 again.
    codec.learn({45, 40, -12});
    EXPECT_TRUE(codec.can_encode({54 + 50, 52 + 50, -14 + 50}));
    EXPECT_TRUE(codec.can_encode({54 - 50, 52 - 50, -14 - 50}));
    EXPECT_FALSE(codec.can_encode({54 + 51, 52, -14}));
    EXPECT_FALSE(codec.can_encode({54, 52 - 51, -14}));
    EXPECT_FALSE(codec.can_encode({54, 52, -14 - 51}));
}

TEST(Thesis, FixedObserverKeepsItsHeadingWhereItStoodStill) {
    ThesisCodec codec = eastbound(Kind::fixed, Model::uniform);
    codec.learn({15, 0, -10});
    EXPECT_TRUE(codec.can_encode({30 + 50, 0, -10}));
    EXPECT_FALSE(codec.can_encode({30 + 51, 0, -10}));
}

TEST(Thesis, AfterAFullFixAVehicleIsExpectedToStay) {
    for (const CodecOptions& options : all_options()) {
        const auto codec = make_codec(options);
        codec->restart({0, 0, 0});
        codec->learn({15, 0, -10});
        codec->restart({1000, 2000, -50});
        EXPECT_TRUE(codec->can_encode({1050, 1950, -100}));
        EXPECT_FALSE(codec->can_encode({1051, 2000, -50}));
        EXPECT_FALSE(codec->can_encode({1000, 1949, -50}));
        EXPECT_FALSE(codec->can_encode({1000, 2000, -101}));
    }
}

TEST(Thesis, KalmanObserverByHand) {
    // After a full fix P = diag(25, 225, 225) (m², a step of 10 s), and sigma_j² tau^4 = 10; one step
    // on xx = 25 + 225 + 225/4 + 10/4 = 308.75, xv = 225 + 225/2 + 10/2 = 342.5, xa = 225/2 + 10/2.
    // Gains 308.75, 342.5 and 117.5 of 333.75. A step of 40 m: x = 37.004, v = 41.049, a = 14.082;
    // the next one is expected at 37.004 + 41.049 + 7.041 = 85.094.
    ThesisCodec codec(options_of(Kind::kalman, Model::uniform));
    codec.restart({0, 0, 0});
    codec.learn({40, 0, 0});
    EXPECT_TRUE(codec.can_encode({85 + 50, 0, 0}));
    EXPECT_FALSE(codec.can_encode({85 + 51, 0, 0}));
    EXPECT_TRUE(codec.can_encode({85 - 50, 0, 0}));
    EXPECT_FALSE(codec.can_encode({85 - 51, 0, 0}));
}

TEST(Thesis, CostOfUniformIsThatOfItsSymbols) {
    // log2(103 * 102 * 102) = 20.03, and eq. 3.31 adds 1 or so: 21 or 22 bits.
    for (const Kind kind : {Kind::fixed, Kind::kalman}) {
        ThesisCodec codec = eastbound(kind, Model::uniform);
        for (int k = 2; k < 200; ++k) {
            const std::size_t bits = bits_alone(codec, {15 * k, k % 7, -10 - k % 5});
            EXPECT_TRUE(bits == 21 || bits == 22) << bits;
        }
    }
}

TEST(Thesis, GaussianWeightsAreThoseOfTheNormalDistribution) {
    const auto model = make_delta_model(Model::gaussian, 50);
    const auto mass = [](double t) { return 0.5 * std::erf(t / std::sqrt(2.0)); };
    for (const double deviation : {0.3, 0.5, 1.0, 2.0, 6.0, 15.0, 40.0, 99.0}) {
        const auto given = static_cast<std::int64_t>(deviation * 65536);
        const double all = 2 * mass(50.5 / deviation);
        std::uint32_t sum = 0;
        for (entropy::Symbol symbol = 0; symbol < 103; ++symbol) {
            const auto part = model->part(0, symbol, given);
            EXPECT_EQ(part.below, sum);
            ASSERT_GE(part.weight, 1U);
            EXPECT_EQ(model->find(0, part.below, given), symbol);
            EXPECT_EQ(model->find(0, part.below + part.weight - 1, given), symbol);
            sum += part.weight;
            if (symbol < entropy::first_value_symbol) continue;
            const double d = static_cast<double>(symbol) - 52;
            const double share = (mass((d + 0.5) / deviation) - mass((d - 0.5) / deviation)) / all;
            // The table's error at both edges, their cut to 2^-14 deviations, and the 1 of a value.
            const double cut = (d == 0 ? 2 : 1) * 0.4 / 16384;
            EXPECT_NEAR(part.weight, share * (1 << 20) + 1, (1.6e-5 + cut) * (1 << 20) / all + 2)
                << deviation << ' ' << d;
        }
        EXPECT_EQ(sum, model->total(0));
        EXPECT_EQ(sum, (1U << 20) + 103);
        EXPECT_EQ(model->total(1), sum - 1);  // the end is a symbol of x alone
    }
}

TEST(Thesis, AdaptiveModelCountsWhatCameAndKeepsItOverARestart) {
    // 1 of 104, 2 of 103 and 2 of 103, as y and z stayed once: 18.1 bits, and eq. 3.31.
    ThesisCodec codec = eastbound(Kind::fixed, Model::adaptive);
    const std::size_t first = bits_alone(codec, {30, 0, -10});
    EXPECT_TRUE(first == 19 || first == 20) << first;
    // 15 m east again and again: after n of them the three symbols weigh n + 1 of about n + 103.
    int x = 30;
    for (int k = 0; k < 1000; ++k) codec.learn({x += 15, 0, -10});
    EXPECT_LE(bits_alone(codec, {x += 15, 0, -10}), 2U);  // 3 log2(1103/1002) = 0.42
    codec.restart({0, 0, 0});
    EXPECT_LE(bits_alone(codec, {0, 0, 0}), 2U);
}

TEST(Thesis, ResolutionCountsInCells) {
    // 15 m are 150 cells of 10 cm, and 50 m are 500.
    CodecOptions options = options_of(Kind::fixed, Model::uniform);
    options.resolution_mm = 100;
    ThesisCodec codec(options);
    codec.restart({0, 0, 0});
    codec.learn({0, 150, 0});
    EXPECT_TRUE(codec.can_encode({0, 300 + 500, 0}));
    EXPECT_FALSE(codec.can_encode({0, 300 + 501, 0}));
    EXPECT_FALSE(codec.can_encode({0, 300 - 501, 0}));
    // The filter's gains are those of metres: the step of KalmanObserverByHand, 850.94 cells.
    options.kind = Kind::kalman;
    ThesisCodec kalman(options);
    kalman.restart({0, 0, 0});
    kalman.learn({400, 0, 0});
    EXPECT_TRUE(kalman.can_encode({851 + 500, 0, 0}));
    EXPECT_FALSE(kalman.can_encode({851 + 501, 0, 0}));
    EXPECT_FALSE(kalman.can_encode({851 - 501, 0, 0}));
}

TEST(Thesis, BoundGrowsWhereAVehicleCanTurnBackFarther) {
    CodecOptions options;
    EXPECT_EQ(delta_bound(options), 50);  // 2 s*tau is 30 m
    options.interval_ms = 60'000;
    EXPECT_EQ(delta_bound(options), 180);
    options.resolution_mm = 1;
    EXPECT_EQ(delta_bound(options), 5000);
    options.resolution_mm = 1'000'000;
    EXPECT_EQ(delta_bound(options), 1);
}

TEST(Thesis, ANewCodecKnowsNoPosition) {
    for (const CodecOptions& options : all_options()) {
        const auto codec = make_codec(options);
        EXPECT_FALSE(codec->can_encode({0, 0, 0}));
        entropy::BitString bits;
        EXPECT_THROW(codec->encode_alone({0, 0, 0}, bits), std::logic_error);
        entropy::BitReader in("\xff\xff");
        EXPECT_EQ(message_of([&] { codec->decode_alone(in); }),
                  "no position is known to go on from");
        codec->learn({1, 2, 3});
        EXPECT_TRUE(codec->can_encode({1, 2, 3}));
    }
}

TEST(Thesis, EndAndOutOfRangeEndAPacketAndAreNotLearnt) {
    for (const CodecOptions& options : all_options()) {
        ThesisCodec sender(options);
        sender.restart({5, 5, 5});
        const auto receiver = sender.clone();
        entropy::BitString bits;
        entropy::Encoder out(bits);
        sender.encode({10, 5, 5}, out);
        const std::string then = sender.save();
        sender.encode_end(out);
        out.finish();
        const std::size_t first = bits.size();
        sender.encode_out_of_range(out);
        out.finish();
        EXPECT_EQ(sender.save(), then);

        entropy::BitReader reader(bits.bytes(), bits.size());
        entropy::Decoder in(reader);
        EXPECT_EQ(receiver->decode(in), (Cell{10, 5, 5}));
        EXPECT_EQ(receiver->decode(in), std::nullopt);
        in.finish();
        EXPECT_EQ(reader.position(), first);
        EXPECT_EQ(receiver->decode(in), std::nullopt);
        EXPECT_EQ(reader.left(), 0U);
        EXPECT_EQ(receiver->save(), then);
    }
}

TEST(Thesis, LimitsOfACellAreKept) {
    for (const CodecOptions& options : all_options()) {
        const auto codec = make_codec(options);
        codec->restart({cell_limit, -cell_limit, 0});
        EXPECT_TRUE(codec->can_encode({cell_limit, -cell_limit, 0}));
        EXPECT_FALSE(codec->can_encode({cell_limit + 1, -cell_limit, 0}));
        EXPECT_FALSE(codec->can_encode({cell_limit, -cell_limit - 1, 0}));
        // Ones are the last symbol, 50 cells to the east.
        entropy::BitReader in("\xff\xff\xff\xff\xff\xff");
        EXPECT_EQ(message_of([&] { codec->decode_alone(in); }), "position is beyond the limits");
    }
}

/// Ways of a vehicle, with leaps that only a full fix can follow, and up to the limits.
std::vector<Cell> any_walk() {
    const auto near_edge = [](int side) { return side * (cell_limit - *rc::gen::inRange(0, 80)); };
    Cell at{*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000), -20};
    if (*rc::gen::inRange(0, 3) == 0) at = {near_edge(1), near_edge(-1), near_edge(-1)};
    const int speed = *rc::gen::element(0, 2, 15, 40, 200);
    std::vector<Cell> walk;
    const auto count = *rc::gen::inRange<std::size_t>(1, 60);
    const auto kept = [](std::int32_t v) { return std::clamp(v, -cell_limit, cell_limit); };
    for (std::size_t k = 0; k < count; ++k) {
        walk.push_back(at);
        const int leap = *rc::gen::inRange(0, 20) == 0 ? 3000 : 0;
        const auto step = [&] { return *rc::gen::inRange(-speed - leap, speed + leap + 1); };
        at = {kept(at.x + speed + step()), kept(at.y + step()), kept(at.z + step())};
    }
    return walk;
}

CodecOptions any_options() {
    CodecOptions options = *rc::gen::elementOf(all_options());
    options.interval_ms =
        *rc::gen::element<std::int64_t>(1, 100, 5000, 10'000, 600'000, 86'400'000);
    options.speed_mmps = *rc::gen::element<std::int64_t>(1, 300, 1500, 100'000);
    options.resolution_mm = *rc::gen::element<std::int64_t>(1, 100, 1000, 1'000'000);
    return options;
}

/// One packet of up to `most` positions from `at` on; both codecs must have learnt the same by it.
std::size_t send(Codec& sender, Codec& receiver, const std::vector<Cell>& walk, std::size_t at,
                 std::size_t most) {
    entropy::BitString bits;
    entropy::Encoder out(bits);
    std::size_t sent = 0;
    for (; sent < most && at + sent < walk.size() && sender.can_encode(walk[at + sent]); ++sent)
        sender.encode(walk[at + sent], out);
    if (sent < most) sender.encode_end(out);
    out.finish();
    const std::size_t size = bits.size();
    bits.put(0x5A5A, 16);  // what follows has no say

    entropy::BitReader reader(bits.bytes(), bits.size());
    entropy::Decoder in(reader);
    for (std::size_t k = 0; k < sent; ++k) RC_ASSERT(receiver.decode(in) == walk[at + k]);
    if (sent < most) RC_ASSERT(receiver.decode(in) == std::nullopt);
    RC_ASSERT(reader.position() == size);
    return sent;
}

TEST(Thesis, LawWhatIsEncodedIsDecodedAndLearntAlike) {
    EXPECT_TRUE(rc::check("what is encoded is decoded and learnt alike", [] {
        const std::vector<Cell> walk = any_walk();
        const auto sender = make_codec(any_options());
        const auto receiver = sender->clone();
        const auto listener = sender->clone();
        for (std::size_t at = 0; at < walk.size();) {
            if (!sender->can_encode(walk[at])) {
                sender->restart(walk[at]);
                receiver->restart(walk[at]);
                listener->learn(walk[at++]);
                continue;
            }
            const auto most = *rc::gen::inRange<std::size_t>(1, 6);
            for (std::size_t n = send(*sender, *receiver, walk, at, most); n > 0; --n)
                listener->learn(walk[at++]);
            const std::string state = sender->save();
            RC_ASSERT(receiver->save() == state);
            RC_ASSERT(listener->save() == state);
            RC_ASSERT(sender->clone()->save() == state);
        }
    }));
}

TEST(Thesis, LawOnePositionAPacketToTheBit) {
    EXPECT_TRUE(rc::check("one position a packet, to the bit", [] {
        const std::vector<Cell> walk = any_walk();
        const auto sender = make_codec(any_options());
        const auto receiver = sender->clone();
        for (const Cell& cell : walk) {
            if (!sender->can_encode(cell)) {
                sender->restart(cell);
                receiver->restart(cell);
                continue;
            }
            entropy::BitString bits;
            sender->encode_alone(cell, bits);
            entropy::BitReader exact(bits.bytes(), bits.size());
            RC_ASSERT(receiver->decode_alone(exact) == cell);
            RC_ASSERT(exact.left() == 0U);
        }
        RC_ASSERT(sender->save() == receiver->save());
    }));
}

TEST(Thesis, LawAnyBitsAreDecodedOrRefused) {
    EXPECT_TRUE(rc::check("any bits are decoded or refused", [] {
        const auto codec = make_codec(any_options());
        for (const Cell& cell : any_walk()) codec->learn(cell);
        const auto bytes = *rc::gen::arbitrary<std::string>();
        entropy::BitReader reader(bytes);
        entropy::Decoder in(reader);
        try {
            for (int k = 0; k < 100; ++k) {
                const auto cell = codec->decode(in);
                if (!cell) break;
                RC_ASSERT(in_limits(*cell));
            }
        } catch (const DataError&) {
        }
    }));
}

TEST(Thesis, LawStateIsKeptAndGoesOnAlike) {
    EXPECT_TRUE(rc::check("a state is kept, and goes on alike", [] {
        const CodecOptions options = any_options();
        const auto codec = make_codec(options);
        const std::vector<Cell> walk = any_walk();
        for (const Cell& cell : walk) codec->learn(cell);
        const std::string state = codec->save();
        const auto other = make_codec(options);
        other->learn({7, 7, 7});
        other->load(state);
        RC_ASSERT(other->save() == state);
        codec->learn(walk.front());
        other->learn(walk.front());
        RC_ASSERT(other->save() == codec->save());
    }));
}

TEST(Thesis, LawADamagedStateIsRefusedWithoutHarm) {
    EXPECT_TRUE(rc::check("a damaged state is refused without harm", [] {
        const auto codec = make_codec(any_options());
        for (const Cell& cell : any_walk()) codec->learn(cell);
        const std::string state = codec->save();
        std::string bad = state;
        if (*rc::gen::inRange(0, 2) == 0)
            bad.resize(*rc::gen::inRange<std::size_t>(0, state.size()));
        else
            bad[*rc::gen::inRange<std::size_t>(0, state.size())] ^=
                static_cast<char>(*rc::gen::inRange(1, 256));
        RC_ASSERT_THROWS_AS(codec->load(bad), DataError);
        RC_ASSERT(codec->save() == state);
    }));
}

TEST(Thesis, StateThatIsWellFormedButWrongIsRefusedWithoutHarm) {
    // Any numbers, with a good check sum: taken or refused, and taken ones do no harm.
    EXPECT_TRUE(rc::check("a well-formed state that is wrong is refused without harm", [] {
        const CodecOptions options = *rc::gen::elementOf(all_options());
        StateWriter out(1);
        for (const auto kind :
             {static_cast<std::int64_t>(options.kind), static_cast<std::int64_t>(options.model),
              options.interval_ms, options.speed_mmps, options.resolution_mm, std::int64_t{1}})
            out.number(kind);
        const auto big = std::int64_t{1} << *rc::gen::inRange(1, 63);
        for (int k = 0; k < (options.kind == Kind::fixed ? 6 : 10); ++k)
            out.number(*rc::gen::inRange(-big, big));
        if (options.model == Model::adaptive) {
            for (int k = 0; k < 303; ++k) out.number(*rc::gen::inRange<std::int64_t>(1, big));
        }
        const auto codec = make_codec(options);
        try {
            codec->load(out.finish());
        } catch (const DataError&) {
            return;
        }
        for (const Cell& cell : any_walk()) codec->learn(cell);
    }));
}

TEST(Thesis, StateOfAnotherVersionOrOfOtherOptionsIsNamed) {
    const auto codec = make_codec(options_of(Kind::fixed, Model::uniform));
    std::string state = codec->save();
    EXPECT_EQ(
        message_of([&] { make_codec(options_of(Kind::kalman, Model::uniform))->load(state); }),
        "state is of a codec of other options");
    state[0] = 2;
    EXPECT_EQ(message_of([&] { codec->load(state); }), "state is of version 2, not 1");
    EXPECT_EQ(message_of([&] { codec->load(""); }), "state is cut or damaged");
}

// ------------------------------------------------------------------ the reference figures

/// What a whole track costs, decoded too. As the reference counts: each position but the first and
/// those after a gap is a delta message; one that cannot be coded costs out_of_range_symbol, and a
/// full fix follows.
struct Cost {
    std::size_t deltas = 0, fulls = 0, bits = 0;
    double bits_per_delta() const {
        return static_cast<double>(bits) / static_cast<double>(deltas);
    }
};

class Meter {
public:
    Meter(const CodecOptions& options, std::size_t per_packet)
        : sender_(options), receiver_(sender_.clone()), per_packet_(per_packet) {}

    Cost run(const std::vector<TimedCell>& fixes, double tau_s) {
        double last_s = -1e18;
        for (const TimedCell& fix : fixes) {
            const bool gap = fix.time_s - last_s > 1.5 * tau_s;
            last_s = fix.time_s;
            if (gap) {
                full(fix.cell);
                continue;
            }
            ++cost_.deltas;
            if (sender_.can_encode(fix.cell)) {
                sender_.encode(fix.cell, out_);
                packet_.push_back(fix.cell);
                if (packet_.size() == per_packet_) flush();
            } else {
                sender_.encode_out_of_range(out_);
                packet_.push_back(std::nullopt);
                full(fix.cell);
            }
        }
        flush();
        return cost_;
    }

private:
    void full(const Cell& cell) {
        flush();
        ++cost_.fulls;
        sender_.restart(cell);
        receiver_->restart(cell);
    }
    void flush() {
        out_.finish();
        cost_.bits += bits_.size();
        entropy::BitReader reader(bits_.bytes(), bits_.size());
        entropy::Decoder in(reader);
        for (const auto& cell : packet_) EXPECT_EQ(receiver_->decode(in), cell);
        EXPECT_EQ(reader.left(), 0U);
        bits_.clear();
        packet_.clear();
    }

    ThesisCodec sender_;
    std::unique_ptr<Codec> receiver_;
    std::size_t per_packet_;
    entropy::BitString bits_;
    entropy::Encoder out_{bits_};
    std::vector<std::optional<Cell>> packet_;
    Cost cost_;
};

CodecOptions named(const std::string& name) {
    CodecOptions options;
    options.kind = name.starts_with("Fixed") ? Kind::fixed : Kind::kalman;
    if (name.find("Uniform") != std::string::npos) options.model = Model::uniform;
    if (name.find("Gaussian") != std::string::npos) options.model = Model::gaussian;
    return options;
}

void compare(const json& expected, const std::string& name, const CodecOptions& options,
             const std::vector<TimedCell>& fixes, double tau_s) {
    const Cost one = Meter(options, 1).run(fixes, tau_s);
    const Cost three = Meter(options, 3).run(fixes, tau_s);
    EXPECT_EQ(one.deltas, expected.at("nd")) << name;
    EXPECT_EQ(one.fulls, expected.at("nf")) << name;
    EXPECT_EQ(three.fulls, expected.at("nf")) << name;
    const double want_one = expected.at("one_per_packet"),
                 want_three = expected.at("three_per_packet");
    EXPECT_NEAR(one.bits_per_delta(), want_one, want_one / 100) << name;
    EXPECT_NEAR(three.bits_per_delta(), want_three, want_three / 100) << name;
    if (std::getenv("SEAUTILS_TABLE") == nullptr) return;
    std::printf("%-44s %7.3f %7.3f %+.2f%%  %7.3f %7.3f %+.2f%%\n", name.c_str(), want_one,
                one.bits_per_delta(), 100 * (one.bits_per_delta() / want_one - 1), want_three,
                three.bits_per_delta(), 100 * (three.bits_per_delta() / want_three - 1));
}

/// With SEAUTILS_TABLE set, also prints what was expected, what came, and by how much it differs.
TEST(Thesis, ReferenceFiguresOnWholeTracks) {
    std::ifstream file(vectors_folder() + "/expected.json");
    if (!file) GTEST_SKIP() << "no vectors in " << vectors_folder() << " (SEAUTILS_SHARED)";
    const json all = json::parse(file);
    ASSERT_GE(all.size(), 11U);
    for (const json& entry : all) {
        const std::string name = entry.at("file");
        const std::vector<TimedCell> fixes = track_of(name);
        ASSERT_GT(fixes.size(), 200U) << name;
        const double tau_s = entry.at("tau_s"), speed_mps = entry.at("speed_mps");
        for (const auto& [codec, expected] : entry.at("thesis").items()) {
            if (codec.find("R=") != std::string::npos) continue;  // a variant that is not offered
            CodecOptions options = named(codec);
            options.interval_ms = std::llround(tau_s * 1000);
            options.speed_mmps = std::llround(speed_mps * 1000);
            compare(expected, name + " " + codec, options, fixes, tau_s);
        }
    }
}

}  // namespace
}  // namespace seautils::position
