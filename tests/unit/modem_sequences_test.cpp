// The sequences of specs/micromodem.md §4, line by line: what a Micro-Modem says, what is said to it,
// and what is told of that.
#include "modem_rig.hpp"

namespace seautils::modem {
namespace {

const std::string fives(32, '5');
const std::string fives_hex = hex(fives);
const std::string good_stats =
    "CACST,6,0,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,0,1,2,0,1,1,0,150,20,15,10,-9,200,"
    "0.1,5,25000,4000";
const std::string mini_stats =
    "CACST,6,0,20240501120009.1234,0,1000,40,200,150,1,2,3,4,5,0,1,2,0,2,1,0,150,20,15,10,-9,200,"
    "0.1,5,25000,4000";
const std::string sent_mini = "CAXST,6,20240501,120001.0000,0,0,200,4000,25000,0,1,2,1,1,1,2,4";
const std::string sent_data = "CAXST,6,20240501,120003.0000,0,0,200,4000,25000,0,1,2,1,1,1,1,32";

std::string sent_psk(int rate, int frames) {
    return "CAXST,6,20240501,120003.0000,0,0,200,5000,25000," + std::to_string(rate) + ",1,2,1," +
           std::to_string(frames) + "," + std::to_string(frames) + ",3,512";
}

}  // namespace

TEST(ModemSequences, UnicastAtRate0WithAcknowledgement) {  // Figure 2.14, the sender
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, 0, true, {fives}));
    EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,1,2,0,1,1"}));
    rig.says_all({"CACYC,0,1,2,0,1,1", "CATXP,4"});
    rig.pass(0.9);
    rig.says_all({"CATXF,4", sent_mini});
    EXPECT_EQ(rig.told(), Lines{});
    rig.says("CADRQ,204511,1,2,1,32,1");
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,1," + fives_hex}));
    rig.says_all({"CATXD,1,2,1," + fives_hex, "CATXP,32"});
    rig.pass(3.2);
    rig.says("CATXF,32");
    EXPECT_EQ(rig.told(), Lines{});
    rig.says(sent_data);
    const auto records = rig.records();
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(brief(records[0]), "result #7 SENT stats 2");
    EXPECT_NEAR(records[0].as<record::Result>()->air_time_s.value(), 4.1, 1e-6);
    rig.says_all({"CARXP,1", "CAACK,2,1,1,1", mini_stats});
    EXPECT_EQ(rig.told(), (Lines{"ack 2>1 #7 [0]"}));
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemSequences, UnicastAtRate0Received) {  // Figure 2.14, the receiver; pitfall 16
    Options options;
    options.id = 2;
    Rig rig(options);
    rig.start();
    rig.says_all({"CARXP,1", "CACYC,0,1,2,0,1,1", mini_stats, "CARXP,1"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 1>2"}));
    rig.pass(3.2);
    rig.says("CARXD,1,2,1,1," + fives_hex);
    EXPECT_EQ(rig.told(), Lines{});
    rig.says(good_stats);
    const auto records = rig.records();
    ASSERT_EQ(records.size(), 1U);
    EXPECT_EQ(brief(records[0]), "reception 1>2 r0 [" + fives_hex + "] ack stats 2");
    EXPECT_EQ(records[0].time.ns, parse_utc_ns("2024-05-01T12:00:10.1234Z"));
    rig.says_all({"CATXP,4", "CATXF,4", sent_mini});  // the modem acknowledges by itself
    EXPECT_EQ(rig.told(), Lines{});
    EXPECT_EQ(rig.written(), Lines{});
}

TEST(ModemSequences, StatisticsWithoutTypesOrNone) {
    // Pitfall 16: CST off, or older firmware: the next thing heard, or two seconds, end a reception.
    Options options;
    options.id = 2;
    Rig rig(options);
    rig.start();
    rig.says_all({"CACYC,0,1,2,0,1,1", "CARXP,1", "CARXD,1,2,1,1,3535"});
    rig.pass(1.9);
    EXPECT_EQ(rig.told(), (Lines{"HEARD 1>2"}));
    rig.pass(0.2);
    EXPECT_EQ(rig.told(), (Lines{"reception 1>2 r0 [3535] ack"}));
    rig.says_all({"CACYC,0,1,2,0,1,1", "CARXD,1,2,1,1,3535", "CACYC,0,3,2,0,1,1"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 1>2", "reception 1>2 r0 [3535] ack", "HEARD 3>2"}));
}

class ModemPskRates : public testing::TestWithParam<unsigned> {};

TEST_P(ModemPskRates, AFrameForEachRequestBeforeTheSound) {
    const RateTable table;
    const Rate& rate = table.data(GetParam());
    const unsigned used = rate.frames - 1;  // one stays unused
    std::vector<std::string> frames;
    for (unsigned k = 0; k < used; ++k)
        frames.push_back(std::string(rate.frame_bytes, 'a' + static_cast<char>(k)));
    Rig rig;
    rig.start();
    rig.transmit(data_for(2, GetParam(), true, frames));
    const std::string cycle = fmt::format(",0,1,2,{},1,{}", GetParam(), used);
    EXPECT_EQ(rig.written(), (Lines{"CCCYC" + cycle}));
    rig.says("CACYC" + cycle);
    for (unsigned k = 0; k < used + 1; ++k) {  // the modem asks for one more
        rig.says(fmt::format("CADRQ,120000,1,2,1,{},{}", rate.frame_bytes, k + 1));
        const std::string data = k < used ? hex(frames[k]) : "";
        EXPECT_EQ(rig.written(), (Lines{"CCTXD,1,2,1," + data}));
        rig.says("CATXD,1,2,1," + data);
    }
    rig.says("CATXP,512");
    rig.pass(3);
    rig.says_all({"CATXF,512", sent_psk(static_cast<int>(GetParam()), static_cast<int>(used))});
    EXPECT_EQ(rig.told(), (Lines{"result #7 SENT stats 1"}));
    Lines acks;
    for (unsigned k = 0; k < used; ++k) {
        rig.says(fmt::format("CAACK,2,1,{},1", k + 1));
        acks.push_back(fmt::format("ack 2>1 #7 [{}]", k));
    }
    EXPECT_EQ(rig.told(), acks);
}
INSTANTIATE_TEST_SUITE_P(Rates, ModemPskRates, testing::Values(1U, 2U, 3U, 4U, 5U, 6U));

TEST(ModemSequences, PskReceived) {
    Options options;
    options.id = 2;
    Rig rig(options);
    rig.start();
    rig.says_all({"CARXP,2", "CACYC,0,1,2,1,0,3", "CARXD,1,2,0,1,aa", "CARXD,1,2,0,2,bb",
                  "CARXD,1,2,0,3,",
                  "CACST,6,0,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,1,1,2,0,3,3,0,150,20,"
                  "15,10,-9,200,0.1,5,25000,5000"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 1>2", "reception 1>2 r1 [aa bb] stats 1"}));
}

TEST(ModemSequences, TwoWayPing) {  // Figure 2.15
    Rig rig;
    rig.start();
    record::Transmission t;
    t.number = 9;
    t.src = 1;
    t.dest = 2;
    t.kind = record::Kind::ping;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCMPC,1,2"}));
    rig.says_all({"CAMPC,1,2", "CATXP,0", sent_mini});
    EXPECT_EQ(rig.told(), (Lines{"result #9 SENT stats 1"}));
    rig.pass(1.5);
    rig.says_all({"CARXP,1", "CAMPR,2,1,0.2501", mini_stats});
    EXPECT_EQ(rig.told(), (Lines{"range 1>2 ping 0=0.2501s 375.1m #9"}));  // 0.2501 s · 1500 m/s

    Options options;
    options.id = 2;
    Rig other(options);
    other.start();
    other.says_all({"CARXP,1", "CAMPA,1,2", mini_stats, "CATXP,0", "CATXF,0", sent_mini});
    EXPECT_EQ(other.told(), (Lines{"HEARD 1>2"}));
}

TEST(ModemSequences, PingsOfOldModemsWithoutStatistics) {  // pitfall 20
    Rig rig;
    rig.start();
    record::Transmission t;
    t.number = 9;
    t.dest = 2;
    t.kind = record::Kind::ping;
    rig.transmit(t);
    rig.says_all({"CAMPC,1,2", "CATXP,0", "CAMPR,2,1,0.02"});
    EXPECT_EQ(rig.told(), (Lines{"range 1>2 ping 0=0.02s 30.0m #9", "result #9 SENT"}));
    rig.written();
    rig.transmit(t);
    rig.says_all({"CAMPC,1,2", "CATXP,0", "CATXF,0"});
    rig.pass(0.6);
    EXPECT_EQ(rig.told(), (Lines{"result #9 SENT"}));
    for (const char* reply : {"CAMPR,2,1", "CAMPR,2,1,-0.0101"}) {
        rig.says(reply);
        EXPECT_EQ(rig.told(), (Lines{"ERROR 2 answered a ping without a travel time"})) << reply;
    }
}

TEST(ModemSequences, RemusTransponders) {
    Options options;
    options.lbl.max_range_m = 1000;
    Rig rig(options);
    rig.start();
    record::Transmission t;
    t.number = 11;
    t.src = 1;
    t.kind = record::Kind::lbl;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCPDT,1,2,0,0,1383,1,1,1,1"}));
    rig.says_all({"SNPDT,1,2,0,0,1383,1,1,1,1", "SNTTA,0.9216,0.5920,,,120001.00"});
    EXPECT_EQ(rig.told(),
              (Lines{"range 1>0 remus 0=0.9216s 1382.4m 1=0.592s 888.0m #11", "result #11 SENT"}));
}

TEST(ModemSequences, NarrowbandTransponders) {  // pitfall 20: no times are no zeros
    Options options;
    options.lbl.kind = Lbl::Kind::narrowband;
    options.lbl.max_range_m = 1000;
    options.lbl.turnaround_ms = 20;
    Rig rig(options);
    rig.start();
    record::Transmission t;
    t.number = 12;
    t.src = 1;
    t.kind = record::Kind::lbl;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCPNT,26000,5,5,1353,25000,0,0,0,1"}));
    rig.says_all({"SNPNT,26000,5,5,1353,25000,0,0,0,1", "SNTTA,,,,,"});
    EXPECT_EQ(rig.told(), (Lines{"range 1>0 narrowband #12", "result #12 SENT"}));
}

TEST(ModemSequences, CodedTransponders) {
    Options options;
    options.lbl.kind = Lbl::Kind::coded;
    options.lbl.receive_codes = {1, 2};
    options.lbl.transmit_code = 3;
    Rig rig(options);
    rig.start();
    record::Transmission t;
    t.number = 13;
    t.kind = record::Kind::lbl;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCPGT,26000,7,3,1383,25000,1,2,0,0,4000,0"}));
    rig.says_all({"SNPGT,26000,7,3,1383,25000,1,2,0,0,4000,0", "SNTTA,0.5,,,,120001.00"});
    EXPECT_EQ(rig.told(), (Lines{"range 1>0 coded 0=0.5s 750.0m #13", "result #13 SENT"}));
}

TEST(ModemSequences, Minipacket) {  // pitfall 21
    Rig rig;
    rig.start();
    record::Transmission t;
    t.number = 14;
    t.src = 1;
    t.dest = 2;
    t.kind = record::Kind::mini;
    t.mini = 0x123;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCMUC,1,2,0123"}));
    rig.says_all({"CAMUC,1,2,0123", "CATXP,0", sent_mini});
    EXPECT_EQ(rig.told(), (Lines{"result #14 SENT stats 1"}));
    rig.says_all({"CARXP,1", "CAMUA,2,1,1fab"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1"}));
    rig.says(mini_stats);
    EXPECT_EQ(rig.told(), (Lines{"reception 2>1 r0 [] mini 8107 stats 1"}));
}

TEST(ModemSequences, FlexibleData) {
    Options options;
    options.flexible = true;
    Rig rig(options);
    rig.start("2.0.35491");
    rig.transmit(data_for(2, 1, true, {"\x01\x02", "\x03"}));
    EXPECT_EQ(rig.written(), (Lines{"CCTDP,2,1,0,0,010203"}));
    rig.says_all({"CATDP,2,1,0,0,010203", "CATXP,3",
                  "CAXST,7,20240501,120003.000935,3,0,200,5000,25000,1,1,2,0,0,1,5,3,25000"});
    EXPECT_EQ(rig.told(), (Lines{"result #7 SENT stats 1"}));
    rig.says_all({"CARXP,2", "CARDP,2,1,1,0,0,,1;2;0102;1;1;03", good_stats});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [010203] stats 1"}));
    rig.says_all({"CARXP,2", "CARDP,2,1,1,0,0,,1;2;0102;0;1;03", good_stats});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 2>1", "reception 2>1 r1 [] bad [0] stats 1"}));
}

TEST(ModemSequences, FlexibleDataOfOddLengthIsPaddedForOldFirmware) {  // pitfall 14
    Options options;
    options.flexible = true;
    Rig rig(options);
    rig.start("2.0.35489");
    rig.transmit(data_for(2, 1, false, {"\x01"}));
    EXPECT_EQ(rig.written(), (Lines{"CCTDP,2,1,0,0,0100"}));
}

TEST(ModemSequences, PollOfAnother) {
    Rig rig;
    rig.start();
    record::Transmission t;
    t.number = 15;
    t.src = 3;
    t.dest = 0;
    t.rate = 1;
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCCYC,0,3,0,1,0,3"}));
    rig.says_all({"CACYC,0,3,0,1,0,3", "CATXP,4", "CATXF,4", sent_mini});
    EXPECT_EQ(rig.told(), (Lines{"result #15 SENT stats 1"}));
    rig.says_all({"CARXP,2", "CACYC,0,3,0,1,0,3", "CARXD,3,0,0,1,aa",
                  "CACST,6,0,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,1,3,0,0,3,1,0,150,20,"
                  "15,10,-9,200,0.1,5,25000,5000"});
    EXPECT_EQ(rig.told(), (Lines{"HEARD 3>0", "reception 3>0 r1 [aa] stats 1"}));
}

TEST(ModemSequences, PolledByAnother) {
    Options options;
    options.id = 3;
    Rig rig(options);
    rig.start();
    rig.says_all({"CARXP,1", "CACYC,0,3,1,1,1,3", mini_stats});
    EXPECT_EQ(rig.told(), (Lines{"slot 3>1 r1 3x64 polled"}));
    rig.says("CADRQ,120000,3,1,1,64,1");
    EXPECT_EQ(rig.written(), Lines{});  // until somebody knows what to send
    auto t = data_for(1, 1, true, {"\xaa", "\xbb"});
    t.src = 3;
    t.polled = true;
    rig.pass(0.2);
    rig.transmit(t);
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,3,1,1,aa"}));
    rig.says_all({"CATXD,3,1,1,aa", "CADRQ,120000,3,1,1,64,2"});
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,3,1,1,bb"}));
    rig.says_all({"CATXD,3,1,1,bb", "CADRQ,120000,3,1,1,64,3"});
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,3,1,1,"}));
    rig.says_all({"CATXP,192", "CATXF,192", sent_psk(1, 2)});
    EXPECT_EQ(rig.told(), (Lines{"result #7 SENT stats 1"}));
    rig.says("CAACK,1,3,2,1");
    EXPECT_EQ(rig.told(), (Lines{"ack 1>3 #7 [1]"}));
}

TEST(ModemSequences, PolledWithNothingToSay) {  // pitfall 17
    Options options;
    options.id = 3;
    Rig rig(options);
    rig.start();
    rig.says_all({"CACYC,0,3,1,1,0,3", "CADRQ,120000,3,1,0,64,1"});
    EXPECT_EQ(rig.told(), (Lines{"slot 3>1 r1 3x64 polled no ack"}));
    rig.pass(1.9);
    EXPECT_EQ(rig.written(), Lines{});
    rig.pass(0.2);
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,3,1,0,"}));
    rig.says("CADRQ,120000,3,1,0,64,2");
    EXPECT_EQ(rig.written(), (Lines{"CCTXD,3,1,0,"}));
    auto t = data_for(1, 1, false, {"\xaa"});
    t.polled = true;
    t.src = 3;
    rig.transmit(t);
    EXPECT_EQ(rig.told(), (Lines{"result #7 LATE: no poll is waiting for data"}));
}

}  // namespace seautils::modem
