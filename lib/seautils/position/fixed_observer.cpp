#include "seautils/position/integer_math.hpp"
#include "seautils/position/observer.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace seautils::position {

namespace {

constexpr std::int64_t cell_unit = 65536;
constexpr std::int64_t direction_unit = 1 << 24;

class FixedObserver final : public Observer {
public:
    explicit FixedObserver(const CodecOptions& options) : step_(step_length(options)) {}

    std::unique_ptr<Observer> clone() const override {
        return std::make_unique<FixedObserver>(*this);
    }
    void restart(const Cell& cell) override {
        last_ = cell;
        east_ = north_ = dive_ = 0;
    }
    Prediction predict() const override {
        return {{last_.x + ahead(east_), last_.y + ahead(north_), std::int64_t{last_.z} + dive_},
                step_};
    }
    void learn(const Cell& next) override {
        turn_to(next.x - last_.x, next.y - last_.y);
        dive_ = next.z - last_.z;
        last_ = next;
    }
    void save(StateWriter& out) const override {
        for (const std::int64_t v : {last_.x, last_.y, last_.z}) out.number(v);
        for (const std::int64_t v : {east_, north_, dive_}) out.number(v);
    }
    void load(StateReader& in) override {
        for (std::int32_t* v : {&last_.x, &last_.y, &last_.z}) {
            *v = static_cast<std::int32_t>(in.number(-cell_limit, cell_limit));
        }
        for (std::int64_t* v : {&east_, &north_}) *v = in.number(-direction_unit, direction_unit);
        dive_ = in.number(-2 * cell_limit, 2 * cell_limit);
    }

private:
    /// Cells, rounded.
    std::int64_t ahead(std::int64_t direction) const {
        return ((step_ * direction >> 24) + cell_unit / 2) >> 16;
    }
    /// East and north of where it came from, in cells.
    void turn_to(std::int64_t x, std::int64_t y) {
        if (x == 0 && y == 0) return;
        // As many digits as the sum of the squares has room for.
        const auto greater = static_cast<std::uint64_t>(std::max(std::abs(x), std::abs(y)));
        const std::int64_t scale = std::int64_t{1}
                                   << (30 - static_cast<int>(std::bit_width(greater)));
        x *= scale;
        y *= scale;
        const std::int64_t length = square_root(static_cast<std::uint64_t>(x * x + y * y));
        east_ = std::clamp(x * direction_unit / length, -direction_unit, direction_unit);
        north_ = std::clamp(y * direction_unit / length, -direction_unit, direction_unit);
    }

    std::int64_t step_;
    Cell last_;
    std::int64_t east_ = 0, north_ = 0;  ///< of a unit of direction_unit; both 0: unknown
    std::int64_t dive_ = 0;              ///< cells up in the last interval
};

}  // namespace

std::int64_t step_length(const CodecOptions& options) {
    const std::int64_t way_um = options.speed_mmps * options.interval_ms;  // below 2^43
    const std::int64_t step = way_um * cell_unit / (options.resolution_mm * 1000);
    return std::clamp<std::int64_t>(step, 1, std::int64_t{1} << 38);
}

std::unique_ptr<Observer> make_fixed_observer(const CodecOptions& options) {
    return std::make_unique<FixedObserver>(options);
}

}  // namespace seautils::position
