#include "seautils/position/horizon.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/state_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <deque>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 1;
constexpr std::array<std::uint32_t, 11> classes{2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr std::size_t axes = 3, predictors = 3, buckets = 20, contexts = 4;
constexpr std::int64_t most_known = 64;
constexpr std::int64_t unit = 256;  // of velocities and scales

/// How likely one of two is, learnt by counting.
struct Chance {
    std::uint16_t one = 32768, seen = 0;

    std::uint32_t value() const { return std::clamp<std::uint32_t>(one, 512, 65536 - 512); }
    void saw(bool bit) {
        const std::int32_t rate = std::min<std::int32_t>(seen + 2, 48);
        const std::int32_t target = bit ? 65535 : 0;
        one = static_cast<std::uint16_t>(one + (target - one) / rate);
        if (seen < 48) ++seen;
    }
};

using Triple = std::array<std::int64_t, axes>;

/// A known position and how fast the vehicle was then, in 1/256 cell an interval.
struct Known {
    std::uint64_t number = 0;
    Triple at{}, fast{}, slow{};
};

/// What is known of errors so far ahead.
struct Class {
    std::array<std::array<std::int64_t, predictors>, axes> error{};  ///< mean size, 1/256 cell
    std::array<std::array<std::array<Chance, buckets>, contexts>, axes> beyond{};
    std::array<std::array<Chance, contexts>, axes> back{};
};

Triple triple(const Cell& c) { return {c.x, c.y, c.z}; }

std::int64_t rounded(std::int64_t value) { return (value + unit / 2) >> 8; }

/// Bounds of the sizes of an error by its usual size: halves, then by half as much again.
std::int64_t bound(std::size_t bucket, std::int64_t scale) {
    std::int64_t at = scale / 2;
    std::int64_t least = 1;
    for (std::size_t k = 0; k < bucket; ++k) {
        at = k < 4 ? at + scale / 2 : at + at / 2;
        ++least;
    }
    return std::max(least, at / unit);
}

class AdaptiveHorizon : public Horizon {
public:
    AdaptiveHorizon() {
        for (std::size_t k = 0; k < classes.size(); ++k)
            for (auto& axis : of_[k].error) axis.fill(classes[k] * unit);
    }
    std::unique_ptr<Horizon> clone() const override {
        return std::make_unique<AdaptiveHorizon>(*this);
    }

    void restart(const Cell& cell) override {
        known_.clear();
        known_.push_back({0, triple(cell), {}, {}});
    }
    void learn(const Cell& next) override { learn_ahead(1, next); }
    void learn_ahead(std::uint32_t ahead, const Cell& cell) override;
    void encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const override;
    Cell decode(std::uint32_t ahead, entropy::Decoder& in) const override;
    std::string save() const override;
    void load(std::string_view state) override;

private:
    static std::size_t class_of(std::uint32_t ahead) {
        std::size_t k = classes.size() - 1;
        while (k > 0 && classes[k] > ahead) --k;
        return k;
    }
    /// Where each predictor takes an axis.
    static std::int64_t predicted(const Known& from, std::uint32_t ahead, std::size_t axis,
                                  std::size_t predictor) {
        const std::int64_t speed = predictor == 0   ? from.fast[axis]
                                   : predictor == 1 ? from.slow[axis]
                                                    : 0;
        const std::int64_t at = from.at[axis] + rounded(speed * ahead);
        return std::clamp<std::int64_t>(at, -cell_limit, cell_limit);
    }

    /// How an axis is coded: what is expected, and how far off it usually is.
    struct View {
        std::int64_t expected = 0, scale = 1;
        bool is_flipped = false;
        std::size_t axis = 0;  ///< along the heading, across, up
    };
    static View view(const Class& of, const Known& from, std::uint32_t ahead, std::size_t k,
                     std::size_t axis);
    static std::size_t first_axis(const Known& from) {
        return std::abs(from.fast[1]) > std::abs(from.fast[0]) ? 1 : 0;
    }
    static std::size_t context(std::size_t bucket) { return std::min<std::size_t>(bucket / 2, 3); }

    /// @param of  constant, unless the coder learns
    template <class Of, class Coder>
    static void code(Of& of, const Known& from, std::uint32_t ahead, std::size_t k, Triple& at,
                     Coder coder);
    void train(std::uint32_t ahead, std::size_t k, const Known& from, const Triple& to);

    std::deque<Known> known_{Known{}};
    std::array<Class, classes.size()> of_;
};

/// Learns: counts.
struct Learning {
    static constexpr bool knows = true;
    bool decide(Chance& chance, bool bit) {
        chance.saw(bit);
        return bit;
    }
    std::int64_t choose(std::int64_t, std::int64_t, std::int64_t value) { return value; }
};

struct Writing {
    static constexpr bool knows = true;
    entropy::Encoder& out;
    bool decide(const Chance& chance, bool bit) {
        out.bit(bit, chance.value());
        return bit;
    }
    std::int64_t choose(std::int64_t least, std::int64_t end, std::int64_t value) {
        out.symbol({static_cast<std::uint32_t>(value - least), 1},
                   static_cast<std::uint32_t>(end - least));
        return value;
    }
};

struct Reading {
    static constexpr bool knows = false;
    entropy::Decoder& in;
    bool decide(const Chance& chance, bool) { return in.bit(chance.value()); }
    std::int64_t choose(std::int64_t least, std::int64_t end, std::int64_t) {
        const auto part = in.symbol(static_cast<std::uint32_t>(end - least), [](std::uint32_t at) {
            return entropy::Counts::Part{at, 1};
        });
        return least + part.below;
    }
};

/// One error: how many buckets it is off, to which side, and where within.
/// @return  the bucket
template <class Beyond, class Back, class Coder>
std::size_t code_error(Beyond& beyond, Back& back, std::int64_t scale, std::int64_t& error,
                       Coder& coder) {
    const std::int64_t size = std::abs(error);
    std::size_t bucket = 0;
    while (bucket + 1 < buckets &&
           coder.decide(beyond[bucket], Coder::knows && size >= bound(bucket, scale)))
        ++bucket;
    if (bucket == 0) {
        const std::int64_t end = bound(0, scale);
        error = coder.choose(1 - end, end, error);
        return bucket;
    }
    const bool is_back = coder.decide(back, Coder::knows && error < 0);
    const std::int64_t most = 4 * (std::int64_t{cell_limit} + 1);
    const std::int64_t least = bound(bucket - 1, scale);
    const std::int64_t end =
        bucket + 1 < buckets ? bound(bucket, scale) : std::max(most, least + 1);
    const std::int64_t found = coder.choose(least, end, size);
    error = is_back ? -found : found;
    return bucket;
}

AdaptiveHorizon::View AdaptiveHorizon::view(const Class& of, const Known& from, std::uint32_t ahead,
                                            std::size_t k, std::size_t axis) {
    View view;
    const auto& errors = of.error[axis];
    const auto best =
        static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
    view.expected = predicted(from, ahead, axis, best);
    view.scale = std::clamp<std::int64_t>(errors[best] * ahead / classes[k], unit / 2,
                                          unit * (cell_limit / 16));
    view.is_flipped = from.fast[axis] < 0;
    view.axis = axis == 2 ? 2 : axis == first_axis(from) ? 0 : 1;
    return view;
}

template <class Of, class Coder>
void AdaptiveHorizon::code(Of& of, const Known& from, std::uint32_t ahead, std::size_t k,
                           Triple& at, Coder coder) {
    const std::size_t first = first_axis(from);
    std::size_t seen = 0;
    for (const std::size_t axis : {std::size_t{2}, first, 1 - first}) {
        const View as = view(of, from, ahead, k, axis);
        std::int64_t error = at[axis] - as.expected;
        if (as.is_flipped) error = -error;
        const std::size_t bucket =
            code_error(of.beyond[as.axis][context(seen)], of.back[as.axis][context(seen)], as.scale,
                       error, coder);
        at[axis] = as.expected + (as.is_flipped ? -error : error);
        seen = axis == 2 ? 0 : bucket;
    }
}

void AdaptiveHorizon::train(std::uint32_t ahead, std::size_t k, const Known& from,
                            const Triple& to) {
    Class& of = of_[k];
    Triple at = to;
    code(of, from, ahead, k, at, Learning{});
    for (std::size_t axis = 0; axis < axes; ++axis) {
        for (std::size_t p = 0; p < predictors; ++p) {
            const std::int64_t off = std::abs(to[axis] - predicted(from, ahead, axis, p));
            std::int64_t& mean = of.error[axis][p];
            const std::int64_t most = 16 * mean + 8 * unit;
            mean += (std::min(off * unit * classes[k] / ahead, most) - mean) / 24;
        }
    }
}

void AdaptiveHorizon::learn_ahead(std::uint32_t ahead, const Cell& cell) {
    const Triple to = triple(cell);
    const std::uint64_t number = known_.back().number + ahead;
    for (const Known& from : known_) {
        const auto since = static_cast<std::uint32_t>(number - from.number);
        if (since < 2) continue;
        const std::size_t k = class_of(since);
        if (classes[k] == since || &from == &known_.back()) train(since, k, from, to);
    }
    Known next{number, to, known_.back().fast, known_.back().slow};
    const bool is_second = known_.size() == 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const std::int64_t speed = (to[axis] - known_.back().at[axis]) * unit / ahead;
        next.fast[axis] += is_second ? speed - next.fast[axis] : (speed - next.fast[axis]) / 2;
        next.slow[axis] += is_second ? speed - next.slow[axis] : (speed - next.slow[axis]) / 6;
    }
    known_.push_back(next);
    while (std::ssize(known_) > most_known || number - known_.front().number > classes.back())
        known_.pop_front();
}

