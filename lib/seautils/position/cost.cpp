#include "seautils/position/cost.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace seautils::position {

CostMeter::CostMeter(const CodecOptions& codec, const Grid& grid, std::uint32_t deltas_per_packet)
    : CostMeter(make_codec(codec), grid, deltas_per_packet) {}

CostMeter::CostMeter(std::unique_ptr<Codec> codec, const Grid& grid,
                     std::uint32_t deltas_per_packet)
    : sender_(std::move(codec)),
      receiver_(sender_->clone()),
      full_bits_(position::full_bits(grid)),
      deltas_per_packet_(deltas_per_packet),
      coder_(std::make_unique<entropy::Encoder>(bits_)) {
    if (deltas_per_packet < 1 || deltas_per_packet > most_deltas)
        throw ConfigError(
            fmt::format("{} deltas a packet are outside 1 to {}", deltas_per_packet, most_deltas));
}

void CostMeter::add(const Sample& sample) {
    if (sample.starts || !sender_->can_encode(sample.cell)) return full(sample.cell);
    if (deltas_per_packet_ == 1)
        sender_->encode_alone(sample.cell, bits_);
    else
        sender_->encode(sample.cell, *coder_);
    packet_.push_back(sample.cell);
    if (packet_.size() == deltas_per_packet_) close_packet();
}

const Cost& CostMeter::finish() {
    close_packet();
    return cost_;
}

void CostMeter::full(const Cell& cell) {
    close_packet();
    sender_->restart(cell);
    receiver_->restart(cell);
    ++cost_.fulls;
    cost_.full_bits += full_bits_;
}

void CostMeter::close_packet() {
    if (packet_.empty()) return;
    if (deltas_per_packet_ > 1) coder_->finish();
    check_packet();
    const std::size_t deltas = packet_.size();
    const std::size_t each = (2 * bits_.size() + deltas) / (2 * deltas);
    if (cost_.deltas_by_bits.size() <= each) cost_.deltas_by_bits.resize(each + 1);
    cost_.deltas_by_bits[each] += deltas;
    cost_.deltas += deltas;
    cost_.delta_bits += bits_.size();
    ++cost_.packets;
    bits_.clear();
    packet_.clear();
}

void CostMeter::check_packet() {
    entropy::BitReader reader(bits_.bytes(), bits_.size());
    entropy::Decoder decoder(reader);
    const auto next = [&] {
        return deltas_per_packet_ == 1 ? receiver_->decode_alone(reader)
                                       : receiver_->decode(decoder);
    };
    try {
        for (const Cell& cell : packet_) {
            if (next() != cell) throw std::logic_error("what was decoded is not what was coded");
        }
    } catch (const DataError& e) {
        throw std::logic_error(std::string("what was coded cannot be decoded: ") + e.what());
    }
    if (reader.left() != 0) throw std::logic_error("the decoder left bits");
}

}  // namespace seautils::position
