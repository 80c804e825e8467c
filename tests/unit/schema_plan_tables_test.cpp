// The messages that depth-plan declares by a table are those of plan.proto.
#include "../tools/depth_schema.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace seautils::schema {

namespace {

class PlanTables : public testing::Test {
protected:
    void expect_same(const EnumLayout& a, const EnumLayout& b) {
        EXPECT_EQ(a.full_name, b.full_name);
        ASSERT_EQ(a.values.size(), b.values.size());
        for (std::size_t k = 0; k < a.values.size(); ++k) {
            EXPECT_EQ(a.values[k].name, b.values[k].name);
            EXPECT_EQ(a.values[k].number, b.values[k].number);
        }
    }

    /// @param a  of a table  @param b  of the schema, of which the table may have the first fields
    void expect_same(const Layout& a, const Layout& b, bool all = true) {
        SCOPED_TRACE(b.full_name);
        EXPECT_EQ(a.full_name, b.full_name);
        if (!compared_.insert(b.full_name).second) return;
        ASSERT_LE(a.fields.size(), b.fields.size());
        if (all) {
            ASSERT_EQ(a.fields.size(), b.fields.size());
        }
        for (std::size_t k = 0; k < a.fields.size(); ++k) expect_same(a.fields[k], b.fields[k]);
    }

    void expect_same(const Field& f, const Field& g) {
        SCOPED_TRACE(g.name);
        EXPECT_EQ(f.name, g.name);
        EXPECT_EQ(f.number, g.number);
        EXPECT_EQ(f.kind, g.kind);
        EXPECT_EQ(f.wire_form, g.wire_form);
        EXPECT_EQ(f.repeated, g.repeated);
        EXPECT_EQ(f.packed, g.packed);
        EXPECT_EQ(f.has_presence || f.repeated, g.has_presence || g.repeated);
        ASSERT_EQ(f.message == nullptr, g.message == nullptr);
        if (f.message != nullptr) expect_same(*f.message, *g.message);
        ASSERT_EQ(f.enumeration == nullptr, g.enumeration == nullptr);
        if (f.enumeration != nullptr) expect_same(*f.enumeration, *g.enumeration);
    }

    const Layout& of(const char* name) {
        return pool_.layout(pool_.message(std::string("seautils.") + name));
    }

    Pool pool_;
    std::set<std::string> compared_;
    tools::DepthSchema table_;
};

TEST_F(PlanTables, AreWhatTheirFileSays) {
    pool_.load(SEAUTILS_SOURCE_DIR "/schemas/seautils/plan.proto");
    expect_same(table_.state(), of("DepthState"));
    expect_same(table_.objective(), of("DepthObjective"));
    expect_same(table_.decision(), of("DepthDecision"));
    expect_same(table_.link(), of("LinkSample"));
    expect_same(table_.curve(), of("ReceiptCurve"));
    expect_same(table_.summary(), of("LossSummary"));
    for (const auto* message : pool_.messages())
        EXPECT_TRUE(compared_.contains(message->full_name())) << message->full_name();
}

TEST_F(PlanTables, KnowTheBeginningOfAnAnswer) {
    pool_.load(SEAUTILS_SOURCE_DIR "/schemas/seautils/acoustics.proto");
    const auto messages = pool_.messages();
    const bool has = std::any_of(messages.begin(), messages.end(), [](const auto* message) {
        return message->full_name() == "seautils.TlAnswer";
    });
    if (!has) GTEST_SKIP() << "tl-model is not there yet";
    expect_same(table_.answer(), of("TlAnswer"), false);
}

}  // namespace

}  // namespace seautils::schema
