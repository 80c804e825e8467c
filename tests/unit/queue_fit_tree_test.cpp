#include "seautils/queue/fit_tree.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace seautils::queue {
namespace {

bool older(const FitNode* a, const FitNode* b) {
    return a->born_ns != b->born_ns ? a->born_ns < b->born_ns : a->sequence < b->sequence;
}

/// What a FitTree does, by looking at each.
struct Plain {
    std::vector<FitNode*> nodes;

    void insert(FitNode& node) {
        nodes.insert(std::upper_bound(nodes.begin(), nodes.end(), &node, older), &node);
    }
    FitNode* find(const Fit& fit, bool newest_first) const {
        const auto fits = [&](const FitNode* n) {
            return n->bytes <= fit.bytes && (fit.acks || !n->ack) && n->born_ns >= fit.born_ns;
        };
        if (!newest_first) {
            const auto found = std::find_if(nodes.begin(), nodes.end(), fits);
            return found == nodes.end() ? nullptr : *found;
        }
        const auto found = std::find_if(nodes.rbegin(), nodes.rend(), fits);
        return found == nodes.rend() ? nullptr : *found;
    }
};

void compare(const FitTree& tree, const Plain& plain) {
    RC_ASSERT(tree.is_empty() == plain.nodes.empty());
    RC_ASSERT(tree.oldest() == (plain.nodes.empty() ? nullptr : plain.nodes.front()));
    Fit fit{*rc::gen::inRange<std::uint32_t>(0, 12), *rc::gen::arbitrary<bool>()};
    RC_ASSERT(tree.may_fit(fit) == (plain.find(fit, true) != nullptr));
    if (*rc::gen::arbitrary<bool>()) fit.born_ns = *rc::gen::inRange(-1, 11);
    RC_ASSERT(tree.find(fit, true) == plain.find(fit, true));
    RC_ASSERT(tree.find(fit, false) == plain.find(fit, false));
}

TEST(FitTree, FindsWhatAPlainSearchFinds) {
    EXPECT_TRUE(rc::check("insert, erase, find", [] {
        std::deque<FitNode> nodes;
        FitTree tree;
        Plain plain;
        const int steps = *rc::gen::inRange(0, 60);
        for (int k = 0; k < steps; ++k) {
            if (plain.nodes.empty() || *rc::gen::inRange(0, 3) > 0) {
                FitNode& node = nodes.emplace_back();
                node.born_ns = *rc::gen::inRange(0, 10);
                node.sequence = nodes.size();
                node.bytes = *rc::gen::inRange<std::uint32_t>(1, 12);
                node.ack = *rc::gen::arbitrary<bool>();
                tree.insert(node);
                plain.insert(node);
            } else {
                const auto at = *rc::gen::inRange<std::size_t>(0, plain.nodes.size());
                tree.erase(*plain.nodes[at]);
                plain.nodes.erase(plain.nodes.begin() + static_cast<std::ptrdiff_t>(at));
            }
            compare(tree, plain);
        }
    }));
}

TEST(FitTree, IsShallowWhateverTheOrder) {
    // A search that is not logarithmic would take minutes; a deep recursion would end the program.
    std::vector<FitNode> nodes(200'000);
    FitTree tree;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        nodes[k].born_ns = static_cast<std::int64_t>(k);
        nodes[k].sequence = k;
        nodes[k].bytes = k == 0 ? 1 : 2;
        tree.insert(nodes[k]);
    }
    for (int k = 0; k < 200'000; ++k) ASSERT_EQ(tree.find({1}, true), nodes.data());
    for (FitNode& node : nodes) tree.erase(node);
    EXPECT_TRUE(tree.is_empty());
}

}  // namespace
}  // namespace seautils::queue
