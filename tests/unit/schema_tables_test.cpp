// Messages that tools declare by a table are those of the schema.
#include "../tools/ssp_schema.hpp"
#include "../tools/tl_schema.hpp"
#include "seautils/schema/pool.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace seautils::schema {

namespace {

std::set<std::string> compared;

void expect_same(const EnumLayout& a, const EnumLayout& b) {
    EXPECT_EQ(a.full_name, b.full_name);
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        EXPECT_EQ(a.values[k].name, b.values[k].name);
        EXPECT_EQ(a.values[k].number, b.values[k].number);
    }
}

/// @param a  of a table  @param b  of the schema
void expect_same(const Layout& a, const Layout& b) {
    SCOPED_TRACE(b.full_name);
    EXPECT_EQ(a.full_name, b.full_name);
    if (!compared.insert(b.full_name).second) return;
    ASSERT_EQ(a.fields.size(), b.fields.size());
    for (std::size_t k = 0; k < a.fields.size(); ++k) {
        const Field &f = a.fields[k], &g = b.fields[k];
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
}

}  // namespace

TEST(SchemaTables, AreWhatTheirFileSays) {
    Pool pool;
    pool.load(SEAUTILS_SOURCE_DIR "/schemas/seautils/acoustics.proto");
    const auto of = [&](const char* name) -> const Layout& {
        return pool.layout(pool.message(std::string("seautils.") + name));
    };
    const tools::TlSchema tl;
    const tools::SspSchema ssp;
    expect_same(tl.request(), of("TlRequest"));
    expect_same(tl.answer(), of("TlAnswer"));
    expect_same(ssp.sample(), of("CtdSample"));
    expect_same(ssp.profile(), of("SoundSpeedProfile"));
    for (const auto* message : pool.messages())
        EXPECT_TRUE(compared.contains(message->full_name())) << message->full_name();
}

}  // namespace seautils::schema
