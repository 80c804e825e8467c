// The mix codec: its laws, its parts against floating point, and the reference figures on whole tracks.
#include "position_tracks.hpp"
#include "sanitized.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/joint_code.hpp"
#include "seautils/position/mix_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::position {
namespace {

double normal(double t) { return 0.5 * std::erfc(-t / std::sqrt(2.0)); }

CodecOptions any_options() {
    CodecOptions options;
    options.small = *rc::gen::arbitrary<bool>();
    const auto waypoints = *rc::gen::inRange(0, 4);
    for (int k = 0; k < waypoints; ++k)
        options.plan.push_back({*rc::gen::inRange(-500, 500), *rc::gen::inRange(-500, 500), -20});
    return options;
}

/// Ways of a vehicle, with leaps, and up to the limits.
std::vector<Cell> any_walk(std::size_t most = 60) {
    const auto near_edge = [](int side) { return side * (cell_limit - *rc::gen::inRange(0, 80)); };
    Cell at{*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000), -20};
    if (*rc::gen::inRange(0, 3) == 0) at = {near_edge(1), near_edge(-1), near_edge(-1)};
    const int speed = *rc::gen::element(0, 2, 15, 200);
    const int leap = *rc::gen::element(0, 3000, 8'000'000);
    std::vector<Cell> walk;
    const auto count = *rc::gen::inRange<std::size_t>(1, most);
    const auto kept = [](std::int32_t v) { return std::clamp(v, -cell_limit, cell_limit); };
    for (std::size_t k = 0; k < count; ++k) {
        walk.push_back(at);
        const int size = speed + (*rc::gen::inRange(0, 12) == 0 ? leap : 0);
        const auto step = [&] { return *rc::gen::inRange(-size, size + 1); };
        at = {kept(at.x + speed + step()), kept(at.y + step()), kept(at.z + step())};
    }
    return walk;
}

TEST(Mix, IntegersAreWhatTheirDocumentationSays) {
    for (int t = -90112; t <= 90112; t += 13)
        ASSERT_NEAR(normal_cdf_q24(t) / 16777216.0, normal(t / 16384.0), 8.5e-6) << t;
    EXPECT_EQ(normal_cdf_q24(-90112), 0);
    EXPECT_EQ(normal_cdf_q24(90112), 1 << 24);
    for (std::uint64_t v = 1; v < 1U << 30; v += 1 + v / 100)
        ASSERT_NEAR(log2_q16(v) / 65536.0, std::log2(static_cast<double>(v)), 5e-5) << v;
    for (int x = -60000; x < 60000; x += 17)
        ASSERT_NEAR(probability_q16(x) / 65536.0, 1 / (1 + std::exp(-x / 4096.0)), 8e-5) << x;
    for (const std::uint64_t root : {0ULL, 1ULL, 2ULL, 1000ULL, 65535ULL, 4294967295ULL}) {
        EXPECT_EQ(square_root(root * root), root);
        EXPECT_EQ(square_root(root * root + 2 * root), root);
    }
}

TEST(Mix, GainsAreThoseOfTheFilter) {
    // Kalman's equations in floating point.
    const double q = 0.2, r = 0.12, spread = 2;
    const FilterGains gains(13107, 7864, 131072);
    double pp = r, pv = r, vv = 2 * r + spread * spread;
    for (std::size_t k = 0; k < FilterGains::steps; ++k) {
        pp += 2 * pv + vv + q * q / 3;
        pv += vv + q * q / 2;
        vv += q * q;
        const double gain_p = pp / (pp + r), gain_v = pv / (pp + r);
        EXPECT_NEAR(gains.position[k] / 65536.0, gain_p, 2e-4) << k;
        EXPECT_NEAR(gains.velocity[k] / 65536.0, gain_v, 2e-4) << k;
        EXPECT_NEAR(gains.innovation[k] / 65536.0, pp + r, 2e-3) << k;
        vv -= gain_v * pv;
        pv -= gain_p * pv;
        pp -= gain_p * pp;
    }
}

