// NMEA sentences: real ones, and what a serial line makes of them.
#include "seautils/core/error.hpp"
#include "seautils/stream/nmea.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace seautils::stream {
namespace {

/// What became of a line, in a word.
std::string taken(std::string_view line) {
    Sentence s;
    const SentenceFault fault = parse_sentence(line, s);
    const std::string what = sentence_fault(fault, s);
    if (!what.empty()) return what;
    return std::string(s.address()) + (s.checksum() == Checksum::good ? " good" : " absent");
}

std::string refusal(std::string_view body) {
    try {
        return "taken: " + sentence(body);
    } catch (const DataError& e) {
        return e.what();
    }
}

/// Sentences captured from modems: specs/micromodem.md §1.
const char* const captured[] = {
    "$CACFG,script.vD,0*63",
    "$CACYC,0,0,8,0,0,1*52",
    "$CCTMQ,0*54",
    "$CATMQ,2019-12-02T03:02:59Z,RTC,RTC*6E",
    "$CAREV,030303,AUV,2.0.27087*16",
    "$CAREV,030303,COPROC,0.30.0.56*40",
    "$CCCFG,SRC,1*31",
    "$CACFG,SRC,1*33",
    "$CCCYC,0,1,2,0,1,1*5A",
    "$CACYC,0,1,2,0,1,1*58",
    "$CADRQ,204511,1,2,1,32,1*44",
    "$CCTXD,1,2,1,3535353535353535353535353535353535353535353535353535353535353535*7A",
    "$CARXD,1,2,1,1,3535353535353535353535353535353535353535353535353535353535353535*63",
    "$CAACK,2,1,1,1*48",
    "$CCMPC,1,2*5D",
    "$CAMPR,2,1,0.2501*7A",
    "$CCMUC,1,2,0123*74",
    "$CCPDT,1,2,0,0,1383,1,1,1,1*66",
    "$CCPNT,26000,5,5,1353,25000,0,0,0,1*60",
    "$SNTTA,0.9216,0.5920,,,204504.00*5B",
    "$CAMSG,BAD_CRC,4*25",
    "$CCMSC,1,1,0*41",
};

/// Lines of a recording that lies outside of the tree; none where it does not lie there.
std::vector<std::string> recorded(const std::string& name) {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    std::ifstream file(
        (shared != nullptr ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared") + "/data/" +
        name);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && (line[0] == '$' || line[0] == '!')) lines.push_back(line);
    }
    return lines;
}

}  // namespace

TEST(StreamNmea, SentencesOfModems) {
    for (const char* line : captured) {
        Sentence s;
        ASSERT_EQ(parse_sentence(line, s), SentenceFault::none) << line;
        EXPECT_EQ(s.checksum(), Checksum::good) << line;
        EXPECT_EQ(sentence(s.body()), std::string(line) + "\r\n");
    }
}

TEST(StreamNmea, Fields) {
    Sentence s;
    ASSERT_EQ(parse_sentence("$SNTTA,0.9216,0.5920,,,204504.00*5B\r\n", s), SentenceFault::none);
    EXPECT_EQ(s.address(), "SNTTA");
    EXPECT_EQ(s.talker(), "SN");
    EXPECT_EQ(s.type(), "TTA");
    EXPECT_EQ(s.fields(), 5U);
    EXPECT_EQ(s[1], "0.9216");
    EXPECT_EQ(s[3], "");
    EXPECT_EQ(s[5], "204504.00");
    EXPECT_EQ(s[6], "");
    EXPECT_EQ(s.from(4), ",204504.00");
    EXPECT_EQ(s.from(6), "");
}

TEST(StreamNmea, ShortAddresses) {
    Sentence s;
    ASSERT_EQ(parse_sentence("$C", s), SentenceFault::none);
    EXPECT_EQ(s.address(), "C");
    EXPECT_EQ(s.type(), "");
    EXPECT_EQ(s.fields(), 0U);
    EXPECT_EQ(taken("$"), "no sentence begins in it");
    EXPECT_EQ(taken("$,1"), "no sentence begins in it");
    EXPECT_EQ(taken("$*00"), "no sentence begins in it");
}

TEST(StreamNmea, ChecksumsAreAbsentGoodOrWrong) {
    EXPECT_EQ(taken("$CCCFG,SRC,1"), "CCCFG absent");
    EXPECT_EQ(taken("$CCCFG,SRC,1*31"), "CCCFG good");
    EXPECT_EQ(taken("$CCCFG,SRC,1*32"), "checksum 32 is not the 31 of its bytes");
    EXPECT_EQ(taken("$CATMQ,2019-12-02T03:02:59Z,RTC,RTC*6e"), "CATMQ good");
    EXPECT_EQ(taken("$CCCFG,SRC,1*3"), "two hexadecimal digits should follow '*', and end it");
    EXPECT_EQ(taken("$CCCFG,SRC,1*3G"), "two hexadecimal digits should follow '*', and end it");
    EXPECT_EQ(taken("$CCCFG,SRC,1*31x"), "two hexadecimal digits should follow '*', and end it");
    EXPECT_EQ(taken("$CCCFG*1*31"), "two hexadecimal digits should follow '*', and end it");
}

