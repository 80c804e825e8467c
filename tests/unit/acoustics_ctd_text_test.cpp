// Casts as text: names of columns, tables, WHP-exchange files, Sea-Bird's .cnv.
#include "seautils/acoustics/cnv.hpp"
#include "seautils/acoustics/ctd_csv.hpp"
#include "seautils/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace seautils::acoustics {
namespace {

constexpr std::int64_t second = 1'000'000'000;

/// All scans of a text; lines that are refused as `LINE: what`.
template <class Reader>
std::vector<Reading> scans(Reader reader, std::string_view text,
                           std::vector<std::string>* refused = nullptr) {
    std::vector<Reading> all;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        Reading reading;
        try {
            if (reader.read(text.substr(0, end), reading)) all.push_back(reading);
        } catch (const DataError& e) {
            if (refused == nullptr) throw;
            refused->push_back(std::to_string(line) + ": " + e.what());
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return all;
}

std::vector<Reading> csv(std::string_view text, std::vector<std::string>* refused = nullptr) {
    return scans(CtdCsv(), text, refused);
}

}  // namespace

TEST(Columns, AreRecognisedHoweverTheyAreWritten) {
    const auto quantity = [](std::string_view name) {
        const auto column = column_of(name);
        return column ? column->quantity : Quantity::longitude_deg;
    };
    for (const char* name :
         {"depth_m", "Depth (m)", "DEPTH", " depth [m] ", "depSM", "depth_meters"})
        EXPECT_EQ(quantity(name), Quantity::depth_m) << name;
    for (const char* name :
         {"temperature_C", "TEMP", "Temperature (°C)", "CTDTMP", "t090C", "t068"})
        EXPECT_EQ(quantity(name), Quantity::temperature_c) << name;
    for (const char* name : {"salinity_psu", "PSAL", "Salinity (PSU)", "sal00", "CTDSAL"})
        EXPECT_EQ(quantity(name), Quantity::salinity) << name;
    EXPECT_DOUBLE_EQ(column_of("c0mS/cm")->scale, 0.1);
    EXPECT_DOUBLE_EQ(column_of("c0S/m")->scale, 1);
    EXPECT_DOUBLE_EQ(column_of("conductivity_Sm")->scale, 1);
    for (const char* name : {"", "oxygen", "t190C", "sal11", "depth_of_bottom", "(m)"})
        EXPECT_FALSE(column_of(name)) << name;
    EXPECT_EQ(parse_quantity("conductivity_mspcm").scale, 0.1);
    EXPECT_THROW(parse_quantity("ctdtmp"), DataError);
    EXPECT_THROW(parse_quantity(""), DataError);
}

TEST(Columns, CellsAreNumbersTimesOrNotAvailable) {
    Reading r;
    const auto put = [&](const char* cell, const char* name) {
        r = {};
        fill(cell, *column_of(name), {}, r);
    };
    for (const char* none : {"", "nan", "NaN", "NA", "null", "-999", "-999.0", "-9999", "-99"}) {
        put(none, "temperature_c");
        EXPECT_TRUE(std::isnan(r[Quantity::temperature_c])) << none;
    }
    put("-151.788", "longitude");
    EXPECT_EQ(r[Quantity::longitude_deg], -151.788);
    put("25.006", "t068");
    EXPECT_DOUBLE_EQ(r[Quantity::temperature_c], 25);
    put("1406206796.17", "time_s");
    EXPECT_EQ(r.time_ns, 1'406'206'796'170'000'000);
    put("2024-05-01T12:00:25Z", "time");
    EXPECT_EQ(r.time_ns, 1'714'564'825 * second);
    for (const char* wrong : {"x", "1,5", "1.5 m", "0x10", "--1", "1e", "1.2.3"})
        EXPECT_THROW(put(wrong, "temperature_c"), DataError) << wrong;
    for (const char* wrong : {"noon", "12:00", "2024-05-01T12:00:25"})
        EXPECT_THROW(put(wrong, "time"), DataError) << wrong;
    put("1e300", "time");
    EXPECT_EQ(r.time_ns, no_time);
}

TEST(CtdCsv, ReadsRowsBelowAHeader) {
    const auto all = csv(
        "# a "
        "cast\npressure_dbar,oxygen,temperature_C,\"salinity_psu\"\n1.5,x,10.25,35\n\n2,x,,34\n");
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0][Quantity::pressure_dbar], 1.5);
    EXPECT_EQ(all[0][Quantity::temperature_c], 10.25);
    EXPECT_EQ(all[0][Quantity::salinity], 35);
    EXPECT_TRUE(std::isnan(all[1][Quantity::temperature_c]));
    EXPECT_EQ(all[0].time_ns, no_time);
}

