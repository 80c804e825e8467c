// .shd and .arr files against their layouts, read here byte by byte.
#include "seautils/core/error.hpp"
#include "seautils/toolbox/arr_file.hpp"
#include "seautils/toolbox/shd_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace seautils::toolbox {

namespace {

ShdFile field(std::size_t ranges) {
    ShdFile f;
    f.title = "A shelf";
    f.frequency_hz = 250.5;
    f.source_depth_m = {10, 20.5F};
    f.receiver_depth_m = {1, 2, 3};
    for (std::size_t k = 0; k < ranges; ++k)
        f.range_m.push_back(100.25 * static_cast<double>(k + 1));
    for (std::size_t k = 0; k < 6 * ranges; ++k)
        f.pressure.emplace_back(static_cast<float>(k), -static_cast<float>(k) / 2);
    return f;
}

/// The number at an offset of a file of this machine's byte order.
template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T x;
    std::memcpy(&x, bytes.data() + offset, sizeof x);
    return x;
}

/// What reads a file as its layout says: records of 4 L bytes.
void expect_layout(const std::string& file, const ShdFile& f, bool is_new) {
    const std::size_t n = f.range_m.size(), bytes = 4 * std::max<std::size_t>(41, 2 * n);
    ASSERT_EQ(file.size(), (10 + 6) * bytes);
    EXPECT_EQ(at<std::int32_t>(file, 0), static_cast<std::int32_t>(bytes / 4));
    EXPECT_EQ(file.substr(4, 80), "A shelf" + std::string(73, ' '));
    EXPECT_EQ(file.substr(bytes, 10), "rectilin  ");
    const std::int32_t counts[] = {1, 1, 1, 1, 2, 3, static_cast<std::int32_t>(n)};
    for (std::size_t k = 0; k < 7; ++k)
        EXPECT_EQ(at<std::int32_t>(file, 2 * bytes + 4 * k), counts[k]);
    EXPECT_EQ(at<double>(file, 2 * bytes + 28), 250.5);
    EXPECT_EQ(at<double>(file, 3 * bytes), 250.5);
    EXPECT_EQ(at<float>(file, 7 * bytes + 4), 20.5F);
    EXPECT_EQ(at<float>(file, 8 * bytes + 8), 3.0F);
    for (std::size_t k = 0; k < n; ++k)
        EXPECT_EQ(is_new ? at<double>(file, 9 * bytes + 8 * k)
                         : double{at<float>(file, 9 * bytes + 4 * k)},
                  f.range_m[k]);
    // source 1, depth 2, range n - 1: record 10 + 1 * 3 + 2
    EXPECT_EQ(at<float>(file, (10 + 5) * bytes + 8 * (n - 1)), static_cast<float>(6 * n - 1));
    EXPECT_EQ(at<float>(file, (10 + 5) * bytes + 8 * (n - 1) + 4),
              -static_cast<float>(6 * n - 1) / 2);
}

std::string refusal(const std::string& bytes) {
    try {
        read_shd(bytes);
    } catch (const DataError& e) {
        return e.what();
    }
    return "accepted";
}

propagation::Arrival arrival(double amplitude, double delay_s) {
    propagation::Arrival a;
    a.amplitude = amplitude;
    a.phase_deg = 180;
    a.delay_s = delay_s;
    a.absorption_db = 3;
    a.launch_deg = -10.5;
    a.arrival_deg = 11;
    a.surface_bounces = 2;
    a.bottom_bounces = 1;
    return a;
}

ArrFile two_receivers() {
    ArrFile f;
    f.frequency_hz = 1000;
    f.source_depth_m = {30};
    f.receiver_depth_m = {10, 20};
    f.range_m = {500.5};
    f.receivers = {{10, 500.5, {arrival(0.01, 0.335), arrival(0.005, 0.34)}}, {20, 500.5, {}}};
    return f;
}

}  // namespace

TEST(ShdFile, LayoutsOfBothKinds) {
    for (const std::size_t ranges : {1U, 4U, 90U}) {
        const ShdFile f = field(ranges);
        expect_layout(write_shd(f, ShdLayout::of_2023), f, true);
        expect_layout(write_shd(f, ShdLayout::of_2022), f, false);
    }
}