TEST(StreamNmea, LineEndsAndNoise) {
    for (const char* line : {"$CCCFG,SRC,1*31\r", "$CCCFG,SRC,1*31\r\n", "$CCCFG,SRC,1*31 \t\r\r\n",
                             "\xff\x80\x01$CCCFG,SRC,1*31", "$CACST,6,0,$CCCFG,SRC,1*31"}) {
        EXPECT_EQ(taken(line), "CCCFG good") << line;
    }
    Sentence s;
    ASSERT_EQ(parse_sentence("$CACST,6,$CCCFG,SRC,1*31", s), SentenceFault::none);
    EXPECT_EQ(s.noise(), "$CACST,6,");
    for (const char* line : {"", "\r\n", "CCCFG,SRC,1*31", "\x01\x02"})
        EXPECT_EQ(taken(line), "no sentence begins in it");
    EXPECT_EQ(taken("$CCC\x01G,SRC,1*31"), "bytes that are not printable");
    EXPECT_EQ(taken("$CCC\xc3\xa4"), "bytes that are not printable");
    EXPECT_EQ(taken("!AIVDM,1,1,,A,14eG;o@034o8sd<L9i:a;WF>062D,0*7D"), "AIVDM good");
}

TEST(StreamNmea, TooMuch) {
    const std::string most(longest_sentence - 1, 'x');
    EXPECT_EQ(taken("$" + most), most + " absent");
    EXPECT_EQ(taken("$" + most + "x"), "longer than 8192 bytes");
    const std::string commas(Sentence::most_fields - 1, ',');
    EXPECT_EQ(taken("$A" + commas), "A absent");
    EXPECT_EQ(taken("$A" + commas + ","), "more than 96 fields");
}

TEST(StreamNmea, WhatCannotBeSaidIsRefused) {
    EXPECT_EQ(refusal(""), "a sentence of no bytes");
    EXPECT_EQ(refusal("CCCFG,SRC,1\r\n$CCMSC,1,1,0"), "a sentence cannot say '\\x0d'");
    EXPECT_EQ(refusal("CC*"), "a sentence cannot say '*'");
    EXPECT_EQ(refusal("C$"), "a sentence cannot say '$'");
    EXPECT_EQ(refusal(std::string(8189, 'x')),
              "a sentence of 8193 bytes is longer than 8192 bytes");
}

TEST(StreamNmea, WhatWasComposedIsRead) {
    EXPECT_TRUE(rc::check("fields come back", [](const std::vector<std::uint16_t>& numbers) {
        std::string body = "CCXYZ";
        for (const std::uint16_t x : numbers) body += "," + std::to_string(x);
        RC_PRE(numbers.size() < Sentence::most_fields);
        const std::string line = sentence(body);
        Sentence s;
        RC_ASSERT(parse_sentence(line, s) == SentenceFault::none);
        RC_ASSERT(s.checksum() == Checksum::good);
        RC_ASSERT(s.fields() == numbers.size());
        for (std::size_t k = 0; k < numbers.size(); ++k)
            RC_ASSERT(s[k + 1] == std::to_string(numbers[k]));
    }));
}

TEST(StreamNmea, OneFlippedBitIsSeen) {
    EXPECT_TRUE(
        rc::check("a flipped bit is no good sentence", [](std::uint16_t where, std::uint8_t bit) {
            std::string line = "$CAMPR,2,1,0.2501*7A";
            line[where % 17] ^= static_cast<char>(1U << bit % 8);
            RC_ASSERT(taken(line) != "CAMPR good");
        }));
}

TEST(StreamNmea, RecordedSentences) {
    std::size_t good = 0, absent = 0;
    for (const char* name :
         {"modem/micromodem_fragments.txt", "nmea/pearl_asv_gps_b.nmea", "nmea/sounder.log"}) {
        for (const std::string& line : recorded(name)) {
            Sentence s;
            EXPECT_EQ(parse_sentence(line, s), SentenceFault::none) << name << ": " << line;
            EXPECT_NE(s.checksum(), Checksum::wrong) << name << ": " << line;
            (s.checksum() == Checksum::good ? good : absent) += 1;
        }
    }
    if (good == 0) GTEST_SKIP() << "no recordings (SEAUTILS_SHARED)";
    EXPECT_EQ(absent, 0U);
}

}  // namespace seautils::stream