TEST(CtdCsv, PartedByAnythingAndWithALineOfUnits) {
    for (const char* text :
         {"depth;temp;sal\nm;degC;PSU\n5;10;35\n", "depth\ttemp\tsal\n5\t10\t35\n",
          "depth   temp sal\n  5  10   35 \n", "Depth (m),Temp,Sal\r\n5,10,35\r\n",
          "depth,temp,sal\n5,10,\"35\"\n"}) {
        const auto all = csv(text);
        ASSERT_EQ(all.size(), 1U) << text;
        EXPECT_EQ(all[0][Quantity::depth_m], 5) << text;
        EXPECT_EQ(all[0][Quantity::salinity], 35) << text;
    }
}

TEST(CtdCsv, ColumnsAreNamedByTheCaller) {
    const auto named = [](std::initializer_list<const char*> texts) {
        std::vector<NamedColumn> all;
        for (const char* text : texts) all.push_back(parse_named_column(text));
        return CtdCsv(all);
    };
    const char* two = "depth,T1,T2,temp\n5,1,2,3\n";
    EXPECT_EQ(scans(named({"temperature_c=T2"}), two).at(0)[Quantity::temperature_c], 2);
    EXPECT_EQ(scans(CtdCsv(), two).at(0)[Quantity::temperature_c], 3);
    // by their places, with no header at all
    const auto all = scans(named({"depth_m=2", "sound_speed_mps=1"}), "1500 10\n1490 20\n");
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1][Quantity::depth_m], 20);
    EXPECT_EQ(all[1][Quantity::sound_speed_mps], 1490);
    for (const char* wrong : {"", "depth_m", "depth_m=", "=x", "deep=x"})
        EXPECT_THROW(parse_named_column(wrong), DataError) << wrong;
}

TEST(CtdCsv, WhpExchange) {
    const auto all = csv(
        "CTD,20011226WHPOSIOKJU\n#DEPTH_TYPE : COR\nNUMBER_HEADERS = 10\nDATE = 19970821\nTIME =  "
        "0613\n"
        "LATITUDE =   17.9620\nLONGITUDE =  -65.1367\nDEPTH =  -999\n"
        "CTDPRS,CTDPRS_FLAG_W,CTDTMP,CTDTMP_FLAG_W,CTDSAL,CTDSAL_FLAG_W,\nDBAR,,ITS-90,,PSS-78,,\n"
        "     3.0,2,  28.7797,2,  35.4352,2\n     5.0,2,  28.7778,4,  35.4335,2\n"
        "     7.0,2,  28.7778,2,  35.4335,9\nEND_DATA\nwhat is this\n");
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].time_ns, 872'143'980 * second);  // date -d 1997-08-21T06:13Z +%s
    EXPECT_EQ(all[0][Quantity::latitude_deg], 17.962);
    EXPECT_EQ(all[0][Quantity::longitude_deg], -65.1367);
    EXPECT_FALSE(all[0].flagged);
    EXPECT_TRUE(all[1].flagged);
    EXPECT_TRUE(std::isnan(all[2][Quantity::salinity]));
}

TEST(CtdCsv, WhatCannotBeReadIsSaidOnce) {
    std::vector<std::string> refused;
    EXPECT_EQ(csv("depth,temp\n1,2\n2\n3,x\n4,5\n", &refused).size(), 2U);
    ASSERT_EQ(refused.size(), 2U);
    EXPECT_EQ(refused[0], "3: 1 column where the header has 2");
    EXPECT_EQ(refused[1], "4: temperature_c 'x' is no number");
    refused.clear();
    EXPECT_TRUE(csv("a,b\n1,2\n3,4\n", &refused).empty());
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_EQ(refused[0],
              "1: header 'a,b' names no depth or pressure beside a temperature or a sound speed "
              "(--column)");
    // a file of another kind behind it
    EXPECT_EQ(
        csv("depth,temp\n1,2\nsound_speed_mps,depth_m\n1500,4\n").at(1)[Quantity::sound_speed_mps],
        1500);
}

