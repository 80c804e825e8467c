#include "seautils/position/track_state.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 2;

/// Of a full fix where others are usual, in 1/65536: costs those 0.00035 bit.
constexpr std::uint32_t full_chance = 16;

std::uint64_t word(std::int32_t high, std::int32_t low) {
    return std::uint64_t{static_cast<std::uint32_t>(high)} << 32 | static_cast<std::uint32_t>(low);
}

void check_time(std::int64_t time_ms) {
    if (time_ms < 0 || time_ms > most_time_ms)
        throw DataError("packet: a time is out of its range");
}

}  // namespace

std::uint64_t mark_after(std::uint64_t mark, const Step& step) {
    mark = splitmix64(mark ^ (std::uint64_t{step.ahead} * 2 + (step.is_full ? 1 : 0)));
    mark = splitmix64(mark ^ word(step.fix.cell.x, step.fix.cell.y));
    mark = splitmix64(mark ^ word(step.fix.cell.z, 0));
    return splitmix64(mark ^ static_cast<std::uint64_t>(step.fix.time_ms));
}

void put_word(StateWriter& out, std::uint64_t word) { out.number(static_cast<std::int64_t>(word)); }

std::uint64_t get_word(StateReader& in) {
    using Limits = std::numeric_limits<std::int64_t>;
    return static_cast<std::uint64_t>(in.number(Limits::min(), Limits::max()));
}

std::uint64_t get_number(StateReader& in) {
    return static_cast<std::uint64_t>(in.number(0, std::int64_t{1} << 62));
}

void put(StateWriter& out, const Fix& fix) {
    out.number(fix.time_ms);
    for (const std::int32_t v : {fix.cell.x, fix.cell.y, fix.cell.z}) out.number(v);
}

void put(StateWriter& out, const Step& step) {
    out.number(std::int64_t{step.ahead} * 2 + (step.is_full ? 1 : 0));
    put(out, step.fix);
}

Fix get_fix(StateReader& in) {
    const auto axis = [&in] {
        return static_cast<std::int32_t>(in.number(-cell_limit, cell_limit));
    };
    Fix fix;
    fix.time_ms = in.number(-most_time_ms, most_time_ms);
    fix.cell.x = axis();
    fix.cell.y = axis();
    fix.cell.z = axis();
    return fix;
}

Step get_step(StateReader& in) {
    const std::int64_t first = in.number(0, std::int64_t{most_ahead} * 2 + 1);
    const Fix fix = get_fix(in);
    return {static_cast<std::uint32_t>(first / 2), first % 2 == 1, fix};
}

TrackState::TrackState(const LinkOptions& options, const Codec& codec, const Horizon& horizon,
                       std::int64_t start_ms)
    : options_(&options),
      codec_(codec.clone()),
      horizon_(horizon.clone()),
      start_ms_(start_ms),
      mark_(splitmix64(agreed(options) ^ static_cast<std::uint64_t>(start_ms))) {
    last_.time_ms = start_ms - options.interval_ms;
}

TrackState::TrackState(const TrackState& other)
    : options_(other.options_),
      codec_(other.codec_->clone()),
      horizon_(other.horizon_->clone()),
      start_ms_(other.start_ms_),
      number_(other.number_),
      last_(other.last_),
      mark_(other.mark_),
      mean_skipped_q8_(other.mean_skipped_q8_),
      averaged_(other.averaged_),
      since_jump_(other.since_jump_) {}

TrackState& TrackState::operator=(const TrackState& other) { return *this = TrackState(other); }

std::int64_t TrackState::due_ms(std::uint32_t ahead) const {
    return last_.time_ms + std::int64_t{ahead} * options_->interval_ms;
}

Step TrackState::step_to(const Fix& fix, std::uint32_t ahead) const {
    const bool follows =
        number_ > 0 && fix.time_ms == due_ms(ahead) && (ahead > 1 || codec_->can_encode(fix.cell));
    return {ahead, !follows, fix};
}

/// A Rice code's best parameter for a geometric distribution of that mean: the width of 0.72 of it.
Habit TrackState::habit() const {
    if (since_jump_ == long_since) return {};
    const auto most = static_cast<std::uint64_t>(mean_skipped_q8_ * 184 >> 16);
    return {true, static_cast<unsigned>(std::bit_width(most))};
}

