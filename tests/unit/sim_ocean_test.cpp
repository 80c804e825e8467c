// The water between modems: who hears what, when, and why not.
#include "seautils/sim/water.hpp"
#include "sim_rig.hpp"

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace seautils::sim {
namespace {

constexpr std::size_t one = 0, two = 1, three = 2;

std::string node(const std::string& name, unsigned id, double x_m) {
    return "[node " + name + "]\nid = " + std::to_string(id) +
           "\ny_m = 0\nx_m = " + std::to_string(x_m) + "\n";
}

std::string row(const std::vector<double>& x_m, const std::string& water = "") {
    std::string text = "[water]\n" + water + "\n[nodes]\nnvram = CST:1, RXP:1\n";
    unsigned id = 0;
    for (const double x : x_m) {
        ++id;
        text += node("m" + std::to_string(id), id, x);
    }
    return text;
}

/// The fate of the latest packet at the receiver with an address.
Outcome fate(const Rig& rig, unsigned receiver) {
    for (auto t = rig.truths.rbegin(); t != rig.truths.rend(); ++t)
        if (t->receiver == receiver) return t->outcome;
    ADD_FAILURE() << "nothing came to " << receiver;
    return Outcome::lost;
}

}  // namespace

TEST(SimOcean, SoundTakesItsTime) {
    Rig rig(row({0, 3000}, "sound_speed_mps = 1500"));
    rig.boot();
    const Time sent = rig.now;
    rig.say(one, "CCMUC,1,2,0001");
    rig.run(5);
    ASSERT_EQ(rig.truths.size(), 1U);
    const Truth& t = rig.truths[0];
    EXPECT_EQ(t.sent, sent);
    EXPECT_EQ(*t.heard, sent + 2 * second_ns);
    EXPECT_EQ(t.air, nanoseconds(0.9));
    EXPECT_EQ(t.range_m, 3000);
    EXPECT_EQ(t.outcome, Outcome::received);
    EXPECT_EQ(t.kind, PacketKind::mini);
    EXPECT_FALSE(t.tl_db.has_value());
    // the modem tells after its last sound, as fast as its line is: 24 bytes at 19200 baud
    const auto& line = rig.said[two].at(1);
    EXPECT_EQ(line.text.substr(0, 17), "$CAMUA,1,2,0001*7");
    EXPECT_EQ(line.time, sent + nanoseconds(2.9) + 20 * 10 * second_ns / 19200);
}

TEST(SimOcean, AMovingReceiverIsMetWhereItIs) {
    const std::string csv = "time_s,x_m,y_m\n0,1500,0\n1000,4500,0\n";  // leaves with 3 m/s
    Rig rig(
        "[nodes]\nnvram = CST:1\n[node a]\nid = 1\nx_m = 0\ny_m = 0\n[node b]\nid = 2\ntrack = "
        "t.csv\n",
        [&](const std::string&) { return csv; });
    rig.run(1);
    rig.say(one, "CCMUC,1,2,0001");
    rig.run(5);
    // 1503 + 3 t = 1500 t
    const double t = 1503.0 / (1500 - 3);
    EXPECT_NEAR(seconds(*rig.truths.at(0).heard - rig.truths[0].sent), t, 1e-6);
    EXPECT_NEAR(rig.truths[0].range_m, 1500 * t, 1e-3);
    EXPECT_NE(rig.first(two, "$CACST").find(",-3.0,41,"), std::string::npos) << "it opens";
}

TEST(SimOcean, OverlapIsACollision) {
    // 1 and 3 are equally far from 2: whoever begins within 0.9 s of the other spoils both
    for (const double apart_s : {0.0, 0.5, 0.8999, 0.9, 1.5}) {
        Rig rig(row({0, 750, 1500}));
        rig.boot();
        rig.say(one, "CCMUC,1,2,0001");
        rig.run(apart_s);
        rig.say(three, "CCMUC,3,2,0003");
        rig.run(5);
        const bool overlap = apart_s < 0.9;
        EXPECT_EQ(rig.count(two, "$CAMUA"), overlap ? 0U : 2U) << apart_s;
        EXPECT_EQ(rig.count(two, "$CARXP"), overlap ? 1U : 2U) << "the second is not noticed";
        if (!overlap) continue;
        EXPECT_EQ(rig.heard(two), (Lines{"CARXP,0", "CACST"}));
        EXPECT_EQ(rig.said[two][1].text.substr(0, 10), "$CACST,6,2") << "a timeout";
        EXPECT_EQ(fate(rig, 2), Outcome::collision);
    }
}

TEST(SimOcean, OverlapIsWhereItIsHeard) {
    // Sent at once, but 1500 m apart: at 1 and 4 the packets come one after the other.
    Rig rig(row({0, 100, 2900, 3000}));
    rig.boot();
    rig.say(two, "CCMUC,2,0,0002");
    rig.say(three, "CCMUC,3,0,0003");
    rig.run(5);
    EXPECT_EQ(rig.count(0, "$CAMUA"), 2U);
    EXPECT_EQ(rig.count(3, "$CAMUA"), 2U);
}

TEST(SimOcean, WhoSpeaksHearsNothing) {
    Rig rig(row({0, 1500}));
    rig.boot();
    rig.say(one, "CCMUC,1,2,0001");
    rig.run(0.5);
    rig.say(two, "CCMUC,2,1,0002");  // speaks from 0.5 to 1.4; 1's packet comes at 1.0
    rig.run(5);
    EXPECT_EQ(fate(rig, 2), Outcome::half_duplex);
    EXPECT_EQ(rig.count(two, "$CARXP"), 0U);
    EXPECT_EQ(rig.count(one, "$CAMUA"), 1U) << "1 has ended by 1.5";
}

TEST(SimOcean, WhoBeginsToSpeakLosesWhatWasComing) {
    Rig rig(row({0, 150}));
    rig.boot();
    rig.say(one, "CCMUC,1,2,0001");
    rig.run(0.5);
    rig.say(two, "CCMUC,2,1,0002");
    rig.run(5);
    EXPECT_EQ(fate(rig, 2), Outcome::half_duplex);
    EXPECT_EQ(fate(rig, 1), Outcome::half_duplex);
    EXPECT_EQ(rig.heard(two), (Lines{"CARXP,0", "CAMUC,2,1,0002", "CATXP,0", "CATXF,0", "CAXST"}));
}

TEST(SimOcean, BeyondTheLimitItIsSilent) {
    Rig rig(row({0, 900, 1800}, "max_range_m = 1000"));
    rig.boot();
    rig.say(one, "CCMUC,1,0,0001");
    rig.say(three, "CCMUC,3,0,0003");  // out of 1's reach: collides at 2 alone
    rig.run(5);
    EXPECT_EQ(fate(rig, 2), Outcome::collision);
    EXPECT_EQ(fate(rig, 3), Outcome::out_of_range);
    EXPECT_EQ(fate(rig, 1), Outcome::out_of_range);
    EXPECT_TRUE(rig.said[one].size() < 5);
}

TEST(SimOcean, ATableOfTransmissionLossDecidesByRate) {
    // 185 - 107 - 75 = 3 dB at 1000 m: enough for rate 0 (3 dB), not for rate 1 (4 dB)
    const std::string csv = "range_m,tl_db\n0,0\n1000,107\n";
    Rig rig(row({0, 1000}, "transmission_loss = tl.csv"), [&](const std::string&) { return csv; });
    rig.boot();
    rig.say(one, "CCMUC,1,2,0001");
    rig.run(3);
    EXPECT_EQ(fate(rig, 2), Outcome::received);
    EXPECT_EQ(*rig.truths.at(0).tl_db, 107);
    EXPECT_NE(rig.first(two, "$CACST").find(",0078,10,00"), std::string::npos) << "185 - 107 dB";
    rig.say(one, "CCCYC,0,1,2,1,0,1");
    rig.run(1);
    rig.say(one, "CCTXD,1,2,0,01");
    rig.run(10);
    EXPECT_EQ(fate(rig, 2), Outcome::out_of_range);
}

TEST(SimOcean, LossAndBadChecksumsHappenAsOftenAsTheyAreSaidTo) {
    WaterSpec spec;
    spec.loss = 0.1;
    spec.loss_by_range = Curve({{0, 0}, {1000, 0.5}});
    spec.bad_crc = 0.25;
    const Water water(spec, 42);
    constexpr int n = 100'000;
    int lost = 0, lost_far = 0, spoilt = 0;
    for (std::uint64_t k = 0; k < n; ++k) {
        lost += water.is_lost(0, 0, k, 1);
        lost_far += water.is_lost(1000, 0, k, 1);
        spoilt += water.is_spoilt(0, k, 1, 0);
    }
    const auto within = [](int count, double p) {  // five standard deviations
        return std::abs(count - n * p) < 5 * std::sqrt(n * p * (1 - p));
    };
    EXPECT_TRUE(within(lost, 0.1)) << lost;
    EXPECT_TRUE(within(lost_far, 1 - 0.9 * 0.5)) << lost_far;
    EXPECT_TRUE(within(spoilt, 0.25)) << spoilt;
}

TEST(SimOcean, ChanceIsTheSameOnEveryMachine) {
    // SplitMix64 from state 0 begins with e220a8397b1dcdaf (published test vector).
    EXPECT_EQ(Chance(0).bits({}), 0xe220a8397b1dcdafU);
    EXPECT_NE(Chance(0).bits({1, 2}), Chance(0).bits({2, 1}));
    EXPECT_FALSE(Chance(0).happens(0, {1}));
    EXPECT_TRUE(Chance(0).happens(1, {1}));
}

RC_GTEST_PROP(SimOcean, WhatHappensElsewhereDoesNotChangeIt, ()) {
    // The fates of 1's packets at 2 are the same whether 3, out of reach of both, speaks or not.
    const auto seed = *rc::gen::inRange(0, 1000);
    const auto fates = [&](bool others) {
        Rig rig(row({0, 1000, 90'000},
                    "loss = 0.4\nmax_range_m = 5000\nseed = " + std::to_string(seed)));
        rig.boot();
        std::vector<Outcome> all;
        for (int k = 0; k < 20; ++k) {
            if (others) rig.say(three, "CCMUC,3,2,0003");
            rig.run(0.1);
            rig.say(one, "CCMUC,1,2,0001");
            rig.run(3);
            all.push_back(fate(rig, 2));
        }
        return all;
    };
    const std::vector<Outcome> alone = fates(false);
    const std::vector<Outcome> beside = fates(true);
    RC_ASSERT(alone == beside);
}

TEST(SimOcean, TheSameSeedGivesTheSameDay) {
    const auto day = [](unsigned seed) {
        Rig rig(row({0, 700, 1500}, "loss = 0.3\nbad_crc = 0.3\nseed = " + std::to_string(seed)));
        rig.boot();
        for (int k = 0; k < 50; ++k) {
            rig.say(static_cast<std::size_t>(k % 3),
                    "CCMPC," + std::to_string(k % 3 + 1) + "," + std::to_string((k + 1) % 3 + 1));
            rig.run(1.7);
        }
        std::string all;
        for (const auto& lines : rig.said)
            for (const auto& line : lines) all += std::to_string(line.time) + line.text + "\n";
        for (const Truth& t : rig.truths) all += std::to_string(static_cast<int>(t.outcome));
        return all;
    };
    EXPECT_EQ(day(1), day(1));
    EXPECT_NE(day(1), day(2));
}

TEST(SimOcean, ADeafModemHearsNothing) {
    Rig rig(row({0, 1500}) + "reboot_s = 3\n");
    rig.boot();
    rig.run(0.5);
    rig.say(one, "CCMUC,1,2,0001");  // comes to 2 at 3.5, which boots until 4
    rig.run(5);
    EXPECT_EQ(fate(rig, 2), Outcome::deaf);
    EXPECT_EQ(rig.count(two, "$CAMUA"), 0U);
}

TEST(SimOcean, ClocksDrift) {
    Rig rig("[nodes]\nnvram = CST:1\npps = no\n" + node("a", 1, 0) + node("b", 2, 0) +
            "clock_offset_s = 0.5\nclock_drift_ppm = 100\n");
    rig.run(10'000);  // 1 s fast, and the half
    rig.clear();
    rig.say(two, "CCTMQ,0");
    rig.run(1);
    EXPECT_EQ(rig.heard(two), (Lines{"CATMQ,2024-05-01T23:31:42Z,RTC,RTC"}));
    rig.clear();
    rig.say(one, "CCMUC,1,2,0001");  // at 23:31:41.0, heard at 42.5 of its clock
    rig.run(2);
    EXPECT_EQ(rig.first(two, "$CACST").substr(0, 30), "$CACST,6,0,20240501233142.5001");
}

}  // namespace seautils::sim
