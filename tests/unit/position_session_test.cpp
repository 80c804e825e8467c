#include "position_link.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <deque>

namespace seautils::position {
namespace {

constexpr std::int64_t start_ms = 1'714'521'600'000, interval_ms = 10'000;

LinkOptions options_for(LinkMode mode, unsigned check_bits = 32) {
    LinkOptions options;
    options.mode = mode;
    options.check_bits = check_bits;
    return options;
}

/// Bytes that were under way are changed.
std::string damaged(std::string bytes, SplitMix64& random) {
    switch (random.below(3)) {
        case 0:
            bytes.resize(random.below(bytes.size() + 1));
            break;
        case 1:
            for (char& c : bytes) c = static_cast<char>(random.below(256));
            break;
        default:
            for (std::uint64_t k = 1 + random.below(3); k > 0 && !bytes.empty(); --k) {
                char& c = bytes[random.below(bytes.size())];
                c = static_cast<char>(c ^ (1 << random.below(8)));
            }
    }
    return bytes;
}

/// A way on which anything may happen: what is put in comes out late, twice, changed, or not.
class Water {
public:
    Water(SplitMix64& random, unsigned loss_percent, bool is_rough)
        : random_(&random), loss_(loss_percent), is_rough_(is_rough) {}

    void put(std::string bytes) {
        if (bytes.empty() || random_->below(100) < loss_) return;
        if (is_rough_ && random_->below(8) == 0) bytes = damaged(bytes, *random_);
        under_way_.push_back(bytes);
        if (is_rough_ && random_->below(6) == 0) old_.push_back(bytes);
        if (is_rough_ && !old_.empty() && random_->below(8) == 0)
            under_way_.push_back(old_[random_->below(old_.size())]);
    }
    template <class Take>
    void drain(Take take) {
        while (!under_way_.empty()) {
            if (is_rough_ && random_->below(4) == 0) break;  // late
            const std::size_t k = is_rough_ && random_->below(4) == 0
                                      ? static_cast<std::size_t>(random_->below(under_way_.size()))
                                      : 0;
            const std::string bytes = under_way_[k];
            under_way_.erase(under_way_.begin() + static_cast<std::ptrdiff_t>(k));
            take(bytes);
        }
    }

private:
    SplitMix64* random_;
    unsigned loss_;
    bool is_rough_;
    std::deque<std::string> under_way_;
    std::vector<std::string> old_;
};

struct Story {
    LinkMode mode = LinkMode::history;
    unsigned loss_percent = 0, ack_loss_percent = 0;
    bool is_rough = false, restarts = false, has_gaps = false;
    std::size_t max_bytes = 32;
    unsigned samples = 200;
};

/// What may go wrong at either end goes wrong now and then.
void restart_some(Link& link, SplitMix64& random) {
    const bool keeps = random.below(2) == 0;
    if (random.below(40) == 0) {
        const std::string state = link.sender.save();
        link.forget_sender();
        if (keeps) link.sender.load(state);
    }
    if (random.below(40) == 0) {
        const std::string state = link.receiver.save();
        link.forget_receiver();
        if (keeps) link.receiver.load(state);
    }
}

void play(Link& link, const Story& story, std::uint64_t seed) {
    Walk walk(seed);
    SplitMix64& random = walk.random();
    Water down(random, story.loss_percent, story.is_rough);
    Water up(random, story.ack_loss_percent, story.is_rough);
    std::int64_t time_ms = start_ms;
    for (unsigned n = 0; n < story.samples; ++n, time_ms += interval_ms) {
        if (story.has_gaps && random.below(20) == 0)
            time_ms += static_cast<std::int64_t>(random.below(100'000));
        Cell cell = walk.next();
        if (story.has_gaps && random.below(20) == 0)
            cell.x = -cell.x / 2 + 5000;  // cannot be coded
        link.sample({time_ms, cell});
        if (story.restarts) restart_some(link, random);
        if (const auto packet = link.sender.packet(story.max_bytes)) {
            ASSERT_LE(packet->bytes.size(), story.max_bytes);
            down.put(packet->bytes);
        }
        down.drain([&](const std::string& bytes) { up.put(link.deliver(bytes)); });
        up.drain([&](const std::string& bytes) { link.sender.acknowledge(bytes); });
    }
}

/// Until everything is there, on a fair link: at most so many packets.
void settle(Link& link, std::size_t max_bytes, unsigned most_packets) {
    for (unsigned n = 0; n < most_packets; ++n) {
        const auto packet = link.sender.packet(max_bytes);
        if (!packet) return;
        link.sender.acknowledge(link.deliver(packet->bytes));
    }
}

TEST(PositionSession, EverythingArrivesOnAPerfectLink) {
    for (const LinkMode mode : {LinkMode::history, LinkMode::newest, LinkMode::automatic}) {
        const LinkOptions options = options_for(mode);
        Link link(options);
        play(link, {mode}, 1);
        EXPECT_EQ(link.wrong, 0U);
        EXPECT_EQ(link.arrived.size(), link.sampled.size());
        EXPECT_EQ(link.sender.pending(), 0U);
    }
}

Story any_story() {
    Story story;
    story.mode = *rc::gen::element(LinkMode::history, LinkMode::newest, LinkMode::automatic);
    story.loss_percent = *rc::gen::inRange(0U, 95U);
    story.ack_loss_percent = *rc::gen::inRange(0U, 95U);
    story.is_rough = *rc::gen::arbitrary<bool>();
    story.has_gaps = *rc::gen::arbitrary<bool>();
    story.max_bytes = *rc::gen::element<std::size_t>(5, 8, 12, 16, 32, 64, 256);
    story.samples = *rc::gen::inRange(1U, 250U);
    return story;
}

RC_GTEST_PROP(PositionSession, WhatIsDecodedIsWhatWasSampled, ()) {
    Story story = any_story();
    story.restarts = *rc::gen::arbitrary<bool>();
    const LinkOptions options = options_for(story.mode);
    Link link(options);
    play(link, story, *rc::gen::arbitrary<std::uint64_t>());
    RC_ASSERT(link.wrong == 0U);
}

RC_GTEST_PROP(PositionSession, HistoryArrivesWholeAndOnce, ()) {
    Story story = any_story();
    story.mode = LinkMode::history;
    story.max_bytes = std::max(story.max_bytes, least_bytes(options_for(story.mode)));
    const LinkOptions options = options_for(story.mode);
    Link link(options);
    play(link, story, *rc::gen::arbitrary<std::uint64_t>());
    settle(link, story.max_bytes, 4 * story.samples + 40);
    RC_ASSERT(link.sender.pending() == 0U);
    RC_ASSERT(link.arrived.size() == link.sampled.size());
    if (!story.is_rough)
        for (const auto& [time_ms, times] : link.arrived) RC_ASSERT(times == 1U);
}

/// The receiver forgets, with or without the sender: the link mends itself, and what is sampled
/// from then on arrives.
RC_GTEST_PROP(PositionSession, ALinkMendsAfterRestarts, ()) {
    Story story = any_story();
    story.mode = LinkMode::history;
    story.restarts = true;
    story.max_bytes = std::max(story.max_bytes, least_bytes(options_for(story.mode)));
    const LinkOptions options = options_for(story.mode);
    Link link(options);
    play(link, story, *rc::gen::arbitrary<std::uint64_t>());
    Walk walk(7);
    const std::int64_t from = link.sampled.rbegin()->first + 5 * interval_ms;
    for (int n = 0; n < 10; ++n) link.sample({from + n * interval_ms, walk.next()});
    settle(link, story.max_bytes, 4 * story.samples + 80);
    RC_ASSERT(link.sender.pending() == 0U);
    for (int n = 0; n < 10; ++n) RC_ASSERT(link.arrived.count(from + n * interval_ms) == 1U);
    RC_ASSERT(link.wrong == 0U);
}

/// Each packet that arrives brings the newest position, whatever became of those before.
RC_GTEST_PROP(PositionSession, TheNewestPositionWaitsForNothing, ()) {
    const LinkMode mode =
        *rc::gen::element(LinkMode::history, LinkMode::newest, LinkMode::automatic);
    const auto loss = *rc::gen::inRange(0U, 95U);
    const LinkOptions options = options_for(mode, 16);
    Link link(options);
    Walk walk(*rc::gen::arbitrary<std::uint64_t>());
    for (int n = 0; n < 150; ++n) {
        const Fix fix{start_ms + n * interval_ms, walk.next()};
        link.sample(fix);
        const auto packet = link.sender.packet(32);
        RC_ASSERT(packet.has_value());
        RC_ASSERT(packet->newest == fix);
        if (walk.random().below(100) < loss) continue;
        const std::string ack = link.deliver(packet->bytes);
        RC_ASSERT(link.arrived.count(fix.time_ms) == 1U);
        if (walk.random().below(100) >= loss) link.sender.acknowledge(ack);
    }
}

/// Without a check nothing but the numbers tells references apart: they are enough while packets
/// keep their order.
RC_GTEST_PROP(PositionSession, ReferencesAreNeverAmbiguous, ()) {
    const LinkMode mode = *rc::gen::element(LinkMode::history, LinkMode::newest);
    const auto loss = *rc::gen::inRange(0U, 95U);
    const auto ack_loss = *rc::gen::inRange(0U, 95U);
    const auto max_bytes = *rc::gen::element<std::size_t>(6, 12, 40);
    const LinkOptions options = options_for(mode, 0);
    Link link(options);
    Walk walk(*rc::gen::arbitrary<std::uint64_t>());
    std::deque<std::string> acks;
    for (int n = 0; n < 150; ++n) {
        link.sample({start_ms + n * interval_ms, walk.next()});
        const auto packet = link.sender.packet(max_bytes + (n < 3 ? 20 : 0));
        if (!packet) continue;
        for (std::uint64_t copies = walk.random().below(100) < loss ? 0
                                                                    : 1 + walk.random().below(2);
             copies > 0; --copies) {
            acks.push_back(link.deliver(packet->bytes));
            RC_ASSERT(link.last.outcome != Arrival::Outcome::undecodable);
        }
        while (!acks.empty() && walk.random().below(3) > 0) {
            if (walk.random().below(100) >= ack_loss) link.sender.acknowledge(acks.front());
            acks.pop_front();
        }
    }
    RC_ASSERT(link.wrong == 0U);
}

}  // namespace
}  // namespace seautils::position
