// What a track costs in a codec, with one whose bits are known.
#include "seautils/position/cost.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace seautils::position {
namespace {

/// Alone a step of x takes 3 bits; in an arithmetic coder 2 and the ending. -2 to 1 can be coded.
class Steps : public Codec {
public:
    explicit Steps(std::int32_t wrong = 0) : wrong_(wrong) {}
    std::unique_ptr<Codec> clone() const override { return std::make_unique<Steps>(*this); }
    void restart(const Cell& cell) override { last_ = cell; }
    bool can_encode(const Cell& next) const override {
        return next.x - last_.x >= -2 && next.x - last_.x <= 1;
    }
    void encode(const Cell& next, entropy::Encoder& out) override {
        out.symbol({static_cast<std::uint32_t>(next.x - last_.x + 2), 1}, 4);
        last_ = next;
    }
    std::optional<Cell> decode(entropy::Decoder& in) override {
        const auto part = in.symbol(4, [](std::uint32_t at) {
            return entropy::Counts::Part{at, 1};
        });
        return step(static_cast<std::int32_t>(part.below));
    }
    void encode_alone(const Cell& next, entropy::BitString& out) override {
        out.put(static_cast<std::uint64_t>(next.x - last_.x + 2), 3);
        last_ = next;
    }
    std::optional<Cell> decode_alone(entropy::BitReader& in) override {
        return step(static_cast<std::int32_t>(in.get(3)));
    }
    void learn(const Cell& next) override { last_ = next; }
    std::string save() const override { return {}; }
    void load(std::string_view) override {}

private:
    Cell step(std::int32_t symbol) {
        last_.x += symbol - 2 + wrong_;
        return last_;
    }

    Cell last_;
    std::int32_t wrong_;
};

std::vector<Sample> track(std::initializer_list<std::int32_t> x) {
    std::vector<Sample> samples;
    for (const std::int32_t at : x) samples.push_back({0, {at, 0, 0}, samples.empty()});
    return samples;
}

Cost cost(const std::vector<Sample>& samples, std::uint32_t deltas_per_packet,
          std::int32_t wrong = 0) {
    CostMeter meter(std::make_unique<Steps>(), Grid{}, deltas_per_packet);
    CostCheck check(std::make_unique<Steps>(wrong), deltas_per_packet);
    std::vector<CodedPositions> packets;
    for (const Sample& sample : samples) meter.add(sample, packets);
    meter.finish(packets);
    for (const CodedPositions& packet : packets) check.check(packet);
    return meter.cost();
}

TEST(Cost, positions_alone_take_their_whole_bits) {
    const Cost all = cost(track({5, 6, 7, 5, 4}), 1);
    EXPECT_EQ(all.deltas, 4U);
    EXPECT_EQ(all.fulls, 1U);
    EXPECT_EQ(all.delta_bits, 12U);
    EXPECT_EQ(all.full_bits, 60U);
    EXPECT_EQ(all.bits_total(), 72U);
    EXPECT_EQ(all.bits_per_delta(), 3);
    EXPECT_EQ(all.deltas_by_bits, (std::vector<std::uint64_t>{0, 0, 0, 4}));
}

TEST(Cost, a_gap_and_a_position_without_a_code_are_full_and_end_a_packet) {
    auto samples = track({5, 6, 7, 50, 51, 52, 53});
    samples[5].starts = true;
    const Cost all = cost(samples, 3);
    EXPECT_EQ(all.fulls, 3U);
    EXPECT_EQ(all.deltas, 4U);
    // Packets of 2, 1 and 1 deltas. An interval of the 4^-n-th part that is aligned has an ending of
    // 0 bits beside its 2n (eq 3.31), or of 1 where it must not run into what follows.
    EXPECT_GE(all.delta_bits, 8U);
    EXPECT_LE(all.delta_bits, 11U);
}

TEST(Cost, what_is_decoded_wrongly_is_said) {
    EXPECT_THROW(cost(track({5, 6, 7}), 1, 1), std::logic_error);
    EXPECT_THROW(cost(track({5, 6, 7}), 2, 1), std::logic_error);
}

TEST(Cost, an_empty_track_costs_nothing) {
    EXPECT_EQ(cost({}, 1).bits_total(), 0U);
    EXPECT_EQ(cost({}, 8).bits_per_delta(), 0);
}

}  // namespace
}  // namespace seautils::position