TEST(Mix, PlaneIsThatOfTurnedNormalDistributions) {
    // Numbers in 256ths: 3 cells along and 1 across a heading of 30 degrees, around (1.5, -0.25).
    PlaneMixture m;
    const double c = std::sqrt(3.0) / 2, s = 0.5;
    m.add(one_q20, {384, -64}, 768, 256, {14189, 8192});
    const double xx = 9 * c * c + s * s, yy = 9 * s * s + c * c, xy = (9 - 1) * c * s;
    const double sd_x = std::sqrt(xx), sd_y = std::sqrt(yy - xy * xy / xx);
    double sum = 0;
    for (int x = -12; x <= 14; ++x) {
        const double px = normal((x + 0.5 - 1.5) / sd_x) - normal((x - 0.5 - 1.5) / sd_x);
        const Mixture along_y = m.along_y(x);
        for (int y = -12; y <= 12; ++y) {
            const double mean = -0.25 + xy / xx * (x - 1.5);
            const double py = normal((y + 0.5 - mean) / sd_y) - normal((y - 0.5 - mean) / sd_y);
            if (px < 0.002) continue;  // the mean is held within four deviations of x
            EXPECT_NEAR(along_y.probability_q24(y) / 16777216.0, py, 0.004) << x << ' ' << y;
            EXPECT_NEAR(m.probability_q24(x, y) / 16777216.0, px * py, 0.001) << x << ' ' << y;
        }
        sum += m.along_x().probability_q24(x) / 16777216.0;
    }
    EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(Mix, NearestSituationsAreFound) {
    EXPECT_TRUE(rc::check("found as sorted", [] {
        const bool mirrored = *rc::gen::arbitrary<bool>();
        Analogs memory(40, 3, mirrored, 1);
        std::vector<std::pair<Features, Pair>> all;  // the youngest last
        const auto number = rc::gen::inRange(-300, 300);
        const auto count = *rc::gen::inRange(1, 70);
        for (int k = 0; k < count; ++k) {
            all.push_back({{{*number, *number, *number}}, {*number, *number}});
            memory.remember(all.back().first, all.back().second);
        }
        const Features here{{*number, *number, *number}};
        std::vector<std::pair<int, int>> by_distance;  // and by order
        std::vector<Pair> outcomes;
        for (const int sign : {1, -1}) {
            for (int age = 0; age < std::min(count, 40) && (mirrored || sign > 0); ++age) {
                const auto& [f, outcome] = all[static_cast<std::size_t>(count - 1 - age)];
                const int a = here.value[0] - f.value[0], b = sign * here.value[1] - f.value[1],
                          c = sign * here.value[2] - f.value[2];
                by_distance.push_back({a * a + b * b + c * c + age / 8 + (sign < 0 ? 77 : 0),
                                       static_cast<int>(outcomes.size())});
                outcomes.push_back({outcome.x, sign * outcome.y});
            }
        }
        std::sort(by_distance.begin(), by_distance.end());
        std::array<Analogs::Found, 16> found;
        const std::size_t n = memory.find(here, found);
        RC_ASSERT(n == std::min<std::size_t>(16, outcomes.size()));
        for (std::size_t k = 0; k < n; ++k) {
            RC_ASSERT(found[k].distance == by_distance[k].first);
            RC_ASSERT(found[k].outcome ==
                      outcomes[static_cast<std::size_t>(by_distance[k].second)]);
        }
    }));
}

TEST(Mix, MixerLearnsWhomToBelieve) {
    // One of two says the truth; the other the opposite half of the time.
    Mixer mixer(3, {1, 1, 1});
    Mixer::Answer a;
    for (int k = 0; k < 4000; ++k) {
        const bool yes = k * 7 % 11 < 5;
        const std::int32_t right = yes ? 4096 : -4096, wrong = k % 2 == 0 ? right : -right;
        a = mixer.ask({right, wrong, 1229}, 0, {0, 0, 0}, 0);
        mixer.learn(a, yes);
    }
    EXPECT_GT(mixer.ask({4096, -4096, 1229}, 0, {0, 0, 0}, 0).yes, 62000);
    EXPECT_LT(mixer.ask({-4096, 4096, 1229}, 0, {0, 0, 0}, 0).yes, 3500);
}

/// The bits of an optimal code: the sum of all that Huffman's joins weigh.
std::uint64_t optimal_bits(const std::vector<std::uint64_t>& weights) {
    std::multimap<std::uint64_t, int> left;
    for (const std::uint64_t w : weights) left.emplace(w, 0);
    std::uint64_t sum = 0;
    while (left.size() > 1) {
        const auto second = std::next(left.begin());
        const std::uint64_t both = left.begin()->first + second->first;
        left.erase(left.begin(), std::next(second));
        left.emplace(both, 0);
        sum += both;
    }
    return sum;
}

TEST(Mix, JointCodeIsOptimalAndDecodes) {
    EXPECT_TRUE(rc::check("optimal", [] {
        const auto exponent = *rc::gen::inRange(1, 32);
        const auto weights = *rc::gen::container<std::vector<std::uint64_t>>(
            *rc::gen::inRange<std::size_t>(2, 120),
            rc::gen::inRange<std::uint64_t>(1, (std::uint64_t{1} << exponent) + 1));
        const JointCode code(weights);
        std::uint64_t bits_in_all = 0;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            entropy::BitString bits;
            code.put(k, bits);
            bits_in_all += weights[k] * bits.size();
            entropy::BitReader in(bits.bytes(), bits.size());
            RC_ASSERT(code.get(in) == k);
            RC_ASSERT(in.left() == 0U);
        }
        RC_ASSERT(bits_in_all == optimal_bits(weights));
    }));
}

