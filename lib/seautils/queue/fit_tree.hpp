#ifndef SEAUTILS_QUEUE_FIT_TREE_HPP
#define SEAUTILS_QUEUE_FIT_TREE_HPP

#include <cstdint>
#include <limits>

namespace seautils::queue {

/// A place in a FitTree; what stands in it derives from this.
struct FitNode {
    std::int64_t born_ns = 0;    ///< the order: by this,
    std::uint64_t sequence = 0;  ///< then by this, which is unique
    std::uint32_t bytes = 0;     ///< its size
    bool ack = false;            ///< whether it wants an acknowledgement

private:
    friend class FitTree;
    FitNode* left_ = nullptr;
    FitNode* right_ = nullptr;
    std::uint32_t least_any_ = 0;     ///< fewest bytes of it and of those below
    std::uint32_t least_no_ack_ = 0;  ///< the same, of those that want no acknowledgement
};

/// What a message must satisfy to go.
struct Fit {
    std::uint32_t bytes = 0;  ///< at most this long
    bool acks = true;         ///< false: only one that wants no acknowledgement
    std::int64_t born_ns = std::numeric_limits<std::int64_t>::min();  ///< not older
};

/// Nodes in order of age, of which the first that fits is found without looking at those before it:
/// a treap in which each node knows the least size below it. Owns nothing. Insertion, removal and
/// search take time in proportion to the logarithm of their number.
class FitTree {
public:
    void insert(FitNode& node);
    /// @param node  stands in this tree, with its order as it was
    void erase(FitNode& node);

    bool is_empty() const { return root_ == nullptr; }
    FitNode* oldest() const;  ///< nullptr: empty

    /// Whether some node has the size and the acknowledgement asked for, however old.
    bool may_fit(const Fit& fit) const;
    /// The newest, or else the oldest, that fits; nullptr: none.
    FitNode* find(const Fit& fit, bool newest_first) const;

private:
    static bool before(const FitNode& a, const FitNode& b);
    static std::uint64_t weight(const FitNode& node);
    static void refresh(FitNode& node);
    static bool below_fits(const FitNode* node, const Fit& fit);
    static FitNode* join(FitNode* left, FitNode* right);
    static void split(FitNode* tree, const FitNode& at, FitNode*& left, FitNode*& right);
    static FitNode* put(FitNode* tree, FitNode& node);
    static FitNode* take(FitNode* tree, const FitNode& node);
    static FitNode* find_below(FitNode* tree, const Fit& fit, bool newest_first);

    FitNode* root_ = nullptr;
};

}  // namespace seautils::queue

#endif  // SEAUTILS_QUEUE_FIT_TREE_HPP