void TrackState::note(const Step& step) {
    const std::int64_t skipped = std::int64_t{step.ahead} - 1;
    if (skipped > 0 && since_jump_ == long_since) averaged_ = 0;
    averaged_ = std::min(averaged_ + 1, long_since);
    mean_skipped_q8_ += (skipped * 256 - mean_skipped_q8_) / averaged_;
    since_jump_ = skipped > 0 ? 0 : std::min(since_jump_ + 1, long_since);
    number_ += step.ahead;
    last_ = step.fix;
    mark_ = mark_after(mark_, step);
}

void TrackState::learn(const Step& step) {
    if (step.is_full) {
        codec_->restart(step.fix.cell);
        horizon_->restart(step.fix.cell);
    } else if (step.ahead == 1) {
        codec_->learn(step.fix.cell);
        horizon_->learn(step.fix.cell);
    } else {
        codec_->learn_ahead(step.ahead, last_.cell, step.fix.cell);
        horizon_->learn_ahead(step.ahead, step.fix.cell);
    }
    note(step);
}

void TrackState::encode(const Step& step, entropy::Encoder& out) {
    out.bit(step.is_full, full_chance);
    if (step.is_full) {
        put_full(step.fix, due_ms(step.ahead), *options_, out);
        return learn(step);
    }
    codec_->encode(step.fix.cell, out);
    horizon_->learn(step.fix.cell);
    note(step);
}

Step TrackState::full_step(std::uint32_t ahead, entropy::Decoder& in) const {
    const Step step{ahead, true, get_full(due_ms(ahead), *options_, in)};
    check_time(step.fix.time_ms);
    return step;
}

/// What the codec found, and learnt, is the next position.
Step TrackState::decoded(const std::optional<Cell>& cell) {
    if (!cell) throw DataError("packet ends before its positions");
    const Step step{1, false, {due_ms(1), *cell}};
    check_time(step.fix.time_ms);
    horizon_->learn(*cell);
    note(step);
    return step;
}

Step TrackState::decode(entropy::Decoder& in) {
    if (in.bit(full_chance)) {
        const Step step = full_step(1, in);
        learn(step);
        return step;
    }
    if (number_ == 0) throw DataError("packet: the first position is no full fix");
    return decoded(codec_->decode(in));
}

void TrackState::encode_alone(const Step& step, entropy::BitString& out) {
    if (step.is_full || step.ahead > 1) {
        entropy::Encoder coder(out);
        encode_peek(step, coder);
        coder.finish();
        return learn(step);
    }
    codec_->encode_alone(step.fix.cell, out);
    horizon_->learn(step.fix.cell);
    note(step);
}

Step TrackState::decode_alone(std::uint32_t ahead, bool is_full, entropy::BitReader& in) {
    if (is_full || ahead > 1) {
        entropy::Decoder coder(in);
        const Step step = decode_peek(ahead, is_full, coder);
        learn(step);
        return step;
    }
    return decoded(codec_->decode_alone(in));
}

void TrackState::encode_peek(const Step& step, entropy::Encoder& out) const {
    if (step.is_full) return put_full(step.fix, due_ms(step.ahead), *options_, out);
    horizon_->encode(step.ahead, step.fix.cell, out);
}

Step TrackState::decode_peek(std::uint32_t ahead, bool is_full, entropy::Decoder& in) const {
    if (is_full) return full_step(ahead, in);
    if (number_ == 0) throw DataError("packet: the first position is no full fix");
    const Step step{ahead, false, {due_ms(ahead), horizon_->decode(ahead, in)}};
    check_time(step.fix.time_ms);
    return step;
}

std::string TrackState::save() const {
    StateWriter out(state_version);
    out.number(start_ms_);
    put_word(out, number_);
    put_word(out, mark_);
    put(out, last_);
    out.number(mean_skipped_q8_);
    out.number(averaged_);
    out.number(since_jump_);
    out.text(codec_->save());
    out.text(horizon_->save());
    return out.finish();
}

void TrackState::load(std::string_view state) {
    StateReader in(state, state_version);
    TrackState next(*this);
    next.start_ms_ = in.number(0, most_time_ms);
    next.number_ = get_number(in);
    next.mark_ = get_word(in);
    next.last_ = get_fix(in);
    next.mean_skipped_q8_ = in.number(0, std::int64_t{most_ahead} * 256);
    next.averaged_ = in.number(0, long_since);
    next.since_jump_ = in.number(0, long_since);
    next.codec_->load(in.text());
    next.horizon_->load(in.text());
    in.finish();
    *this = std::move(next);
}

}  // namespace seautils::position