TEST(ShdFile, ReadsWhatItWrites) {
    for (const std::size_t ranges : {1U, 2U, 200U})
        for (const ShdLayout layout : {ShdLayout::of_2022, ShdLayout::of_2023}) {
            const ShdFile f = field(ranges), g = read_shd(write_shd(f, layout));
            EXPECT_EQ(g.title, f.title);
            EXPECT_EQ(g.range_m, f.range_m);
            EXPECT_EQ(g.receiver_depth_m, f.receiver_depth_m);
            EXPECT_EQ(g.source_depth_m, f.source_depth_m);
            EXPECT_EQ(g.pressure, f.pressure);
        }
}

TEST(ShdFile, PairsAreOneRecordOfEachSource) {
    ShdFile f = field(0);
    f.irregular = true;
    f.receiver_depth_m = {30, 10, 30, 5};
    f.range_m = {20, 5, 20, 0};
    for (int k = 0; k < 8; ++k) f.pressure.emplace_back(static_cast<float>(k), 0.5F);
    for (const ShdLayout layout : {ShdLayout::of_2022, ShdLayout::of_2023}) {
        const std::string file = write_shd(f, layout);
        ASSERT_EQ(file.size(), 12U * 4 * 41);
        EXPECT_EQ(file.substr(4 * 41, 10), "irregular ");
        EXPECT_EQ(at<std::int32_t>(file, 2 * 4 * 41 + 20), 4);
        EXPECT_EQ(at<std::int32_t>(file, 2 * 4 * 41 + 24), 4);
        EXPECT_EQ(at<float>(file, 11 * 4 * 41 + 8), 5.0F);  // source 1, pair 1
        const ShdFile g = read_shd(file);
        EXPECT_TRUE(g.irregular);
        EXPECT_EQ(g.range_m, f.range_m);
        EXPECT_EQ(g.receiver_depth_m, f.receiver_depth_m);
        EXPECT_EQ(g.pressure, f.pressure);
    }
    f.receiver_depth_m.pop_back();
    EXPECT_EQ(refusal(write_shd(f, ShdLayout::of_2023)),
              "it is irregular, with 3 depths and 4 ranges");
}

TEST(ShdFile, LastRecordMayBeShort) {
    const ShdFile f = field(4);
    std::string file = write_shd(f, ShdLayout::of_2023);
    file.resize(file.size() - 41 * 4 + 4 * 8);  // gfortran writes no more than there is
    EXPECT_EQ(read_shd(file).pressure, f.pressure);
    file.pop_back();
    EXPECT_EQ(refusal(file), "it is cut at byte " + std::to_string(file.size()));
}

TEST(ShdFile, RefusesWhatItIsNot) {
    const std::string file = write_shd(field(4), ShdLayout::of_2023);
    EXPECT_EQ(refusal(""), "it is cut at byte 0");
    EXPECT_EQ(refusal(std::string(2000, '\0')),
              "it has records of 0 words, which is outside 41 to 268435456");
    std::string other = file;
    other[2 * 41 * 4] = 2;
    EXPECT_EQ(refusal(other), "it holds more than one frequency, bearing or source position");
    other = file;
    other[2 * 41 * 4 + 24] = 100;
    EXPECT_EQ(refusal(other), "it has 100 ranges in a record of 164 bytes");
    other = file;
    std::memset(other.data() + std::size_t{9} * 41 * 4, 0, 64);
    EXPECT_EQ(refusal(other), "it has ranges in no order");
}

