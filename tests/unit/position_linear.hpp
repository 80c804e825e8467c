// A small codec and horizon for tests of what is built on them.
#ifndef SEAUTILS_TESTS_POSITION_LINEAR_HPP
#define SEAUTILS_TESTS_POSITION_LINEAR_HPP

#include "seautils/core/error.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/horizon.hpp"
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

/// The difference from linear extrapolation, in 8 or 25 bits an axis: so quick that tests may play
/// long stories.
class LinearHorizon : public Horizon {
public:
    std::unique_ptr<Horizon> clone() const override {
        return std::make_unique<LinearHorizon>(*this);
    }
    void restart(const Cell& cell) override { last_ = cell, speed_ = {}; }
    void learn(const Cell& next) override { learn_ahead(1, next); }
    void learn_ahead(std::uint32_t ahead, const Cell& cell) override {
        const auto k = static_cast<std::int32_t>(ahead);
        speed_ = {(cell.x - last_.x) / k, (cell.y - last_.y) / k, (cell.z - last_.z) / k};
        last_ = cell;
    }
    void encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const override {
        const auto expected = expected_at(ahead);
        const std::array<std::int64_t, 3> to{cell.x, cell.y, cell.z};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t off = to[k] - expected[k];
            const bool is_near = off >= -64 && off < 64;
            out.bit(is_near, 32768);
            for (unsigned bit = is_near ? 7 : width; bit > 0; --bit)
                out.bit(((off + (is_near ? 64 : far)) >> (bit - 1) & 1) != 0, 32768);
        }
    }
    Cell decode(std::uint32_t ahead, entropy::Decoder& in) const override {
        const auto expected = expected_at(ahead);
        std::array<std::int64_t, 3> to{};
        for (std::size_t k = 0; k < 3; ++k) {
            const bool is_near = in.bit(32768);
            std::int64_t off = 0;
            for (unsigned bit = is_near ? 7 : width; bit > 0; --bit)
                off = off * 2 + (in.bit(32768) ? 1 : 0);
            to[k] = expected[k] + off - (is_near ? 64 : far);
            if (std::abs(to[k]) > cell_limit) throw DataError("too far off");
        }
        return {static_cast<std::int32_t>(to[0]), static_cast<std::int32_t>(to[1]),
                static_cast<std::int32_t>(to[2])};
    }
    std::string save() const override {
        StateWriter out(1);
        for (const Cell* c : {&last_, &speed_})
            for (const std::int32_t v : {c->x, c->y, c->z}) out.number(v);
        return out.finish();
    }
    void load(std::string_view state) override {
        StateReader in(state, 1);
        LinearHorizon next;
        for (Cell* c : {&next.last_, &next.speed_})
            for (std::int32_t* v : {&c->x, &c->y, &c->z})
                *v = static_cast<std::int32_t>(in.number(-2 * cell_limit, 2 * cell_limit));
        in.finish();
        *this = next;
    }

private:
    static constexpr unsigned width = 24;  ///< of any difference within the limits
    static constexpr std::int64_t far = 1 << 23;

    std::array<std::int64_t, 3> expected_at(std::uint32_t ahead) const {
        const auto axis = [ahead](std::int64_t from, std::int64_t speed) {
            return std::clamp<std::int64_t>(from + speed * ahead, -cell_limit, cell_limit);
        };
        return {axis(last_.x, speed_.x), axis(last_.y, speed_.y), axis(last_.z, speed_.z)};
    }

    Cell last_, speed_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_TESTS_POSITION_LINEAR_HPP
