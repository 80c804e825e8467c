#include "seautils/position/thesis.hpp"

#include "seautils/core/error.hpp"

#include <stdexcept>
#include <utility>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 1;

std::unique_ptr<Observer> make_observer(const CodecOptions& options) {
    return options.kind == CodecOptions::Kind::fixed ? make_fixed_observer(options)
                                                     : make_kalman_observer(options);
}

}  // namespace

ThesisCodec::ThesisCodec(const CodecOptions& options)
    : options_(options),
      bound_(delta_bound(options)),
      observer_(make_observer(options)),
      model_(make_delta_model(options.model, bound_)) {}

ThesisCodec::ThesisCodec(const ThesisCodec& other)
    : options_(other.options_),
      bound_(other.bound_),
      observer_(other.observer_->clone()),
      model_(other.model_->clone()),
      knows_position_(other.knows_position_) {}

void ThesisCodec::restart(const Cell& cell) {
    observer_->restart(cell);
    knows_position_ = true;
}

std::optional<ThesisCodec::Symbols> ThesisCodec::symbols(const Cell& next) const {
    if (!knows_position_ || !in_limits(next)) return std::nullopt;
    const Prediction prediction = observer_->predict();
    const std::array<std::int64_t, 3> at{next.x, next.y, next.z};
    Symbols all{};
    for (std::size_t axis = 0; axis < all.size(); ++axis) {
        const std::int64_t delta = at[axis] - prediction.cell[axis];
        if (delta < -bound_ || delta > bound_) return std::nullopt;
        all[axis] = entropy::first_value_symbol + static_cast<entropy::Symbol>(delta + bound_);
    }
    return all;
}

void ThesisCodec::encode(std::size_t axis, entropy::Symbol symbol, const Prediction& prediction,
                         entropy::Encoder& out) const {
    out.symbol(model_->part(axis, symbol, prediction.deviation), model_->total(axis));
}

entropy::Symbol ThesisCodec::decode(std::size_t axis, const Prediction& prediction,
                                    entropy::Decoder& in) const {
    entropy::Symbol symbol = 0;
    in.symbol(model_->total(axis), [&](std::uint32_t cumulative) {
        symbol = model_->find(axis, cumulative, prediction.deviation);
        return model_->part(axis, symbol, prediction.deviation);
    });
    return symbol;
}

void ThesisCodec::encode(const Cell& next, entropy::Encoder& out) {
    const auto coded = symbols(next);
    if (!coded) throw std::logic_error("a position that cannot be coded");
    const Prediction prediction = observer_->predict();
    for (std::size_t axis = 0; axis < coded->size(); ++axis) {
        encode(axis, (*coded)[axis], prediction, out);
    }
    learn(next, *coded);
}

std::optional<Cell> ThesisCodec::decode(entropy::Decoder& in) {
    if (!knows_position_) throw DataError("no position is known to go on from");
    const Prediction prediction = observer_->predict();
    Symbols coded{};
    std::array<std::int64_t, 3> at{};
    for (std::size_t axis = 0; axis < coded.size(); ++axis) {
        coded[axis] = decode(axis, prediction, in);
        if (coded[axis] < entropy::first_value_symbol) return std::nullopt;
        at[axis] = prediction.cell[axis] + (coded[axis] - entropy::first_value_symbol) - bound_;
        if (at[axis] < -cell_limit || at[axis] > cell_limit) {
            throw DataError("position is beyond the limits");
        }
    }
    const Cell next{static_cast<std::int32_t>(at[0]), static_cast<std::int32_t>(at[1]),
                    static_cast<std::int32_t>(at[2])};
    learn(next, coded);
    return next;
}

void ThesisCodec::learn(const Cell& next) {
    if (const auto coded = symbols(next))
        learn(next, *coded);
    else
        restart(next);
}

void ThesisCodec::learn(const Cell& next, const Symbols& coded) {
    for (std::size_t axis = 0; axis < coded.size(); ++axis) model_->learn(axis, coded[axis]);
    observer_->learn(next);
}

std::array<std::int64_t, 5> ThesisCodec::agreed() const {
    return {static_cast<std::int64_t>(options_.kind), static_cast<std::int64_t>(options_.model),
            options_.interval_ms, options_.speed_mmps, options_.resolution_mm};
}

std::string ThesisCodec::save() const {
    StateWriter out(state_version);
    for (const std::int64_t number : agreed()) out.number(number);
    out.number(knows_position_ ? 1 : 0);
    observer_->save(out);
    model_->save(out);
    return out.finish();
}

void ThesisCodec::load(std::string_view state) {
    StateReader in(state, state_version);
    for (const std::int64_t number : agreed()) in.same(number);
    const bool knows_position = in.number(0, 1) == 1;
    auto observer = observer_->clone();
    auto model = model_->clone();
    observer->load(in);
    model->load(in);
    in.finish();
    observer_ = std::move(observer);
    model_ = std::move(model);
    knows_position_ = knows_position;
}

}  // namespace seautils::position
