// Logs of a dialogue with a modem: their forms, and the records that they come to.
#include "modem_rig.hpp"

#include "seautils/core/error.hpp"
#include "seautils/modem/replay.hpp"

namespace seautils::modem {
namespace {

/// What each line comes to, or why it does not.
Lines replayed(const Lines& lines, std::optional<unsigned> id = {}, bool raw = false) {
    Replay replay(id, 1500, raw);
    std::vector<record::Record> records;
    Lines told;
    for (const std::string& line : lines) {
        try {
            replay.line(line, records);
        } catch (const DataError& e) {
            told.push_back("refused: " + std::string(e.what()));
        }
    }
    replay.end(records);
    for (const auto& r : records) told.push_back(brief(r));
    return told;
}

record::UtcTime time_of(const std::string& before) {
    LogLines lines;
    const std::string line = before + "$CAMPA,1,2*5D";
    const LogLine l = lines.read(line);
    EXPECT_EQ(l.sentence, "$CAMPA,1,2*5D");
    return l.time.value_or(record::UtcTime{-1});
}

}  // namespace

TEST(ModemReplay, RealSentences) {
    EXPECT_EQ(
        replayed({"$CAREV,181807,AUV,2.0.27087*12", "$CACFG,SRC,1*33", "$CAMPA,1,2*5D",
                  "$CAMPR,2,1,0.0101*7C", "$CAMUA,1,2,1fab*20",
                  "$CACMA,2025-03-17T17:16:29.639994,PNG,0,1,56.7,6.62,3,0,0*74",
                  "$CACMR,PNR,2025-05-29T15:09:05.461473,1,0,0.001997,6.3,7.65,1,0,*41",
                  "$CARFP,2025-03-17T17:16:29.672622,0,0,1,1,-1,0,0,1;5;08000106ff,1;3;ac4131,,*23",
                  "$CACST,8,0,20250606230123.348554,06,32767,45,0102,0123,07,00,00,00,00,1,001,000,"
                  "0,5,1,0,150,26.0,9.48,-100,-6.48,-01,0.01,51,25000,5000,0,-1,-1,00*4A",
                  "$CAXST,7,20250606,230103.000935,3,0,200,5000,25000,1,0,1,0,0,1,5,2,25000*53",
                  "$CATXF,2*56"}),
        (Lines{"HEARD 1>2", "range 1>2 ping 0=0.0101s 15.2m", "HEARD 1>2",
               "reception 1>2 r0 [] mini 8107", "HEARD 0>1", "range 0>1 ping 0=0.001997s 3.0m",
               "HEARD 0>1", "reception 0>1 r1 [ac4131] stats 1", "result #0 SENT stats 1"}));
}

TEST(ModemReplay, GobysLog) {
    const std::string txd = stream::sentence("CCTXD,1,2,1,3535");
    const Lines log = {
        "[tx] $CCCFG,SRC,1*31",
        "[rx] $CACFG,SRC,1*33",
        "[tx] $CCCYC,0,1,2,0,1,1*5A",
        "[rx] $CACYC,0,1,2,0,1,1*58",
        "[rx] " +
            stream::sentence("CAXST,6,20240501,120001.0000,0,0,200,4000,25000,0,1,2,1,1,1,2,4"),
        "[rx] $CADRQ,204511,1,2,1,32,1*44",
        "[tx] " + txd.substr(0, txd.size() - 2),
        "[rx] " +
            stream::sentence("CAXST,6,20240501,120003.0000,0,0,200,4000,25000,0,1,2,1,1,1,1,32"),
        "[rx] $CAACK,2,1,1,1*48",
        "[RX] " + stream::sentence("CACYC,0,2,1,0,0,1"),
        "[rx] " + stream::sentence("CARXD,2,1,0,1,6869"),
    };
    EXPECT_EQ(replayed(log), (Lines{"result #0 SENT stats 2", "ack 2>1 #0 [0]", "HEARD 2>1",
                                    "reception 2>1 r0 [6869]"}));
    EXPECT_EQ(replayed({log[0]}, {}, true), (Lines{"> $CCCFG,SRC,1*31"}));
    EXPECT_EQ(replayed({log[1]}, {}, true), (Lines{"< $CACFG,SRC,1*33"}));
}

TEST(ModemReplay, TimesBeforeTheSentence) {
    const record::UtcTime time{parse_utc_ns("2024-05-01T12:00:25.5Z")};
    for (const char* before :
         {"2024-05-01T12:00:25.5Z ", "2024-05-01 12:00:25.500 [rx] ", "[2024-05-01T12:00:25.5] ",
          "[ 2024-May-01 12:00:25.500000 ] {modem}: ", "@1714564825.5 ", "1714564825.500000 < ",
          "(1714564825,5) ", "2024-05-01T12:00:25.5Z,"}) {
        EXPECT_EQ(time_of(before).ns, time.ns) << before;
    }
    for (const char* before : {"", "12:00:25 ", "2024-13-01T12:00:25Z ", "2024-May-32 12:00:25 ",
                               "2024-05-01T25:00:25Z ", "2024-05-01 ", "2024-Foo-01 12:00:25 ",
                               "20240501120025 ", "1 ", "9714564825.5 "}) {
        EXPECT_EQ(time_of(before).ns, -1) << before;
    }
}

TEST(ModemReplay, RecordsHaveTheTimesOfTheLog) {
    Replay replay(1, 1500, false);
    std::vector<record::Record> records;
    replay.line("2024-05-01T12:00:25.5Z $CAMPA,1,2*5D", records);
    replay.line("$CAMPR,2,1,0.0101*7C", records);
    ASSERT_EQ(records.size(), 2U);
    for (const auto& r : records) EXPECT_EQ(r.time.ns, parse_utc_ns("2024-05-01T12:00:25.5Z"));
    // Without times, what the modem says of its own.
    Replay other(1, 1500, false);
    records.clear();
    other.line("$CATMQ,2019-12-02T03:02:59Z,RTC,RTC*6E", records);
    other.line("$CAMPA,1,2*5D", records);
    EXPECT_EQ(records.at(0).time.ns, parse_utc_ns("2019-12-02T03:02:59Z"));
}

TEST(ModemReplay, LinesThatAreNone) {
    EXPECT_EQ(replayed({"", "  ", "# recorded in May", "$CAMPA,1,2*5D\r"}), (Lines{"HEARD 1>2"}));
    EXPECT_EQ(
        replayed({"starting up", "$CAMPA,1,2*5E", "$CAMPA,1,2*5D", "$CAMPA,1,2", "$CAMPA,1*5"}, {},
                 true),
        (Lines{"refused: no sentence begins in it",
               "refused: checksum 5E is not the 5D of its bytes",
               "refused: the checksum is missing",
               "refused: two hexadecimal digits should follow '*', and end it",
               "< $CAMPA,1,2*5E (checksum 5E is not the 5D of its bytes)", "< $CAMPA,1,2*5D",
               "HEARD 1>2", "< $CAMPA,1,2 (the checksum is missing)",
               "< $CAMPA,1*5 (two hexadecimal digits should follow '*', and end it)"}));
}

TEST(ModemReplay, GivesWhatTheDriverGave) {
    Options options;
    options.raw = true;
    Rig rig(options);
    rig.start();
    rig.transmit(data_for(2, 0, true, {"hi"}));
    rig.says_all({"CACYC,0,1,2,0,1,1", "CATXP,4", "CATXF,4",
                  "CAXST,6,20240501,120001.0000,0,0,200,4000,25000,0,1,2,1,1,1,2,4",
                  "CADRQ,204511,1,2,1,32,1", "CATXD,1,2,1,6869", "CATXP,2", "CATXF,2",
                  "CAXST,6,20240501,120003.0000,0,0,200,4000,25000,0,1,2,1,1,1,1,2", "CARXP,1",
                  "CAACK,2,1,1,1"});
    rig.pass(3);
    rig.says_all({"CARXP,2", "CACYC,0,2,1,1,0,3", "CARXD,2,1,0,1,aa", "CAMSG,BAD_CRC,2",
                  "CARXD,2,1,0,3,cc",
                  "CACST,6,1,20240501120010.1234,0,1000,40,200,150,1,2,3,4,5,1,2,1,0,3,3,1,150,20,"
                  "15,10,-9,200,0.1,5,25000,5000"});
    rig.pass(3);
    rig.says_all({"CACYC,0,3,1,1,0,3", "CARXD,3,1,0,1,aa"});
    rig.pass(3);
    rig.says_all({"CAMPA,4,1", "CAMUA,4,1,0007", "CARXP,1", "CAREV,120000,INIT,0"});

    Replay replay(1, 1500, true);
    std::vector<record::Record> replayed;
    Lines live;
    for (const auto& r : rig.records()) {
        if (const auto* raw = r.as<record::Raw>()) {
            replay.sentence(raw->line, raw->direction == record::Raw::Direction::out, r.time,
                            replayed);
        }
        std::string line = brief(r) + " " + format_utc_ns(r.time.ns);
        if (const auto at = line.find("#7"); at != line.npos) line.replace(at, 2, "#0");
        live.push_back(line);
    }
    replay.end(replayed);
    Lines again;
    for (const auto& r : replayed) again.push_back(brief(r) + " " + format_utc_ns(r.time.ns));
    EXPECT_EQ(again, live);
}

}  // namespace seautils::modem
