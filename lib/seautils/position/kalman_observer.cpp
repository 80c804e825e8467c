#include "seautils/position/observer.hpp"
#include "seautils/position/scaled.hpp"

#include <algorithm>
#include <vector>

namespace seautils::position {

namespace {

constexpr std::size_t most_gains = 256;
constexpr int gain_bits = 24;
constexpr std::int64_t most = std::int64_t{8} << gain_bits;  ///< a gain is about 2 at the most
constexpr std::int64_t far = std::int64_t{1} << 40;  ///< no state is beyond; nor a deviation

/// What a filter does at one position after a restart; the same for each axis.
struct Gain {
    std::array<std::int64_t, 3> of{};  ///< in 1/2^gain_bits: of position, velocity, acceleration
    std::int64_t deviation = 1;        ///< of the prediction, in 1/65536 cell

    friend bool operator==(const Gain&, const Gain&) = default;
};

/// Covariance in mm², with times in steps of the interval.
struct Covariance {
    Scaled xx, xv, xa, vv, va, aa;

    /// One step on: x += v + a/2, v += a, and noise of variance `jolt` in the acceleration.
    void predict(Scaled jolt) {
        const Scaled half(1, -1);
        const Scaled row_xx = xx + xv + xa * half, row_xv = xv + vv + va * half;
        const Scaled row_xa = xa + va + aa * half, row_vv = vv + va, row_va = va + aa;
        xx = row_xx + row_xv + row_xa * half + jolt * half * half;
        xv = row_xv + row_xa + jolt * half;
        xa = row_xa + jolt * half;
        vv = row_vv + row_va + jolt;
        va = row_va + jolt;
        aa = aa + jolt;
    }
    /// A position was measured, with noise of variance r.
    void measure(Scaled r) {
        const Scaled all = xx + r, gain_v = xv / all, gain_a = xa / all, left = r / all;
        vv = at_least_0(vv - gain_v * xv);
        va = va - gain_v * xa;
        aa = at_least_0(aa - gain_a * xa);
        xx = xx * left;
        xv = xv * left;
        xa = xa * left;
    }
    static Scaled at_least_0(Scaled value) { return value < Scaled() ? Scaled() : value; }
};

Gain gain_of(const Covariance& predicted, Scaled r, Scaled resolution) {
    const Scaled all = predicted.xx + r;
    const Scaled cells = predicted.xx.root() / resolution;
    const auto fixed = [&](Scaled v) {
        return std::clamp((v / all).fixed(gain_bits), -most, most);
    };
    return {{fixed(predicted.xx), fixed(predicted.xv), fixed(predicted.xa)},
            std::clamp<std::int64_t>(cells.fixed(16), 1, far)};
}

std::vector<Gain> gains(const CodecOptions& options) {
    const Scaled r(25'000'000);  // mm²
    const auto at_most = [](Scaled a, Scaled b) { return b < a ? b : a; };
    const Scaled tau(options.interval_ms);
    // sigma_j² tau⁴, of 1000 mm²/s⁴ and milliseconds
    const Scaled jolt = at_most(tau * tau * tau * tau / Scaled(1'000'000'000), r * Scaled(1, 16));
    const Scaled way = Scaled(options.speed_mmps * options.interval_ms) / Scaled(1000);
    const Scaled moves = at_most(way * way, r * Scaled(1, 20));

    std::vector<Gain> table;
    Covariance covariance{r, {}, {}, moves, {}, moves};
    while (table.size() < most_gains) {
        covariance.predict(jolt);
        const Gain gain = gain_of(covariance, r, Scaled(options.resolution_mm));
        if (!table.empty() && gain == table.back()) break;
        table.push_back(gain);
        covariance.measure(r);
    }
    return table;
}

/// One axis; in 1/65536 cell, a step and a step².
struct Axis {
    std::int64_t position = 0, velocity = 0, acceleration = 0;

    std::int64_t predicted() const { return position + velocity + acceleration / 2; }
    std::int64_t predicted_cell() const { return (predicted() + 32768) >> 16; }
    void learn(std::int64_t measured, const Gain& gain) {
        const std::int64_t expected = predicted();
        const std::int64_t surprise = measured - expected;
        const auto corrected = [&](std::int64_t value, std::size_t k) {
            return std::clamp(value + (gain.of[k] * surprise >> gain_bits), -far, far);
        };
        position = corrected(expected, 0);
        velocity = corrected(velocity + acceleration, 1);
        acceleration = corrected(acceleration, 2);
    }
};

class KalmanObserver final : public Observer {
public:
    explicit KalmanObserver(const CodecOptions& options)
        : gains_(std::make_shared<const std::vector<Gain>>(gains(options))) {}

    std::unique_ptr<Observer> clone() const override {
        return std::make_unique<KalmanObserver>(*this);
    }
    void restart(const Cell& cell) override {
        age_ = 0;
        axes_ = {};
        const std::array<std::int64_t, 3> at{cell.x, cell.y, cell.z};
        for (std::size_t k = 0; k < 3; ++k) axes_[k].position = at[k] * 65536;
    }
    Prediction predict() const override {
        Prediction all;
        for (std::size_t k = 0; k < 3; ++k) all.cell[k] = axes_[k].predicted_cell();
        all.deviation = (*gains_)[age_].deviation;
        return all;
    }
    void learn(const Cell& next) override {
        const std::array<std::int64_t, 3> at{next.x, next.y, next.z};
        for (std::size_t k = 0; k < 3; ++k) axes_[k].learn(at[k] * 65536, (*gains_)[age_]);
        age_ = std::min(age_ + 1, gains_->size() - 1);
    }
    void save(StateWriter& out) const override {
        out.number(static_cast<std::int64_t>(age_));
        for (const Axis& axis : axes_) {
            for (const std::int64_t v : {axis.position, axis.velocity, axis.acceleration})
                out.number(v);
        }
    }
    void load(StateReader& in) override {
        age_ =
            static_cast<std::size_t>(in.number(0, static_cast<std::int64_t>(gains_->size()) - 1));
        for (Axis& axis : axes_) {
            for (std::int64_t* v : {&axis.position, &axis.velocity, &axis.acceleration})
                *v = in.number(-far, far);
        }
    }

private:
    std::shared_ptr<const std::vector<Gain>> gains_;  ///< the last one stays
    std::size_t age_ = 0;                             ///< positions since the restart
    std::array<Axis, 3> axes_;
};

}  // namespace

std::unique_ptr<Observer> make_kalman_observer(const CodecOptions& options) {
    return std::make_unique<KalmanObserver>(options);
}

}  // namespace seautils::position