TEST(ArrFile, Text) {
    std::istringstream file(write_arr(two_receivers(), ArrForm::text));
    std::string line;
    std::vector<std::string> lines;
    while (std::getline(file, line)) lines.push_back(line);
    ASSERT_EQ(lines.size(), 10U);
    EXPECT_EQ(lines[0], "'2D'");
    EXPECT_EQ(std::stod(lines[1]), 1000);
    EXPECT_EQ(lines[2], "1 30");
    EXPECT_EQ(lines[3], "2 10 20");
    EXPECT_EQ(lines[4], "1 500.5");
    EXPECT_EQ(lines[5], "2");  // the most at one receiver
    EXPECT_EQ(lines[6], "2");
    EXPECT_EQ(lines[9], "0");
    std::istringstream row(lines[7]);
    double amplitude = 0, phase = 0, delay = 0, imaginary = 0, launch = 0, arrived = 0;
    int top = 0, bottom = 0;
    row >> amplitude >> phase >> delay >> imaginary >> launch >> arrived >> top >> bottom;
    EXPECT_TRUE(row.eof() && !row.fail());
    EXPECT_EQ(amplitude, 0.01);
    EXPECT_EQ(phase, 180);
    EXPECT_EQ(delay, 0.335);
    // exp(2 pi f im) is the amplitude's loss of 3 dB
    EXPECT_NEAR(20 * std::log10(std::exp(2 * std::numbers::pi * 1000 * imaginary)), -3, 1e-6);
    EXPECT_EQ(launch, -10.5);
    EXPECT_EQ(arrived, 11);
    EXPECT_EQ(top, 2);
    EXPECT_EQ(bottom, 1);
}

TEST(ArrFile, ReadsWhatItWrites) {
    const ArrFile f = two_receivers(), g = read_arr(write_arr(f, ArrForm::text));
    EXPECT_EQ(g.range_m, f.range_m);
    ASSERT_EQ(g.receivers.size(), 2U);
    ASSERT_EQ(g.receivers[0].arrivals.size(), 2U);
    const propagation::Arrival &a = f.receivers[0].arrivals[1], &b = g.receivers[0].arrivals[1];
    EXPECT_EQ(a.delay_s, b.delay_s);
    EXPECT_NEAR(a.absorption_db, b.absorption_db, 1e-6);
    EXPECT_EQ(a.bottom_bounces, b.bottom_bounces);
    EXPECT_EQ(g.receivers[1].depth_m, 20);
}

TEST(ArrFile, PairsAreReadAsTheyAreWritten) {
    ArrFile f = two_receivers();
    f.irregular = true;
    f.range_m = {500.5, 400};
    f.receivers[1].range_m = 400;
    const ArrFile g = read_arr(write_arr(f, ArrForm::text), true);
    ASSERT_EQ(g.receivers.size(), 2U);
    EXPECT_EQ(g.receivers[0].arrivals.size(), 2U);
    EXPECT_EQ(g.receivers[1].depth_m, 20);
    EXPECT_EQ(g.receivers[1].range_m, 400);
    EXPECT_TRUE(g.receivers[1].arrivals.empty());
    f.range_m.push_back(300);
    EXPECT_THROW(read_arr(write_arr(f, ArrForm::text), true), DataError);
}

TEST(ArrFile, BinaryIsRecordsOfFortran) {
    const std::string file = write_arr(two_receivers(), ArrForm::binary);
    std::vector<std::string> records;
    for (std::size_t k = 0; k < file.size();) {
        const auto n = static_cast<std::size_t>(at<std::int32_t>(file, k));
        ASSERT_LE(k + n + 8, file.size());
        records.push_back(file.substr(k + 4, n));
        EXPECT_EQ(at<std::int32_t>(file, k + 4 + n), static_cast<std::int32_t>(n));
        k += n + 8;
    }
    ASSERT_EQ(records.size(), 10U);
    EXPECT_EQ(records[0], "'2D'");
    EXPECT_EQ(at<float>(records[1], 0), 1000.0F);
    EXPECT_EQ(at<std::int32_t>(records[3], 0), 2);
    EXPECT_EQ(at<float>(records[3], 8), 20.0F);
    EXPECT_EQ(at<float>(records[4], 4), 500.5F);
    EXPECT_EQ(at<std::int32_t>(records[6], 0), 2);
    ASSERT_EQ(records[8].size(), 32U);
    EXPECT_EQ(at<float>(records[8], 0), 0.005F);
    EXPECT_EQ(at<float>(records[8], 8), 0.34F);
    EXPECT_EQ(at<float>(records[8], 24), 2.0F);
    EXPECT_EQ(at<float>(records[8], 28), 1.0F);
    EXPECT_EQ(at<std::int32_t>(records[9], 0), 0);
}

}  // namespace seautils::toolbox
