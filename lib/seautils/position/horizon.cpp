#include "seautils/position/horizon.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/mix_model.hpp"
#include "seautils/position/state_bytes.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 2;
constexpr std::size_t most_known = 512;        ///< positions that are kept
constexpr std::int64_t most_strides = 48;      ///< that a model learns from
constexpr std::size_t situations = 64;         ///< that it remembers
constexpr std::uint32_t widest_stride = 1024;  ///< by which its first errors are widened

struct Known {
    std::int64_t number = 0;  ///< intervals since the first one
    Cell cell;
    bool begins = false;  ///< what was before says nothing of the motion
};

/// On the straight way from one position to the next.
Cell between(const Known& a, const Known& b, std::int64_t number) {
    return on_the_way(a.cell, b.cell, number - a.number, b.number - a.number);
}

/// Answers what is asked about a step.
auto answers_of(const Cell& step) {
    return [step](std::size_t axis, std::int32_t, std::int32_t least, std::int32_t most) {
        const std::int32_t v = axis == 0 ? step.x : axis == 1 ? step.y : step.z;
        return least <= v && v <= most;
    };
}

/// A model of the vehicle's steps over so many intervals at a time, from what is known.
class StrideModel {
public:
    StrideModel(const std::vector<Known>& known, std::uint32_t ahead) : model_(situations, {}) {
        model_.widen(std::min(ahead, widest_stride));
        const std::int64_t last = known.back().number, stride = ahead;
        const std::int64_t strides = (last - known.front().number) / stride;
        // Where little is known, also what lies between.
        if (strides < most_strides / 2) follow(known, last - stride / 2, stride);
        follow(known, last, stride);
    }

    /// @param decide  as MixModel::find()
    template <class Decide>
    Cell find(Decide decide) {
        MixModel::Forecast f;
        model_.forecast(motion_, f);
        const Cell step = model_.find(motion_, f, decide, false);
        return {motion_.last.x + step.x, motion_.last.y + step.y, motion_.last.z + step.z};
    }
    const Cell& last() const { return motion_.last; }

private:
    /// Learns the strides that end there.
    void follow(const std::vector<Known>& known, std::int64_t last, std::int64_t stride) {
        const std::int64_t strides = std::min((last - known.front().number) / stride, most_strides);
        std::size_t next = 0;  // the first one that is not before
        bool is_cut = true;
        for (std::int64_t number = last - strides * stride; number <= last; number += stride) {
            if (number < known.front().number) continue;
            for (; known[next].number < number; ++next) is_cut |= known[next].begins;
            const bool is_there = known[next].number == number;
            if (known[next].begins) {
                is_cut = true;
                if (!is_there) continue;
            }
            pass(is_there ? known[next].cell : between(known[next - 1], known[next], number),
                 is_cut);
            is_cut = false;
            if (is_there) ++next;
        }
    }

    void pass(const Cell& cell, bool is_cut) {
        if (is_cut) return motion_.restart(cell);
        const Cell& from = motion_.last;
        const Cell step{cell.x - from.x, cell.y - from.y, cell.z - from.z};
        MixModel::Forecast f;
        model_.forecast(motion_, f);
        model_.find(motion_, f, answers_of(step), true);
        model_.learn(motion_, f, step);
        motion_.step(cell);
    }

    MixModel model_;
    Motion motion_;
};

class MixHorizon : public Horizon {
public:
    std::unique_ptr<Horizon> clone() const override { return std::make_unique<MixHorizon>(*this); }

    void restart(const Cell& cell) override { note(1, cell, true); }
    void learn(const Cell& next) override { note(1, next, known_.empty()); }
    void learn_ahead(std::uint32_t ahead, const Cell& cell) override {
        note(ahead, cell, known_.empty());
    }
    void encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const override;
    Cell decode(std::uint32_t ahead, entropy::Decoder& in) const override;
    std::string save() const override;
    void load(std::string_view state) override;

private:
    void note(std::uint32_t ahead, const Cell& cell, bool begins) {
        const std::int64_t number = known_.empty() ? 0 : known_.back().number + ahead;
        if (known_.size() == most_known) known_.erase(known_.begin());
        known_.push_back({number, cell, begins});
    }

    std::vector<Known> known_;
};

void MixHorizon::encode(std::uint32_t ahead, const Cell& cell, entropy::Encoder& out) const {
    if (known_.empty()) throw std::logic_error("a position ahead of nothing");
    StrideModel model(known_, ahead);
    const Cell& from = model.last();
    const auto tell = answers_of({cell.x - from.x, cell.y - from.y, cell.z - from.z});
    model.find([&](std::size_t axis, std::int32_t yes, std::int32_t least, std::int32_t most) {
        const bool is = tell(axis, yes, least, most);
        out.bit(is, static_cast<std::uint32_t>(yes));
        return is;
    });
}

Cell MixHorizon::decode(std::uint32_t ahead, entropy::Decoder& in) const {
    if (known_.empty()) throw DataError("packet: a position ahead of nothing");
    StrideModel model(known_, ahead);
    const Cell cell = model.find([&](std::size_t, std::int32_t yes, std::int32_t, std::int32_t) {
        return in.bit(static_cast<std::uint32_t>(yes));
    });
    if (!in_limits(cell)) throw DataError("packet: a position is too far off");
    return cell;
}

std::string MixHorizon::save() const {
    StateWriter out(state_version);
    out.number(static_cast<std::int64_t>(known_.size()));
    for (const Known& k : known_) {
        out.number(k.number * 2 + (k.begins ? 1 : 0));
        for (const std::int32_t v : {k.cell.x, k.cell.y, k.cell.z}) out.number(v);
    }
    return out.finish();
}

void MixHorizon::load(std::string_view state) {
    StateReader in(state, state_version);
    MixHorizon next;
    next.known_.resize(static_cast<std::size_t>(in.number(0, std::int64_t{most_known})));
    std::int64_t least = 0;
    for (Known& k : next.known_) {
        const std::int64_t both = in.number(least * 2, std::int64_t{1} << 62);
        k.number = both / 2;
        k.begins = both % 2 == 1;
        least = k.number + 1;
        for (std::int32_t* v : {&k.cell.x, &k.cell.y, &k.cell.z})
            *v = static_cast<std::int32_t>(in.number(-cell_limit, cell_limit));
    }
    in.finish();
    *this = std::move(next);
}

}  // namespace

std::unique_ptr<Horizon> make_horizon() { return std::make_unique<MixHorizon>(); }

}  // namespace seautils::position