/// Compared here, so that a law that fails does not print all of two states.
bool same(const std::string& a, const std::string& b) { return a == b; }

/// One packet of `count` positions from `at` on; both codecs must have learnt the same by it.
void send(Codec& sender, Codec& receiver, const std::vector<Cell>& walk, std::size_t at,
          std::size_t count) {
    entropy::BitString bits;
    if (count == 1) {
        sender.encode_alone(walk[at], bits);
    } else {
        entropy::Encoder out(bits);
        for (std::size_t k = 0; k < count; ++k) sender.encode(walk[at + k], out);
        out.finish();
    }
    const std::size_t size = bits.size();
    bits.put(0x5A5A, 16);  // what follows has no say
    entropy::BitReader reader(bits.bytes(), bits.size());
    if (count == 1) {
        RC_ASSERT(receiver.decode_alone(reader) == walk[at]);
    } else {
        entropy::Decoder in(reader);
        for (std::size_t k = 0; k < count; ++k) RC_ASSERT(receiver.decode(in) == walk[at + k]);
    }
    RC_ASSERT(reader.position() == size);
}

TEST(Mix, LawWhatIsEncodedIsDecodedAndLearntAlike) {
    EXPECT_TRUE(rc::check("decode(encode(x)) is x", [] {
        const std::vector<Cell> walk = any_walk();
        const auto sender = make_codec(any_options());
        sender->restart(walk[0]);
        const auto receiver = sender->clone(), listener = sender->clone();
        for (std::size_t at = 1; at < walk.size();) {
            if (*rc::gen::inRange(0, 15) == 0) {
                for (Codec* c : {sender.get(), receiver.get(), listener.get()})
                    c->restart(walk[at]);
                ++at;
                continue;
            }
            const auto count = std::min(*rc::gen::inRange<std::size_t>(1, 6), walk.size() - at);
            send(*sender, *receiver, walk, at, count);
            for (std::size_t k = 0; k < count; ++k) listener->learn(walk[at++]);
        }
        const std::string state = sender->save();
        RC_ASSERT(same(receiver->save(), state));
        RC_ASSERT(same(listener->save(), state));
        RC_ASSERT(same(sender->clone()->save(), state));
    }));
}

TEST(Mix, NoPositionWithinTheLimitsIsOutOfRange) {
    const auto sender = make_codec({});
    EXPECT_FALSE(sender->can_encode({0, 0, 0}));
    entropy::BitString none;
    EXPECT_THROW(sender->encode_alone({0, 0, 0}, none), std::logic_error);
    sender->restart({cell_limit, cell_limit, -cell_limit});
    const auto receiver = sender->clone();
    for (const Cell& far : {Cell{-cell_limit, -cell_limit, cell_limit},
                            Cell{cell_limit, -cell_limit, 0}, Cell{0, 0, 0}}) {
        EXPECT_TRUE(sender->can_encode(far));
        entropy::BitString bits;
        sender->encode_alone(far, bits);
        EXPECT_LT(bits.size(), 170U);
        entropy::BitReader in(bits.bytes(), bits.size());
        EXPECT_EQ(receiver->decode_alone(in), far);
    }
    EXPECT_FALSE(sender->can_encode({cell_limit + 1, 0, 0}));
}

TEST(Mix, LawAnyBitsAreDecodedOrRefused) {
    EXPECT_TRUE(rc::check("any bits", [] {
        const auto codec = make_codec(any_options());
        for (const Cell& cell : any_walk()) codec->learn(cell);
        const auto alone = codec->clone();
        const auto bytes = *rc::gen::arbitrary<std::string>();
        entropy::BitReader reader(bytes), reader_alone(bytes);
        entropy::Decoder in(reader);
        try {
            for (int k = 0; k < 100; ++k) RC_ASSERT(in_limits(codec->decode(in).value()));
        } catch (const DataError&) {
        }
        try {
            for (int k = 0; k < 100; ++k)
                RC_ASSERT(in_limits(alone->decode_alone(reader_alone).value()));
        } catch (const DataError&) {
        }
    }));
}

TEST(Mix, LawStateIsKeptAndGoesOnAlike) {
    EXPECT_TRUE(rc::check("load(save())", [] {
        const CodecOptions options = any_options();
        const auto codec = make_codec(options);
        const std::vector<Cell> walk = any_walk();
        for (const Cell& cell : walk) codec->learn(cell);
        const std::string state = codec->save();
        const auto other = make_codec(options);
        other->learn({7, 7, 7});
        other->load(state);
        RC_ASSERT(same(other->save(), state));
        codec->learn(walk.front());
        other->learn(walk.front());
        RC_ASSERT(same(other->save(), codec->save()));
    }));
}

