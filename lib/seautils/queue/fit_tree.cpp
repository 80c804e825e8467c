#include "seautils/queue/fit_tree.hpp"

#include <algorithm>
#include <tuple>

namespace seautils::queue {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

bool FitTree::before(const FitNode& a, const FitNode& b) {
    return std::tie(a.born_ns, a.sequence) < std::tie(b.born_ns, b.sequence);
}

/// The heap's order: scattered, and the same in each run (the mixer of SplitMix64).
std::uint64_t FitTree::weight(const FitNode& node) {
    std::uint64_t x = node.sequence + 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

void FitTree::refresh(FitNode& node) {
    node.least_any_ = node.bytes;
    node.least_no_ack_ = node.ack ? none : node.bytes;
    for (const FitNode* child : {node.left_, node.right_}) {
        if (child == nullptr) continue;
        node.least_any_ = std::min(node.least_any_, child->least_any_);
        node.least_no_ack_ = std::min(node.least_no_ack_, child->least_no_ack_);
    }
}

bool FitTree::below_fits(const FitNode* node, const Fit& fit) {
    return node != nullptr && (fit.acks ? node->least_any_ : node->least_no_ack_) <= fit.bytes;
}

FitNode* FitTree::join(FitNode* left, FitNode* right) {
    if (left == nullptr) return right;
    if (right == nullptr) return left;
    if (weight(*left) > weight(*right)) {
        left->right_ = join(left->right_, right);
        refresh(*left);
        return left;
    }
    right->left_ = join(left, right->left_);
    refresh(*right);
    return right;
}

void FitTree::split(FitNode* tree, const FitNode& at, FitNode*& left, FitNode*& right) {
    if (tree == nullptr) {
        left = right = nullptr;
    } else if (before(*tree, at)) {
        left = tree;
        split(tree->right_, at, tree->right_, right);
        refresh(*tree);
    } else {
        right = tree;
        split(tree->left_, at, left, tree->left_);
        refresh(*tree);
    }
}

FitNode* FitTree::put(FitNode* tree, FitNode& node) {
    if (tree == nullptr || weight(node) > weight(*tree)) {
        split(tree, node, node.left_, node.right_);
        refresh(node);
        return &node;
    }
    FitNode*& child = before(node, *tree) ? tree->left_ : tree->right_;
    child = put(child, node);
    refresh(*tree);
    return tree;
}

FitNode* FitTree::take(FitNode* tree, const FitNode& node) {
    if (tree == &node) return join(tree->left_, tree->right_);
    FitNode*& child = before(node, *tree) ? tree->left_ : tree->right_;
    child = take(child, node);
    refresh(*tree);
    return tree;
}

void FitTree::insert(FitNode& node) {
    node.left_ = node.right_ = nullptr;
    root_ = put(root_, node);
}

void FitTree::erase(FitNode& node) { root_ = take(root_, node); }

FitNode* FitTree::oldest() const {
    FitNode* node = root_;
    while (node != nullptr && node->left_ != nullptr) node = node->left_;
    return node;
}

bool FitTree::may_fit(const Fit& fit) const { return below_fits(root_, fit); }

/// What is too old stands to the left: a search goes there only where the node itself is young
/// enough, so that it fails at most once in each direction on its way.
FitNode* FitTree::find_below(FitNode* tree, const Fit& fit, bool newest_first) {
    if (!below_fits(tree, fit)) return nullptr;
    if (tree->born_ns < fit.born_ns) return find_below(tree->right_, fit, newest_first);
    FitNode* const first = newest_first ? tree->right_ : tree->left_;
    FitNode* const last = newest_first ? tree->left_ : tree->right_;
    if (FitNode* const found = find_below(first, fit, newest_first)) return found;
    if (tree->bytes <= fit.bytes && (fit.acks || !tree->ack)) return tree;
    return find_below(last, fit, newest_first);
}

FitNode* FitTree::find(const Fit& fit, bool newest_first) const {
    return find_below(root_, fit, newest_first);
}

}  // namespace seautils::queue
