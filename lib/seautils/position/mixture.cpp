#include "seautils/position/mixture.hpp"

namespace seautils::position {

namespace {

std::int32_t mass(const Mixture& m, std::size_t k, std::int32_t cell) {
    return m.component_below(k, upper_edge(cell)) - m.component_below(k, upper_edge(cell - 1));
}

/// In proportion to weight times what is expected, Q20, together at most 1; the weights where next to
/// nothing was expected.
template <class Weight, class Expected>
std::array<std::int32_t, most_components> shares(std::size_t size, Weight weight,
                                                 Expected expected) {
    std::array<std::int64_t, most_components> product{};
    std::int64_t total = 0;
    for (std::size_t k = 0; k < size; ++k)
        total += product[k] = std::int64_t{weight(k)} * expected(k);
    std::array<std::int32_t, most_components> share{};
    const std::int64_t unit = (total >> 20) + 1;
    for (std::size_t k = 0; k < size; ++k)
        share[k] = unit < 256 ? weight(k) : static_cast<std::int32_t>(product[k] / unit);
    return share;
}

}  // namespace

std::int32_t Mixture::mean() const {
    std::int64_t sum = 0, weights = 0;
    for (std::size_t k = 0; k < size_; ++k) {
        sum += std::int64_t{weight_[k]} * mean_[k];
        weights += weight_[k];
    }
    return weights == 0 ? 0 : static_cast<std::int32_t>(sum / weights);
}

std::array<std::int32_t, most_components> responsibility(const Mixture& m, std::int32_t cell) {
    return shares(
        m.size(), [&](std::size_t k) { return m.weight(k); },
        [&](std::size_t k) { return mass(m, k, cell); });
}

void PlaneMixture::add(std::int32_t weight, Pair mean, std::int64_t along, std::int64_t across,
                       Direction d) {
    along = clamp(along, least_sd, most_sd);
    across = clamp(across, least_sd, most_sd);
    // The covariance turned from the frame of the direction; products of directions are Q28.
    const std::int64_t xx = std::int64_t{d.x} * d.x >> 14, yy = std::int64_t{d.y} * d.y >> 14;
    const std::int64_t xy = std::int64_t{d.x} * d.y >> 14;
    const std::int64_t a = along * along, c = across * across;
    const std::int64_t variance_x = a * xx + c * yy;
    const std::int64_t sd_x = square_root(static_cast<std::uint64_t>(variance_x >> 14));
    const std::int64_t slope = clamp((a - c) * xy / ((variance_x >> 14) + 1), -(1 << 24), 1 << 24);
    // The determinant does not turn: the standard deviation of y given x is what is left of it.
    const std::int64_t sd_y = along * across / (sd_x + 1);
    const auto bounded = [](std::int64_t sd) {
        return static_cast<std::int32_t>(clamp(sd, least_sd, most_sd));
    };
    add({weight, mean, bounded(sd_x), static_cast<std::int32_t>(slope), bounded(sd_y)});
}

Mixture PlaneMixture::along_x() const {
    Mixture m;
    for (std::size_t k = 0; k < size_; ++k) {
        const Component& c = components_[k];
        m.add(c.weight, c.mean.x, c.sd_x);
    }
    return m;
}

PlaneMixture::Weights PlaneMixture::reweighted(const Weights& expected) const {
    return shares(
        size_, [&](std::size_t k) { return components_[k].weight; },
        [&](std::size_t k) { return expected[k]; });
}

PlaneMixture::Weights PlaneMixture::expected_x(std::int32_t cell_x) const {
    const Mixture x = along_x();
    Weights expected{};
    for (std::size_t k = 0; k < size_; ++k) expected[k] = mass(x, k, cell_x);
    return expected;
}

Mixture PlaneMixture::given(std::int32_t cell_x, const Weights& weights) const {
    Mixture m;
    const std::int64_t x = upper_edge(cell_x) - 128;
    for (std::size_t k = 0; k < size_; ++k) {
        const Component& c = components_[k];
        const std::int64_t off = clamp(x - c.mean.x, -4 * c.sd_x, 4 * c.sd_x);
        m.add(weights[k], c.mean.y + (off * c.slope >> 14), c.sd_y);
    }
    return m;
}

Mixture PlaneMixture::along_y(std::int32_t cell_x) const {
    return given(cell_x, reweighted(expected_x(cell_x)));
}

PlaneMixture::Weights PlaneMixture::expected(std::int32_t cell_x, std::int32_t cell_y) const {
    Weights both = expected_x(cell_x);
    const Mixture y = given(cell_x, both);
    for (std::size_t k = 0; k < size_; ++k)
        both[k] = static_cast<std::int32_t>(std::int64_t{both[k]} * mass(y, k, cell_y) >> 24);
    return both;
}

PlaneMixture::Weights PlaneMixture::responsibility(std::int32_t cell_x, std::int32_t cell_y) const {
    return reweighted(expected(cell_x, cell_y));
}

std::int32_t PlaneMixture::probability_q24(std::int32_t cell_x, std::int32_t cell_y) const {
    const Weights each = expected(cell_x, cell_y);
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < size_; ++k) sum += std::int64_t{components_[k].weight} * each[k];
    return static_cast<std::int32_t>(sum >> 20);
}

}  // namespace seautils::position