void AdaptiveHorizon::encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const {
    const std::size_t k = class_of(ahead);
    Triple at = triple(cell);
    code(of_[k], known_.back(), ahead, k, at, Writing{out});
}

Cell AdaptiveHorizon::decode(std::uint32_t ahead, entropy::Decoder& in) const {
    const std::size_t k = class_of(ahead);
    Triple at{};
    code(of_[k], known_.back(), ahead, k, at, Reading{in});
    for (const std::int64_t v : at)
        if (v < -cell_limit || v > cell_limit) throw DataError("packet: a position is too far off");
    return {static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]),
            static_cast<std::int32_t>(at[2])};
}

std::string AdaptiveHorizon::save() const {
    StateWriter out(state_version);
    out.number(static_cast<std::int64_t>(known_.size()));
    for (const Known& k : known_) {
        out.number(static_cast<std::int64_t>(k.number));
        for (const Triple* t : {&k.at, &k.fast, &k.slow})
            for (const std::int64_t v : *t) out.number(v);
    }
    const auto put = [&out](const Chance& c) { out.number(c.one * std::int64_t{65536} + c.seen); };
    for (const Class& of : of_) {
        for (const auto& axis : of.error)
            for (const std::int64_t v : axis) out.number(v);
        for (const auto& axis : of.beyond)
            for (const auto& context : axis)
                for (const Chance& c : context) put(c);
        for (const auto& axis : of.back)
            for (const Chance& c : axis) put(c);
    }
    return out.finish();
}

