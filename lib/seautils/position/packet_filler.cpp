#include "seautils/position/packet_filler.hpp"

#include <stdexcept>

namespace seautils::position {

namespace {

/// A position takes fewer bits than this as a rule: with less room it is as well to keep the state.
constexpr std::size_t little_room = 16;

}  // namespace

PacketFiller::PacketFiller(const LinkOptions& options, const Codec& codec, const Horizon& horizon,
                           std::size_t max_bytes, std::size_t most_positions)
    : options_(options),
      codec_(codec.clone()),
      horizon_(horizon.clone()),
      most_bits_(8 * max_bytes - options.check_bits),
      most_positions_(most_positions == 0 ? options.most_pending : most_positions) {
    check(options);
}

const std::vector<Packet>& PacketFiller::add(const Fix& fix) {
    complete_.clear();
    check(fix, options_);
    if (!known_) known_.emplace(options_, *codec_, *horizon_, fix.time_ms);
    if (!put(fix)) {
        send();
        put(fix);  // alone it fits: least_bytes()
    }
    if (waiting_.size() == most_positions_) send();
    return complete_;
}

const std::vector<Packet>& PacketFiller::finish() {
    complete_.clear();
    if (!waiting_.empty()) send();
    return complete_;
}

PacketHeader PacketFiller::header(std::size_t count) const {
    PacketHeader header;
    header.ahead = header.count = static_cast<std::uint32_t>(count);
    set_reference(header, *known_, header.ahead, options_);
    return header;
}

/// Whether it fits behind those that wait; else it is not put.
bool PacketFiller::put(const Fix& fix) {
    if (!run_) run_.emplace(*known_);
    PacketHeader head = header(waiting_.size() + 1);
    if (!waiting_.empty() && run_->say_end(head) + little_room > most_bits_)
        behind_ = run_->state();
    else
        behind_.reset();
    run_->put(fix);
    if (run_->say_end(head) > most_bits_ && !waiting_.empty()) {
        run_->take_back();
        if (behind_) {
            run_->state() = std::move(*behind_);
        } else {
            TrackState state(*known_);
            for (const Fix& before : waiting_) state.learn(state.step_to(before, 1));
            run_->state() = std::move(state);
        }
        return false;
    }
    waiting_.push_back(fix);
    return true;
}

void PacketFiller::send() {
    PacketHeader head = header(waiting_.size());
    entropy::BitString bits;
    if (waiting_.size() == 1) {
        TrackState state(*known_);
        const Step step = state.step_to(waiting_.front(), 1);
        head.is_newest_full = step.is_full;
        position::put(head, bits);
        state.encode_alone(step, bits);
    } else {
        run_->say_end(head);
        position::put(head, bits);
        run_->finish(bits);
    }
    if (bits.size() > most_bits_) throw std::logic_error("a position that should fit does not");
    complete_.push_back(packed(head, bits, *known_, waiting_.back(), options_));
    known_ = std::move(run_->state());
    run_.reset();
    waiting_.clear();
}

}  // namespace seautils::position