TEST(Cnv, ReadsScansByTheirHeader) {
    const auto all = scans(
        Cnv(),
        "* Sea-Bird SBE 9 Data File:\n* System UpLoad Time = Aug 09 2012 06:34:23\n"
        "* NMEA Latitude = 71 20.70 N\n* NMEA Longitude = 151 47.26 W\n* NMEA UTC (Time) = Aug 09 "
        "2012 06:34:34\n"
        "** Latitude: N10 00.0\n# nquan = 5\n# name 0 = timeS: Time, Elapsed [seconds]\n"
        "# name 1 = prDM: Pressure, Digiquartz [db]\n# name 2 = t090C: Temperature [ITS-90, deg "
        "C]\n"
        "# name 3 = c0mS/cm: Conductivity [mS/cm]\n# name 4 = t190C: Temperature, 2\n# name 5 = "
        "flag: flag\n"
        "# start_time = Aug 09 2012 06:34:30\n# bad_flag = -9.990e-29\n# file_type = ascii\n*END*\n"
        "      0.000      1.000    -0.0155  21.489996     9.0000  0.000e+00\n"
        "      0.500      2.000 -9.990e-29  21.526209     9.0000 -9.990e-29\n");
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].time_ns, 1'344'494'074 * second);  // date -d 2012-08-09T06:34:34Z +%s
    EXPECT_EQ(all[1].time_ns, all[0].time_ns + second / 2);
    EXPECT_DOUBLE_EQ(all[0][Quantity::latitude_deg], 71.345);
    EXPECT_DOUBLE_EQ(all[0][Quantity::longitude_deg], -(151 + 47.26 / 60));
    EXPECT_EQ(all[0][Quantity::pressure_dbar], 1);
    EXPECT_EQ(all[0][Quantity::temperature_c], -0.0155);
    EXPECT_DOUBLE_EQ(all[0][Quantity::conductivity_spm], 2.1489996);
    EXPECT_FALSE(all[0].flagged);
    EXPECT_TRUE(all[1].flagged);
    EXPECT_TRUE(std::isnan(all[1][Quantity::temperature_c]));
}

TEST(Cnv, NumbersThatFillTheirPlacesAreNotOne) {
    const auto all =
        scans(Cnv(),
              "* Sea-Bird\n# name 0 = scan: x\n# name 1 = depSM: Depth\n# name 2 = svCM: v\n*END*\n"
              "          112345.67891    1499.50\n");
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0][Quantity::depth_m], 12345.67891);
    EXPECT_EQ(all[0][Quantity::sound_speed_mps], 1499.5);
}

TEST(Cnv, WhatCannotBeReadIsSaidOnce) {
    const auto said = [](std::string_view text) {
        std::vector<std::string> refused;
        EXPECT_TRUE(scans(Cnv(), text, &refused).empty());
        EXPECT_LE(refused.size(), 1U);
        return refused.empty() ? "" : refused[0];
    };
    EXPECT_EQ(said("1 2 3\n4 5 6\n"), "1: no header of a .cnv file");
    EXPECT_EQ(said("* x\n# name 0 = t090C: T\n*END*\n5\n6\n"),
              "3: the header names no pressure or depth");
    EXPECT_EQ(said("* x\n# name 0 = prDM: p\n*END*\n5\n6\n"),
              "3: the header names no temperature or sound speed");
    EXPECT_EQ(said("* x\n# file_type = binary\n*END*\n\x01\x02\n"),
              "3: the data are binary: convert them to ascii");
    EXPECT_EQ(said("* x\n# name 0 = depSM: d\n# name 1 = t090C: T\n*END*\n5\n"),
              "5: 1 column where the header has 2");
    EXPECT_EQ(said("*END*\n"), "1: *END* behind no header");
    EXPECT_EQ(said("* x\n# name 0 = depSM: d\n5\n6\n"),
              "3: neither a line of the header, nor behind its *END*");
}

TEST(Cnv, PositionsAndTimes) {
    EXPECT_DOUBLE_EQ(*parse_position("N44 41.056"), 44 + 41.056 / 60);
    EXPECT_DOUBLE_EQ(*parse_position("w63 38.633"), -(63 + 38.633 / 60));
    EXPECT_DOUBLE_EQ(*parse_position("63 38 37.9 W"), -(63 + 38 / 60.0 + 37.9 / 3600));
    EXPECT_DOUBLE_EQ(*parse_position("-63.64"), -63.64);
    for (const char* wrong : {"", "N", "north", "44 61 N", "44 -3 N", "1 2 3 4", "400"})
        EXPECT_FALSE(parse_position(wrong)) << wrong;
    EXPECT_EQ(parse_cnv_time("Aug 09 2012 06:34:34"), 1'344'494'074 * second);
    EXPECT_EQ(parse_cnv_time("Oct 15 1903 11:38:38"), no_time);  // as a real file says
    for (const char* wrong :
         {"", "Aug", "Foo 09 2012 06:34:34", "Aug 32 2012 06:34:34", "Aug 09 2012 6h"})
        EXPECT_EQ(parse_cnv_time(wrong), no_time) << wrong;
}

}  // namespace seautils::acoustics
