// decode(encode(m)) is within half a resolution of m, and the sizes are those that the program states.
#include "seautils/core/error.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace seautils::dccl {
namespace {

/// The types of a folder of schemas that compile by themselves.
class Types {
public:
    explicit Types(const std::string& folder) {
        pool_.load(std::string(SEAUTILS_SOURCE_DIR) + folder);
        for (const auto* descriptor : pool_.messages()) {
            try {
                programs.push_back(Program::compile(pool_.layout(*descriptor)));
            } catch (const ConfigError&) {
            }
        }
    }
    std::vector<std::shared_ptr<const Program>> programs;

private:
    schema::Pool pool_;
};

/// Visits each number that is present: its step, its code, its slot.
template <class Visit>
class Numbers {
public:
    Numbers(schema::Values& values, Visit visit) : values_(values), visit_(visit) {}

    void steps(const std::vector<Op>& ops, std::size_t first, std::size_t last,
               std::uint32_t block) {
        for (std::size_t at = first; at < last; at = ops[at].end) {
            const Op& op = ops[at];
            if (op.kind == OpKind::selectors) continue;
            const std::uint32_t slot = block + op.slot;
            if (!values_[slot].present) continue;
            const std::uint32_t count = op.repeated ? values_[slot].aux : 1;
            for (std::uint32_t k = 0; k < count; ++k) {
                one(ops, at, op.repeated ? static_cast<std::uint32_t>(values_[slot].u) + k : slot);
            }
        }
    }

private:
    void one(const std::vector<Op>& ops, std::size_t at, std::uint32_t slot) {
        const Op& op = ops[at];
        if (op.kind == OpKind::message) {
            steps(ops, at + 1, op.end, static_cast<std::uint32_t>(values_[slot].u));
        } else if (op.kind == OpKind::floating && op.condition < 0) {
            visit_(op.number, values_[slot]);
        }
    }

    schema::Values& values_;
    Visit visit_;
};

template <class Visit>
void each_number(const Program& program, schema::Values& values, Visit visit) {
    Numbers<Visit> numbers(values, visit);
    numbers.steps(program.head(), 0, program.head().size(), 0);
    numbers.steps(program.body(), 0, program.body().size(), 0);
}

/// A message out of random bits: every field has some code.
bool any_message(Codec& codec, const Program& program, schema::Values& values) {
    std::string frame;
    for (unsigned bits = 0; bits < program.id_bits(); bits += 8) {
        frame += static_cast<char>(program.id_code() >> bits & 0xff);
    }
    for (int k = 0; k < 300; ++k) frame += static_cast<char>(*rc::gen::inRange(0, 256));
    try {
        codec.decode(frame, values, &program);
        return true;
    } catch (const DataError&) {  // a hash that differs, too many elements
        return false;
    }
}

std::string json_of(const schema::Values& values) {
    std::string text;
    schema::write_json(values, text);
    return text;
}

struct Tally {
    int messages = 0, numbers = 0;
};

void check_one(const Program& program, const std::shared_ptr<const Program>& shared, Tally& tally) {
    CodecOptions options;
    options.now_s = 1'700'000'000;
    Codec codec(options);
    codec.load(shared);
    schema::Values values, back;
    if (!any_message(codec, program, values)) return;
    // Off the grid, but within the bounds.
    each_number(program, values, [&](const NumberCode& n, schema::Slot& slot) {
        const double off = *rc::gen::inRange(-49, 50) / 100.0 * n.resolution;
        slot.d = std::fmin(std::fmax(slot.d + off, n.min), n.max);
        if (n.kind == schema::Kind::float32)
            slot.d = static_cast<double>(static_cast<float>(slot.d));
        if (slot.d < n.min || slot.d > n.max) slot.d = std::round((n.min + n.max) / 2);
    });
    std::string bytes;
    try {
        codec.encode(program, values, bytes);
    } catch (const DataError&) {  // a code above the greatest value, in a number that is no float
        return;
    }
    RC_LOG() << program.name() << " " << json_of(values) << "\n";
    ++tally.messages;
    RC_ASSERT(bytes.size() <= program.largest_bytes());
    RC_ASSERT(bytes.size() >= program.smallest_bytes());
    RC_ASSERT(codec.decode(bytes, back, &program).bytes == bytes.size());
    std::vector<double> sent, got;
    std::vector<NumberCode> codes;
    each_number(program, values, [&](const NumberCode& n, schema::Slot& s) {
        sent.push_back(s.d);
        codes.push_back(n);
    });
    each_number(program, back, [&](const NumberCode&, schema::Slot& s) { got.push_back(s.d); });
    RC_LOG() << json_of(back);
    RC_ASSERT(sent.size() == got.size());
    for (std::size_t k = 0; k < sent.size(); ++k) {
        // binary32 has 24 bits for the value and for the step beside it
        const double slack = codes[k].kind == schema::Kind::float32 ? std::fabs(sent[k]) * 1.2e-7
                                                                    : std::fabs(sent[k]) * 1e-15;
        RC_ASSERT(std::fabs(sent[k] - got[k]) <= codes[k].resolution / 2 * (1 + 1e-9) + slack);
        ++tally.numbers;
    }
    // What came back is on the grid: it stays.
    std::string again;
    codec.encode(program, back, again);
    RC_ASSERT(again == bytes);
}

class Laws : public testing::TestWithParam<const char*> {};

TEST_P(Laws, WithinHalfAResolution) {
    const Types types(GetParam());
    Tally tally;
    ASSERT_FALSE(types.programs.empty());
    for (const auto& program : types.programs) {
        if (program->name().starts_with("sink_ccl")) continue;  // cut off, not rounded
        EXPECT_TRUE(rc::check(program->name(), [&] { check_one(*program, program, tally); }));
    }
    EXPECT_GT(tally.messages, 100);
    EXPECT_GT(tally.numbers, 200);
}
INSTANTIATE_TEST_SUITE_P(Dccl, Laws, testing::Values("/schemas/seautils", "/tests/fuzz/schemas"));

}  // namespace
}  // namespace seautils::dccl
