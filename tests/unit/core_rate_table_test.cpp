// What a modem sends at each rate: the file, the table that is built in, and the arithmetic.
#include "seautils/core/error.hpp"
#include "seautils/core/rate_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace seautils {
namespace {

using namespace std::chrono_literals;

std::string shipped() {
    std::ifstream file(SEAUTILS_SOURCE_DIR "/schemas/seautils/micromodem.rates");
    return (std::ostringstream() << file.rdbuf()).str();
}

std::string refusal(const std::string& text) {
    try {
        RateTable::parse(text, "a.rates");
        return "taken";
    } catch (const ConfigError& e) {
        return e.what();
    }
}

}  // namespace

TEST(CoreRateTable, TheFileIsTheTableThatIsBuiltIn) {
    EXPECT_TRUE(RateTable::parse(shipped(), "micromodem.rates") == RateTable());
}

TEST(CoreRateTable, FramesAndBytesOfAMicroModem) {
    // specs/micromodem.md §3: frames, bytes of each, bytes of a packet.
    const unsigned expected[][3] = {{1, 32, 32},   {3, 64, 192},   {3, 64, 192}, {2, 256, 512},
                                    {2, 256, 512}, {8, 256, 2048}, {6, 32, 192}};
    const RateTable table;
    ASSERT_EQ(table.all_data().size(), 7U);
    for (unsigned rate = 0; rate < 7; ++rate) {
        const Rate& r = table.data(rate);
        EXPECT_EQ(r.frames, expected[rate][0]);
        EXPECT_EQ(r.frame_bytes, expected[rate][1]);
        EXPECT_EQ(r.frames * r.frame_bytes, expected[rate][2]);
    }
}

TEST(CoreRateTable, AirTimes) {
    const RateTable table;
    EXPECT_EQ(table.data(0).packet_time(1), 3200ms);
    EXPECT_EQ(table.data(0).air_time(1, false), 4100ms);
    EXPECT_EQ(table.data(0).air_time(1, true), 5000ms);
    EXPECT_EQ(table.data(6).packet_time(6), 3250ms);  // WHOI: 3.25 s with the probe
    EXPECT_EQ(table.data(5).packet_time(4), 1850ms);
    EXPECT_THROW(table.data(5).packet_time(0), std::out_of_range);
    EXPECT_THROW(table.data(5).packet_time(9), std::out_of_range);
    EXPECT_EQ(minipacket_time, 900ms);
}

TEST(CoreRateTable, RatesThatAreNotThereAreRefused) {
    try {
        RateTable().data(7);
        FAIL();
    } catch (const DataError& e) {
        EXPECT_STREQ(e.what(), "data rate 7 is none of 0 1 2 3 4 5 6");
    }
    EXPECT_THROW(RateTable().flexible(0), DataError);
}

TEST(CoreRateTable, RefusalsNameTheLineAndTheColumn) {
    EXPECT_EQ(refusal(""), "a.rates: no rate of kind data");
    EXPECT_EQ(refusal("# nothing\n\n"), "a.rates: no rate of kind data");
    EXPECT_EQ(refusal("data 0 1 32 3.2 0 0.9 0.9"), "taken");
    EXPECT_EQ(refusal("data 0 1 32 3.2 0 0.9 0.9\r\n\n data 0 1 32 3.2 0 0.9 0.9\n"),
              "a.rates:3: rate 0 comes twice");
    EXPECT_EQ(refusal("data 0 1 32 3.2 0 0.9\n"),
              "a.rates:1: 7 columns where there should be 8: kind rate frames frame_bytes packet_s "
              "probe_s cycle_s ack_s");
    EXPECT_EQ(refusal("slow 0 1 32 3.2 0 0.9 0.9"),
              "a.rates:1: kind 'slow' is neither data nor flexible");
    EXPECT_EQ(refusal("data 15 1 32 3.2 0 0.9 0.9"),
              "a.rates:1: rate '15' is not a whole number 0 to 14");
    EXPECT_EQ(refusal("data 0 9 32 3.2 0 0.9 0.9"),
              "a.rates:1: frames '9' is not a whole number 1 to 8");
    EXPECT_EQ(refusal("data 0 1 3x 3.2 0 0.9 0.9"),
              "a.rates:1: frame_bytes '3x' is not a whole number 1 to 2048");
    EXPECT_EQ(refusal("data 0 1 32 0 0 0.9 0.9"),
              "a.rates:1: packet_s '0' is not a time of 0.001 to 600 s");
    EXPECT_EQ(refusal("data 0 1 32 3.2 nan 0.9 0.9"),
              "a.rates:1: probe_s 'nan' is not a time of 0 to 600 s");
    EXPECT_EQ(refusal("data 0 1 32 3.2 0 0.9 1e9"),
              "a.rates:1: ack_s '1e9' is not a time of 0 to 600 s");
}

}  // namespace seautils