/// The bytes with the check sum that belongs to them: FNV-1a over all but the last four.
void seal(std::string& state) {
    std::uint32_t sum = 2166136261U;
    for (std::size_t k = 0; k + 4 < state.size(); ++k)
        sum = (sum ^ static_cast<unsigned char>(state[k])) * 16777619U;
    for (std::size_t k = 0; k < 4; ++k)
        state[state.size() - 4 + k] = static_cast<char>(sum >> (8 * k) & 0xFF);
}

TEST(Mix, LawADamagedStateIsRefusedOrHarmless) {
    EXPECT_TRUE(rc::check("damaged states", [] {
        const auto codec = make_codec(any_options());
        for (const Cell& cell : any_walk()) codec->learn(cell);
        const std::string state = codec->save();
        std::string bad = state;
        const auto changes = *rc::gen::inRange(1, 8);
        for (int k = 0; k < changes; ++k)
            bad[*rc::gen::inRange<std::size_t>(1, state.size() - 4)] =
                static_cast<char>(*rc::gen::inRange(0, 256));
        if (bad != state) {
            RC_ASSERT_THROWS_AS(codec->load(bad), DataError);
        }
        RC_ASSERT(same(codec->save(), state));
        seal(bad);
        try {
            codec->load(bad);
        } catch (const DataError&) {
            RC_ASSERT(same(codec->save(), state));
        }
        for (const Cell& cell : any_walk(10)) codec->learn(cell);
    }));
}

TEST(Mix, StateOfOtherOptionsIsRefused) {
    CodecOptions small, planned;
    small.small = true;
    planned.plan = {{100, 200, -30}};
    const std::string state = make_codec({})->save();
    EXPECT_THROW(make_codec(small)->load(state), DataError);
    EXPECT_THROW(make_codec(planned)->load(state), DataError);
    EXPECT_LE(state.size(), 200U * 1024);
}

TEST(Mix, APlanTakesTheSurpriseOutOfTurns) {
    // Legs of 8 to 17 steps of 15 m, headings and depths at random, noise of half a metre.
    std::uint64_t seed = 7;
    const auto below = [&seed](int n) {
        seed = seed * 6364136223846793005U + 1442695040888963407U;
        return static_cast<int>((seed >> 33) % static_cast<unsigned>(n));
    };
    CodecOptions options;
    std::vector<Cell> track{{0, 0, -10}};
    double x = 0, y = 0, z = -10;
    for (int leg = 0; leg < 60; ++leg) {
        const double heading = below(360) * 0.0174533, depth = -10 - below(30);
        const int steps = 8 + below(10);
        for (int k = 0; k < steps; ++k) {
            x += 15 * std::cos(heading);
            y += 15 * std::sin(heading);
            z += std::clamp(depth - z, -3.0, 3.0);
            const auto noisy = [&](double v) {
                return static_cast<std::int32_t>(std::lround(v + below(100) * 0.01 - 0.5));
            };
            track.push_back({noisy(x), noisy(y), noisy(z)});
        }
        options.plan.push_back({static_cast<std::int32_t>(std::lround(x)),
                                static_cast<std::int32_t>(std::lround(y)),
                                static_cast<std::int32_t>(depth)});
    }
    const double with_plan = bits_a_delta({track}, options, 1);
    options.plan.clear();
    const double without = bits_a_delta({track}, options, 1);
    EXPECT_LT(with_plan, without - 0.7) << with_plan << " against " << without;
}

TEST(Mix, ReferenceFiguresOnWholeTracks) {
    if (is_sanitized) GTEST_SKIP() << "sanitizers: shorter tests walk the same code";
    // The longest tracks are left to `poscode stat`: they would take minutes here.
    if (!shared_tracks()) GTEST_SKIP() << "SEAUTILS_SHARED is not there";
    for (const ReferenceTrack& track : reference_tracks()) {
        SCOPED_TRACE(track.file);
        std::size_t positions = 0;
        for (const StraightRun& run : track.runs) positions += run.size();
        if (positions > 4000) continue;
        const double eight = bits_a_delta(track.runs, {}, 8);
        EXPECT_LT(eight, 1.03 * track.eight);
        CodecOptions small;
        small.small = true;
        EXPECT_LT(bits_a_delta(track.runs, small, 8), eight + 0.05);
        if (positions > 1200) continue;
        const double alone = bits_a_delta(track.runs, {}, 1);
        EXPECT_LT(alone, 1.03 * track.alone);
        EXPECT_LT(alone, 0.65 * track.thesis_alone);
    }
}

}  // namespace
}  // namespace seautils::position