void AdaptiveHorizon::load(std::string_view state) {
    constexpr std::int64_t far = std::int64_t{cell_limit} * 2 * unit;
    StateReader in(state, state_version);
    AdaptiveHorizon next;
    next.known_.resize(static_cast<std::size_t>(in.number(1, most_known)));
    std::int64_t last = -1;
    for (Known& k : next.known_) {
        last = in.number(last + 1, std::int64_t{1} << 62);
        k.number = static_cast<std::uint64_t>(last);
        for (Triple* t : {&k.at, &k.fast, &k.slow})
            for (std::int64_t& v : *t) v = in.number(-far, far);
    }
    const auto get = [&in](Chance& c) {
        const std::int64_t both = in.number(0, 0xFFFF'FFFF);
        c = {static_cast<std::uint16_t>(both >> 16), static_cast<std::uint16_t>(both & 0xFFFF)};
    };
    for (Class& of : next.of_) {
        for (auto& axis : of.error)
            for (std::int64_t& v : axis) v = in.number(0, far * 64);
        for (auto& axis : of.beyond)
            for (auto& context : axis)
                for (Chance& c : context) get(c);
        for (auto& axis : of.back)
            for (Chance& c : axis) get(c);
    }
    in.finish();
    *this = std::move(next);
}

}  // namespace

std::unique_ptr<Horizon> make_horizon() { return std::make_unique<AdaptiveHorizon>(); }

}  // namespace seautils::position
