// Modes against the reference fields of ../shared/cases, to the tolerances of specs/acoustics-accuracy.md.
#include "propagation_cases.hpp"

#include "seautils/propagation/modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

namespace seautils::propagation {
namespace {

struct Score {
    double median = 0, p95 = 0;
    std::size_t missing = 0;
};

Score score(const Environment& e, const Field& field, const std::vector<double>& losses,
            double beyond_m) {
    Score s;
    std::vector<double> d;
    EXPECT_EQ(losses.size(), field.loss_db.size());
    for (std::size_t k = 0; k < losses.size(); ++k) {
        if (!(losses[k] < 110) || e.receivers.range_m[k % field.ranges] <= beyond_m) continue;
        if (std::isfinite(field.loss_db[k]))
            d.push_back(std::abs(field.loss_db[k] - losses[k]));
        else
            ++s.missing;
    }
    std::sort(d.begin(), d.end());
    s.median = d[d.size() / 2];
    s.p95 = d[d.size() * 95 / 100];
    return s;
}

struct Held {
    const char *name, *reference;
    Sum sum;
    double beyond_m, median, p95;
};
class PropagationModesCase : public testing::TestWithParam<Held> {};

TEST_P(PropagationModesCase, IsWithinItsTolerance) {
    const Held held = GetParam();
    if (!std::filesystem::exists(cases())) GTEST_SKIP() << "no reference cases";
    const ReferenceCase world(held.name);
    const Environment& e = world.sea;
    FieldOptions options;
    options.sum = held.sum;
    const Score s = score(e, mode_field(e, options), world.grid(held.reference), held.beyond_m);
    EXPECT_LE(s.median, held.median);
    EXPECT_LE(s.p95, held.p95);
    EXPECT_EQ(s.missing, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Cases, PropagationModesCase,
    testing::Values(Held{"p2-pekeris-250", "analytic_coh", Sum::coherent, 300, 0.01, 0.06},  // C1
                    Held{"p2-pekeris-250", "krakenc_coh", Sum::coherent, 300, 0.04, 0.25},
                    Held{"p4-munk-50", "krakenc_coh", Sum::coherent, 15000, 0.04, 0.7},  // C2
                    Held{"p4-munk-50", "krakenc_inc", Sum::incoherent, 15000, 0.04, 0.25}));

TEST(PropagationWavenumberCase, PekerisIsAsByContourIntegration) {
    if (!std::filesystem::exists(cases())) GTEST_SKIP() << "no reference cases";
    const ReferenceCase world("p2-pekeris-250");
    const Environment& e = world.sea;
    FieldOptions options;
    options.sum = Sum::coherent;
    const Score s = score(e, wavenumber_field(e, options), world.grid("analytic_coh"), 0);
    EXPECT_LE(s.median, 0.01);
    EXPECT_LE(s.p95, 0.06);
}

}  // namespace
}  // namespace seautils::propagation
