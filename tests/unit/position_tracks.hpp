// The reference tracks of $SEAUTILS_SHARED (default ../shared), and what a codec makes of them.
#ifndef SEAUTILS_TESTS_POSITION_TRACKS_HPP
#define SEAUTILS_TESTS_POSITION_TRACKS_HPP

#include "seautils/position/codec.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace seautils::position {

inline std::string vectors_folder() {
    const char* shared = std::getenv("SEAUTILS_SHARED");
    const std::string root =
        shared != nullptr ? shared : std::string(SEAUTILS_SOURCE_DIR) + "/../shared";
    return root + "/vectors/poscode";
}

struct TimedCell {
    double time_s;
    Cell cell;  ///< of 1 m
};

inline std::string content_of(const std::string& path) {
    const bool plain = std::filesystem::exists(path);
    std::FILE* pipe =
        popen(((plain ? "cat '" : "gzip -dc '") + path + (plain ? "'" : ".gz'")).c_str(), "r");
    std::string content;
    for (char block[65536]; const std::size_t n = std::fread(block, 1, sizeof block, pipe);)
        content.append(block, n);
    return pclose(pipe) == 0 ? content : "";
}

inline std::vector<TimedCell> track_of(const std::string& file) {
    std::istringstream lines(content_of(vectors_folder() + "/" + file));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "t,x,y,z");
    std::vector<TimedCell> fixes;
    while (std::getline(lines, line)) {
        double t = 0, x = 0, y = 0, z = 0;
        EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &t, &x, &y, &z), 4) << line;
        const auto cell = [](double v) { return static_cast<std::int32_t>(std::floor(v + 0.5)); };
        fixes.push_back({t, {cell(x), cell(y), cell(z)}});
    }
    return fixes;
}

inline bool shared_tracks() { return std::filesystem::exists(vectors_folder() + "/expected.json"); }

using StraightRun = std::vector<Cell>;  ///< positions without a gap

struct ReferenceTrack {
    std::string file;
    std::vector<StraightRun> runs;                  ///< without gaps
    double thesis_alone = 0, alone = 0, eight = 0;  ///< bits a delta: reference figures
};

inline std::vector<StraightRun> runs_of(const std::vector<TimedCell>& fixes, double tau_s) {
    std::vector<StraightRun> runs;
    double last_s = -1e18;
    for (const TimedCell& fix : fixes) {
        if (fix.time_s - last_s > 1.5 * tau_s) runs.emplace_back();
        last_s = fix.time_s;
        runs.back().push_back(fix.cell);
    }
    return runs;
}

inline std::vector<ReferenceTrack> reference_tracks() {
    std::ifstream file(vectors_folder() + "/expected.json");
    std::vector<ReferenceTrack> tracks;
    for (const auto& e : nlohmann::json::parse(file)) {
        ReferenceTrack t;
        t.file = e.at("file").get<std::string>();
        t.runs = runs_of(track_of(t.file), e.at("tau_s").get<double>());
        t.thesis_alone =
            std::min(e.at("thesis").at("Fixed Adaptive").at("one_per_packet").get<double>(),
                     e.at("thesis").at("Kalman Adaptive").at("one_per_packet").get<double>());
        t.alone = e.at("prototype_cold").at("one_huffman").get<double>();
        t.eight = e.at("prototype_prior").at("ac8").get<double>();
        tracks.push_back(std::move(t));
    }
    return tracks;
}

/// What a delta costs with so many a packet (fewer at the end of a run), decoded too.
inline double bits_a_delta(const std::vector<StraightRun>& runs, const CodecOptions& options,
                           std::size_t per_packet) {
    const auto sender = make_codec(options), receiver = sender->clone();
    std::size_t bits_in_all = 0, deltas = 0;
    for (const StraightRun& run : runs) {
        sender->restart(run[0]);
        receiver->restart(run[0]);
        for (std::size_t at = 1; at < run.size();) {
            const std::size_t count = std::min(per_packet, run.size() - at);
            entropy::BitString bits;
            entropy::Encoder out(bits);
            if (per_packet == 1) sender->encode_alone(run[at], bits);
            for (std::size_t k = 0; per_packet > 1 && k < count; ++k)
                sender->encode(run[at + k], out);
            if (per_packet > 1) out.finish();
            entropy::BitReader reader(bits.bytes(), bits.size());
            entropy::Decoder in(reader);
            for (std::size_t k = 0; k < count; ++k)
                EXPECT_EQ(per_packet == 1 ? receiver->decode_alone(reader) : receiver->decode(in),
                          run[at + k]);
            EXPECT_EQ(reader.left(), 0U);
            bits_in_all += bits.size();
            deltas += count;
            at += count;
        }
    }
    return static_cast<double>(bits_in_all) / static_cast<double>(deltas);
}

}  // namespace seautils::position

#endif  // SEAUTILS_TESTS_POSITION_TRACKS_HPP
