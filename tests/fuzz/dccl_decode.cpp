// Any bytes under schemas with every codec: decoding never reads behind the end, and what it gives,
// encoded again, is a form that stays the same. Input: a byte that chooses the type and the way,
// then the frame without its identifier.
#include "common.hpp"

#include "seautils/dccl/models.hpp"
#include "seautils/dccl/type_set.hpp"
#include "seautils/schema/json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <list>
#include <memory>

using namespace seautils;

namespace {

constexpr const char* model = R"(name: "delta" frequency: 1 frequency: 5 frequency: 20 frequency: 5
    eof_frequency: 4 out_of_range_frequency: 2 value_bound: [-2, -1, 0, 1, 2])";

/// Each type alone: its identifier need not be guessed. Of our own schemas, and where they are there
/// of the vectors'.
class Types {
public:
    Types() {
        load(SEAUTILS_SOURCE_DIR "/tests/fuzz/schemas", ours_);
        fuzz::require(ours_.size() >= 8, "there are types to decode");
        const char* shared = std::getenv("SEAUTILS_SHARED");
        const std::string root = shared != nullptr ? shared : SEAUTILS_SOURCE_DIR "/../shared";
        load(root + "/vectors/dccl/schemas", vectors_);
    }

    const std::shared_ptr<const dccl::Program>& operator[](unsigned choice) const {
        const auto& programs = choice < 128 || vectors_.empty() ? ours_ : vectors_;
        return programs[choice % 128 % programs.size()];
    }

private:
    using Programs = std::vector<std::shared_ptr<const dccl::Program>>;

    void load(const std::string& folder, Programs& programs) {
        if (!std::filesystem::is_directory(folder)) return;
        schema::Pool& pool = pools_.emplace_back();
        pool.load(folder);
        dccl::ProgramOptions options;
        dccl::add_model(model, options.models);
        for (const auto* descriptor : pool.messages()) {
            fuzz::accepted([&] {
                programs.push_back(dccl::Program::compile(pool.layout(*descriptor), options));
            });
        }
    }

    std::list<schema::Pool> pools_;
    Programs ours_, vectors_;
};

}  // namespace

namespace {

bool has(const dccl::Program& program, bool (*is)(const dccl::Op&)) {
    return std::any_of(program.head().begin(), program.head().end(), is) ||
           std::any_of(program.body().begin(), program.body().end(), is);
}

/// A time of day beyond the day, which no encoder writes, may mean the later of two times that are
/// as near to the clock; written again it is the earlier.
bool has_times(const dccl::Program& program) {
    return has(program, [](const dccl::Op& op) { return op.kind == dccl::OpKind::time; });
}

/// CCL's codes, and integers in steps that have a fraction, are cut off and not rounded: each
/// passage may lose a step more.
bool drifts(const dccl::Program& program) {
    return has(program, [](const dccl::Op& op) {
        const dccl::NumberCode& n = op.number;
        return op.kind == dccl::OpKind::ccl ||
               (op.kind == dccl::OpKind::integer && n.resolution != std::trunc(n.resolution));
    });
}

std::string frame_of(const dccl::Program& program, std::string_view rest) {
    std::string frame;
    for (unsigned bits = 0; bits < program.id_bits(); bits += 8) {
        frame += static_cast<char>(program.id_code() >> bits & 0xff);
    }
    return frame.append(rest);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    static const Types types;
    const auto& program = types[data[0]];
    dccl::CodecOptions options;
    options.now_s = 1'700'000'000;
    options.lenient = (data[1] & 1) != 0;
    options.full_time_resolution = (data[1] & 2) != 0;
    if ((data[1] & 4) != 0) options.passphrase = "fuzz";
    options.header_only = (data[1] & 24) == 24;
    dccl::Codec codec(options);
    codec.load(program);
    schema::Values values, again;
    const std::string frame = frame_of(*program, fuzz::view(data + 2, size - 2));
    std::size_t used = 0;
    if (!fuzz::accepted([&] { used = codec.decode(frame, values, program.get()).bytes; })) return 0;
    fuzz::require(used <= frame.size(), "no more bytes are taken than there are");
    std::string json, canonical, second;
    schema::write_json(values, json);
    fuzz::context = program->name() + ": " + json;
    // Adaptive models have learnt: start afresh.
    dccl::Codec encoder(options), decoder(options), last(options);
    for (dccl::Codec* c : {&encoder, &decoder, &last}) c->load(program);
    if (!fuzz::accepted([&] { encoder.encode(*program, values, canonical); })) return 0;
    fuzz::require(canonical.size() <= program->largest_bytes(), "no frame is above the largest");
    // The lenient way unsets what is out of range; conditions and version 2's empty messages go by that.
    if (options.lenient) return 0;
    fuzz::require(decoder.decode(canonical, again, program.get()).bytes == canonical.size(),
                  "a frame is taken whole");
    json.clear();
    schema::write_json(again, json);
    fuzz::context += "\nagain: " + json;
    if (drifts(*program)) return 0;
    fuzz::require(has_times(*program) || schema::equal(values, again), "decode(encode(m)) is m");
    if (fuzz::accepted([&] { last.encode(*program, again, second); })) {
        fuzz::require(second == canonical, "encode(decode(b)) is b where b is canonical");
    }
    return 0;
}
