#include "seautils/position/joint_code.hpp"

#include <algorithm>

namespace seautils::position {

namespace {

constexpr unsigned index_bits = 12;
constexpr std::size_t most_length = 60;

/// Joins the two lightest nodes until one is left; `key` is sorted, weights with their order.
/// @return  the parent of each node: first the leaves as sorted, then what was joined
std::vector<std::uint32_t> parents_of(const std::vector<std::uint64_t>& key) {
    const std::size_t n = key.size();
    std::vector<std::uint32_t> parent(2 * n - 1);
    std::vector<std::uint64_t> joined;
    joined.reserve(n - 1);
    std::size_t leaf = 0, inner = 0;
    const auto take = [&](std::size_t into) {
        const bool is_leaf =
            leaf < n && (inner == joined.size() || key[leaf] >> index_bits <= joined[inner]);
        parent[is_leaf ? leaf : n + inner] = static_cast<std::uint32_t>(into);
        return is_leaf ? key[leaf++] >> index_bits : joined[inner++];
    };
    while (joined.size() < n - 1) {
        const std::size_t into = n + joined.size();
        const std::uint64_t first = take(into);
        joined.push_back(first + take(into));
    }
    return parent;
}

}  // namespace

JointCode::JointCode(const std::vector<std::uint64_t>& weights)
    : length_(weights.size()), count_(most_length + 1) {
    const std::size_t n = weights.size();
    std::vector<std::uint64_t> key(n);
    for (std::size_t k = 0; k < n; ++k) key[k] = weights[k] << index_bits | k;
    std::sort(key.begin(), key.end());
    const std::vector<std::uint32_t> parent = parents_of(key);
    std::vector<std::uint8_t> depth(2 * n - 1);
    for (std::size_t node = 2 * n - 2; node-- > 0;)
        depth[node] = static_cast<std::uint8_t>(depth[parent[node]] + 1);
    for (std::size_t k = 0; k < n; ++k) {
        length_[key[k] & ((1U << index_bits) - 1)] = depth[k];
        ++count_[depth[k]];
    }
}

void JointCode::put(std::size_t symbol, entropy::BitString& out) const {
    const unsigned length = length_[symbol];
    std::uint64_t code = 0;
    for (std::size_t l = 1; l < length; ++l) code = (code + count_[l]) * 2;
    code += static_cast<std::uint64_t>(
        std::count(length_.begin(), length_.begin() + static_cast<std::ptrdiff_t>(symbol),
                   static_cast<std::uint8_t>(length)));
    out.put(code, length);
}

std::size_t JointCode::get(entropy::BitReader& in) const {
    std::uint64_t code = 0, first = 0;
    std::size_t length = 0;
    do {
        first = (first + (length == 0 ? 0 : count_[length])) * 2;
        code = code * 2 + (in.get() ? 1 : 0);
        ++length;
    } while (code - first >= count_[length]);
    auto at = length_.begin() - 1;
    for (std::uint64_t left = code - first + 1; left > 0; --left)
        at = std::find(at + 1, length_.end(), static_cast<std::uint8_t>(length));
    return static_cast<std::size_t>(at - length_.begin());
}

}  // namespace seautils::position
