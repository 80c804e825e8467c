// A small codec for tests of what is built on codecs.
#ifndef SEAUTILS_TESTS_POSITION_LINEAR_HPP
#define SEAUTILS_TESTS_POSITION_LINEAR_HPP

#include "seautils/core/error.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/state_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace seautils::position {

/// Rice codes of the difference from linear extrapolation, the parameter from the mean of those
/// before; 16 ones mean 13 bits. A difference of more than 2000 it cannot code.
class LinearCodec : public Codec {
public:
    std::unique_ptr<Codec> clone() const override { return std::make_unique<LinearCodec>(*this); }

    void restart(const Cell& cell) override {
        last_ = {cell.x, cell.y, cell.z};
        before_ = last_;
    }
    bool can_encode(const Cell& next) const override {
        const std::array<std::int64_t, 3> to{next.x, next.y, next.z};
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(to[k] - expected(k)) > 2000) return false;
        return true;
    }
    void encode(const Cell& next, entropy::Encoder& out) override {
        if (!can_encode(next)) throw std::logic_error("too far off");
        const std::array<std::int64_t, 3> to{next.x, next.y, next.z};
        for (std::size_t k = 0; k < 3; ++k) put(to[k] - expected(k), width(k), out);
        learn(next);
    }
    std::optional<Cell> decode(entropy::Decoder& in) override {
        std::array<std::int64_t, 3> to{};
        for (std::size_t k = 0; k < 3; ++k) to[k] = expected(k) + get(width(k), in);
        for (const std::int64_t v : to)
            if (std::abs(v) > cell_limit) throw DataError("too far off");
        const Cell next{static_cast<std::int32_t>(to[0]), static_cast<std::int32_t>(to[1]),
                        static_cast<std::int32_t>(to[2])};
        learn(next);
        return next;
    }
    void learn(const Cell& next) override {
        const std::array<std::int64_t, 3> to{next.x, next.y, next.z};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t size = std::min<std::int64_t>(std::abs(to[k] - expected(k)), 500);
            mean_[k] += (size * 256 - mean_[k]) / 16;
        }
        before_ = last_;
        last_ = to;
    }
    std::string save() const override {
        StateWriter out(1);
        for (const auto* list : {&last_, &before_, &mean_})
            for (const std::int64_t v : *list) out.number(v);
        return out.finish();
    }
    void load(std::string_view state) override {
        StateReader in(state, 1);
        LinearCodec next;
        for (auto* list : {&next.last_, &next.before_, &next.mean_})
            for (std::int64_t& v : *list)
                v = in.number(-(std::int64_t{1} << 32), std::int64_t{1} << 32);
        in.finish();
        *this = next;
    }

private:
    std::int64_t expected(std::size_t k) const {
        return std::clamp<std::int64_t>(2 * last_[k] - before_[k], -cell_limit, cell_limit);
    }
    unsigned width(std::size_t k) const {
        unsigned width = 0;
        while ((std::int64_t{256} << width) < mean_[k]) ++width;
        return width;
    }
    static void put(std::int64_t value, unsigned width, entropy::Encoder& out) {
        const auto code = static_cast<std::uint64_t>(value < 0 ? -2 * value - 1 : 2 * value);
        const std::uint64_t ones = code >> width;
        for (std::uint64_t k = 0; k < std::min<std::uint64_t>(ones, 16); ++k) out.bit(true, 32768);
        if (ones < 16) out.bit(false, 32768);
        for (unsigned k = ones < 16 ? width : 13; k > 0; --k)
            out.bit((code >> (k - 1) & 1) != 0, 32768);
    }
    static std::int64_t get(unsigned width, entropy::Decoder& in) {
        std::uint64_t code = 0;
        while (code < 16 && in.bit(32768)) ++code;
        if (code == 16) code = 0, width = 13;
        for (; width > 0; --width) code = code * 2 + (in.bit(32768) ? 1 : 0);
        const auto half = static_cast<std::int64_t>(code / 2);
        return code % 2 == 1 ? -half - 1 : half;
    }

    std::array<std::int64_t, 3> last_{}, before_{}, mean_{1024, 1024, 512};
};

}  // namespace seautils::position

#endif  // SEAUTILS_TESTS_POSITION_LINEAR_HPP
