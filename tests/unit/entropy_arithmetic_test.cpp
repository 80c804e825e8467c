#include "seautils/entropy/arithmetic.hpp"

#include "seautils/core/error.hpp"
#include "seautils/entropy/coder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>

namespace seautils::entropy {
namespace {

Model delta() {
    return {"delta", {1, 5, 20, 60, 20, 5, 1}, 4, 2, {-3, -2, -1, 0, 1, 2, 3, 4}, false};
}
Model weather() { return {"wx", {50, 30, 15, 5}, 1, 0, {0, 1, 2, 3, 4}, false}; }
Model level() { return {"level", {10, 20, 30, 20, 10}, 1, 1, {0, 0.5, 1, 2, 5, 10}, false}; }
Model adaptive() { return {"adaptive", {1, 1, 1, 1}, 1, 0, {0, 1, 2, 3, 4}, true}; }

/// Bits of runs as text, first one first.
class Bits {
public:
    void put(const Model& model, Counts& counts, const std::vector<double>& values,
             std::uint32_t max_count, bool lenient = false) {
        encode_run(
            model, counts, values, max_count, [this](bool b) { text += b ? '1' : '0'; }, lenient);
    }
    void put(const Model& model, const std::vector<double>& values, std::uint32_t max_count,
             bool lenient = false) {
        Counts counts(model);
        put(model, counts, values, max_count, lenient);
    }
    void put_number(unsigned value, unsigned width) {
        for (; width > 0; --width, value /= 2) text += value % 2 == 1 ? '1' : '0';
    }
    /// Lower-case hexadecimal of the bytes, least significant bit first, filled up with zeros.
    std::string hex() const {
        std::string out;
        for (std::size_t k = 0; k < text.size(); k += 8) {
            unsigned byte = 0;
            for (std::size_t b = k; b < text.size() && b < k + 8; ++b) {
                byte |= text[b] == '1' ? 1U << (b - k) : 0;
            }
            out += "0123456789abcdef"[byte / 16];
            out += "0123456789abcdef"[byte % 16];
        }
        return out;
    }
    std::string text;
};

/// Reads bits of a text; throws at its end.
class Source {
public:
    explicit Source(std::string text) : text_(std::move(text)) {}
    std::vector<double> run(const Model& model, Counts& counts, std::uint32_t max_count) {
        std::vector<double> values;
        decode_run(
            model, counts, max_count, [this] { return text_.at(at++) == '1'; }, values);
        return values;
    }
    std::vector<double> run(const Model& model, std::uint32_t max_count) {
        Counts counts(model);
        return run(model, counts, max_count);
    }
    std::size_t at = 0;

private:
    std::string text_;
};

std::string message_of(const std::function<void()>& what) {
    try {
        what();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

// Bodies of messages that the reference library wrote: a run, then an 8-bit number.
struct Series {
    std::vector<double> values;
    unsigned end;
    const char* body;
};
class ReferenceSeries : public testing::TestWithParam<Series> {};

TEST_P(ReferenceSeries, CodesAndDecodes) {
    const Series& s = GetParam();
    Bits bits;
    bits.put(delta(), s.values, 8);
    const std::size_t run_bits = bits.text.size();
    bits.put_number(s.end, 8);
    EXPECT_EQ(bits.hex(), s.body);

    Source source(bits.text);
    EXPECT_EQ(source.run(delta(), 8), s.values);
    EXPECT_EQ(source.at, run_bits);
}

INSTANTIATE_TEST_SUITE_P(
    , ReferenceSeries,
    testing::Values(Series{{0, 0, 0, 1, 0, -1, 0, 0}, 200, "e9800c"}, Series{{}, 5, "a000"},
                    Series{{-3, 3, -3, 3, -3, 3, -3, 3}, 255, "f0d4b27045984fff"},
                    Series{{0}, 1, "e200"}, Series{{2, 1, 0}, 9, "df6f02"},
                    Series{{-1, 0, 0, 0, 0}, 149, "0c5609"},
                    Series{{2, -2, 0, 0, 2, 3, 3, 2}, 1, "cf778db70e00"},
                    Series{{0, -1, 0, 0, 2}, 198, "8658c6"}, Series{{-1, -1, 0}, 44, "04c102"},
                    Series{{2, -1, 0, 0, 0}, 36, "2f1f24"}, Series{{0, -3}, 224, "323038"}));

TEST(EntropyRun, NoValuesAreFiveZeros) {  // EOF is [0, 4/118) of the interval: below 1/32
    Bits bits;
    bits.put(delta(), {}, 8);
    EXPECT_EQ(bits.text, "00000");
}

TEST(EntropyRun, OneValueTakesNoEof) {
    struct {
        double weather, level, level_back;
        unsigned end;
        const char* body;
    } const cases[] = {{0, 0.5, 0.5, 1, "7200"},
                       {3, 5, 5, 254, "fffd01"},
                       {2, 1.9, 2, 77, "bb26"},
                       {1, 0, 0, 0, "4500"},
                       {0, 2.2, 2, 128, "0e10"}};
    for (const auto& c : cases) {
        Bits bits;
        bits.put(weather(), {c.weather}, 1);
        bits.put(level(), {c.level}, 1);
        const std::size_t run_bits = bits.text.size();
        bits.put_number(c.end, 8);
        EXPECT_EQ(bits.hex(), c.body);
        Source source(bits.text);
        EXPECT_EQ(source.run(weather(), 1), std::vector<double>{c.weather});
        EXPECT_EQ(source.run(level(), 1), std::vector<double>{c.level_back});
        EXPECT_EQ(source.at, run_bits);
    }
}

TEST(EntropyRun, AdaptiveModelLearnsInBothDirections) {
    struct {
        std::vector<double> values;
        unsigned end;
        const char* body;
    } const steps[] = {{{0, 0, 0, 1, 0}, 3, "c20c"},
                       {{0, 0}, 4, "6402"},
                       {{}, 5, "28"},
                       {{0, 0, 3, 2, 0}, 6, "2968"},
                       {{0, 0, 0, 0, 0}, 7, "ea01"}};
    Counts encoder(adaptive());
    Counts decoder(adaptive());
    for (const auto& step : steps) {
        Bits bits;
        bits.put(adaptive(), encoder, step.values, 5);
        bits.put_number(step.end, 4);
        EXPECT_EQ(bits.hex(), step.body);
        EXPECT_EQ(Source(bits.text).run(adaptive(), decoder, 5), step.values);
    }
}

TEST(EntropyRun, LenientOutOfRangeEndsTheRunForTheDecoderAlone) {
    Model model = delta();
    model.out_of_range_frequency = 0;
    Bits bits;
    bits.put(model, {0, 1, 9, 2}, 8, true);
    bits.put_number(77, 8);
    EXPECT_EQ(bits.hex(), "950d6a02");  // what the reference writes
    EXPECT_EQ(Source(bits.text).run(model, 8), (std::vector<double>{0, 1}));
}

TEST(EntropyRun, OutOfRangeIsRefusedWithoutItsSymbol) {
    Model model = delta();
    model.out_of_range_frequency = 0;
    Bits bits;
    EXPECT_EQ(message_of([&] { bits.put(model, {9}, 8); }),
              "'9' is outside -3 to 3 of arithmetic model 'delta'");
}

TEST(EntropyRun, OutOfRangeComesBackAsNaN) {
    Bits bits;
    bits.put(delta(), {0, 9, 2}, 8);
    const std::vector<double> back = Source(bits.text).run(delta(), 8);
    ASSERT_EQ(back.size(), 3U);
    EXPECT_EQ(back[0], 0);
    EXPECT_TRUE(std::isnan(back[1]));
    EXPECT_EQ(back[2], 2);
}

TEST(EntropyRun, WithoutEofOnlyFullRunsCanBeCoded) {
    Model model = weather();
    model.eof_frequency = 0;
    Bits bits;
    bits.put(model, {1, 2}, 2);
    EXPECT_EQ(Source(bits.text).run(model, 2), (std::vector<double>{1, 2}));
    EXPECT_EQ(message_of([&] { bits.put(model, {1}, 2); }),
              "too few values, and arithmetic model 'wx' has eof_frequency 0");
    EXPECT_THROW(bits.put(model, {7, 1}, 2, true), DataError);
}

TEST(EntropyRun, UnsetSingleValueIsNoValues) {
    Bits bits;
    bits.put(weather(), {}, 1);
    EXPECT_TRUE(Source(bits.text).run(weather(), 1).empty());
}

TEST(EntropyRun, SurplusValuesAreLeftOut) {
    Bits all;
    all.put(weather(), {1, 2, 3}, 2);
    Bits two;
    two.put(weather(), {1, 2}, 2);
    EXPECT_EQ(all.text, two.text);
}

TEST(EntropyRun, ACertainValueTakesNoBits) {
    const Model model{"one", {1}, 0, 0, {7, 8}, false};
    Bits bits;
    bits.put(model, {7, 7, 7}, 3);
    EXPECT_EQ(bits.text, "");
    EXPECT_EQ(Source("").run(model, 3), (std::vector<double>{7, 7, 7}));
}

TEST(EntropyRun, EndOfBitsIsTheSourcesToReport) {
    EXPECT_THROW(Source("1").run(delta(), 8), std::out_of_range);
}

TEST(EntropySymbol, IsTheNeighbourWithTheNearerSquare) {
    // 1.9 between 1 and 2: 3.61 - 1 = 2.61, 4 - 3.61 = 0.39
    EXPECT_EQ(symbol_of(level(), 1.9), first_value_symbol + 3);
    // squares 4 and 25: 14.5 in the middle, 3.8079 its root
    EXPECT_EQ(symbol_of(level(), 3.80), first_value_symbol + 3);
    EXPECT_EQ(symbol_of(level(), 3.81), first_value_symbol + 4);
    EXPECT_EQ(symbol_of(level(), 0), first_value_symbol);
    // -1 and 1 are equally far: the upper one
    const Model mirror{"mirror", {1, 1}, 1, 0, {-1, 1, 2}, false};
    EXPECT_EQ(symbol_of(mirror, -1), first_value_symbol + 1);
}

TEST(EntropySymbol, OutOfRange) {
    for (const double v : {-0.1, 10.0, 11.0, 9.9, HUGE_VAL, -HUGE_VAL, 1e308}) {
        EXPECT_EQ(symbol_of(level(), v), out_of_range_symbol) << v;
    }
    // squares 25 and 100: 62.5 in the middle, 7.9057 its root
    EXPECT_EQ(symbol_of(level(), 7.90), first_value_symbol + 4);
    EXPECT_EQ(symbol_of(level(), 7.91), out_of_range_symbol);
    EXPECT_THROW(symbol_of(level(), std::nan("")), DataError);
}

TEST(EntropyBits, AreThoseOfTheReference) {
    EXPECT_EQ(min_bits(delta(), 8), 5U);
    EXPECT_EQ(max_bits(delta(), 8), 57U);
    EXPECT_EQ(min_bits(weather(), 1), 2U);
    EXPECT_EQ(max_bits(weather(), 1), 8U);
    EXPECT_EQ(min_bits(level(), 1), 2U);
    EXPECT_EQ(max_bits(level(), 1), 8U);
    EXPECT_EQ(min_bits(adaptive(), 5), 0U);
    EXPECT_EQ(max_bits(adaptive(), 5), 13U);
}

TEST(EntropyModel, WhatIsRefused) {
    const auto refusal = [](auto&& change) {
        Model model = delta();
        change(model);
        return message_of([&] { check(model); });
    };
    EXPECT_EQ(refusal([](Model&) {}), "no error");
    EXPECT_EQ(refusal([](Model& m) { m.name.clear(); }), "an arithmetic model has no name");
    EXPECT_EQ(refusal([](Model& m) { m.frequency.clear(); }),
              "arithmetic model 'delta': no frequency");
    EXPECT_EQ(refusal([](Model& m) { m.frequency[2] = 0; }),
              "arithmetic model 'delta': frequency 2 is 0");
    EXPECT_EQ(refusal([](Model& m) { m.value_bound.pop_back(); }),
              "arithmetic model 'delta': 7 bounds for 7 frequencies, where there must be 8");
    EXPECT_EQ(refusal([](Model& m) { m.value_bound[3] = -1; }),
              "arithmetic model 'delta': bound '-1' does not exceed '-1' before it");
    EXPECT_EQ(refusal([](Model& m) { m.value_bound[7] = HUGE_VAL; }),
              "arithmetic model 'delta': bound 'inf' is not finite");
    EXPECT_EQ(refusal([](Model& m) { m.eof_frequency = max_total_frequency - 114 + 1; }),
              "arithmetic model 'delta': frequencies sum to 1073741824, above 1073741823");
    EXPECT_EQ(refusal([](Model& m) { m.eof_frequency = max_total_frequency - 114; }), "no error");
    EXPECT_EQ(refusal([](Model& m) { m.frequency[0] = m.frequency[1] = 0xFFFFFFFF; }),
              "arithmetic model 'delta': frequencies sum to 8589934702, above 1073741823");
}

TEST(EntropyCounts, FindIsTheInverseOfPart) {
    const Model model{"gaps", {3, 1, 1, 7}, 0, 0, {0, 1, 2, 3, 4}, false};
    const Counts counts(model);
    EXPECT_EQ(counts.total(), 12U);
    for (std::uint32_t c = 0; c < 12; ++c) {
        const Counts::Part part = counts.part(counts.find(c));
        EXPECT_LE(part.below, c);
        EXPECT_LT(c, part.below + part.weight);
    }
}

TEST(EntropyCounts, FullAdaptiveModelStopsLearning) {
    const Model model{"full", {max_total_frequency - 2, 1}, 1, 0, {0, 1, 2}, true};
    check(model);
    Counts counts(model);
    counts.saw(first_value_symbol);
    EXPECT_EQ(counts.total(), max_total_frequency);
}

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    /// 0 to n - 1.
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }

private:
    std::mt19937 engine_;
};

Model random_model(Random& random) {
    Model model{"random", {}, random.below(3), random.below(3), {}, random.below(2) == 0};
    const std::uint32_t limits[] = {1, 2, 100, 1U << 20};
    const std::uint32_t limit = limits[random.below(4)];
    const std::uint32_t symbols = 1 + random.below(40);
    for (std::size_t k = 0; k <= symbols; ++k) model.value_bound.push_back(static_cast<double>(k));
    for (std::size_t k = 0; k < symbols; ++k) model.frequency.push_back(1 + random.below(limit));
    if (random.below(4) == 0) {
        const std::uint64_t rest = max_total_frequency - model.total_frequency();
        model.frequency[random.below(symbols)] += static_cast<std::uint32_t>(rest);
    }
    return model;
}

void runs_come_back(Random& random) {
    const Model model = random_model(random);
    check(model);
    const auto symbols = static_cast<std::uint32_t>(model.frequency.size());
    Counts encoder(model);
    Counts decoder(model);
    for (int message = 0; message < 5; ++message) {
        const std::uint32_t max_count = 1 + random.below(60);
        std::vector<double> values(model.eof_frequency > 0 ? random.below(max_count + 1)
                                                           : max_count);
        for (double& v : values) {
            v = static_cast<double>(random.below(symbols));
            if (model.out_of_range_frequency > 0 && random.below(20) == 0) v = -1;
        }
        Bits bits;
        bits.put(model, encoder, values, max_count);
        const std::size_t run_bits = bits.text.size();
        if (!model.is_adaptive) {
            EXPECT_LE(run_bits, max_bits(model, max_count) + 1);
            EXPECT_LE(min_bits(model, max_count), run_bits + 1);
        }
        for (int k = 0; k < 40; ++k) bits.put_number(random.below(2), 1);
        Source source(bits.text);
        std::vector<double> back = source.run(model, decoder, max_count);
        EXPECT_EQ(source.at, run_bits);
        for (double& v : back) v = std::isnan(v) ? -1 : v;
        EXPECT_EQ(back, values);
    }
}

/// The law, for any model: what is decoded is what was coded, from as many bits as were written.
TEST(EntropyRun, RandomRunsComeBackFromTheirOwnBits) {
    for (unsigned seed = 1; seed <= 2000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        runs_come_back(random);
    }
}

// A decoder knows how many bits its symbols took, if they end behind the last one read.
TEST(EntropyCoder, ADecoderKnowsWhatAnEndWouldTake) {
    std::mt19937 random(3);
    for (int run = 0; run < 200; ++run) {
        BitString bits;
        Encoder out(bits);
        std::vector<std::pair<bool, std::uint32_t>> symbols;
        std::vector<std::size_t> ended{out.ending_bits()};
        for (int n = 0; n < 60; ++n) {
            const std::uint32_t one =
                n % 7 == 0 ? 32768U : static_cast<std::uint32_t>(1 + random() % 65535);
            symbols.emplace_back(random() % 65536 < one, one);
            out.bit(symbols.back().first, one);
            ended.push_back(bits.size() + out.ending_bits());
        }
        out.finish();
        BitReader reader(bits.bytes(), bits.size());
        Decoder in(reader);
        EXPECT_EQ(in.ended_bits(), ended[0]);
        for (std::size_t n = 0; n < symbols.size(); ++n) {
            ASSERT_EQ(in.bit(symbols[n].second), symbols[n].first);
            ASSERT_EQ(in.ended_bits(), ended[n + 1]);
        }
        EXPECT_EQ(ended.back(), bits.size());
    }
}

}  // namespace
}  // namespace seautils::entropy
