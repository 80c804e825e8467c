#include "seautils/position/cost.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace seautils::position {

CostMeter::CostMeter(std::unique_ptr<Codec> codec, const Grid& grid,
                     std::uint32_t deltas_per_packet)
    : codec_(std::move(codec)),
      full_bits_(position::full_bits(grid)),
      deltas_per_packet_(deltas_per_packet),
      coder_(packet_.bits) {
    if (deltas_per_packet < 1 || deltas_per_packet > most_deltas)
        throw ConfigError(
            fmt::format("{} deltas a packet are outside 1 to {}", deltas_per_packet, most_deltas));
}

void CostMeter::add(const Sample& sample, std::vector<CodedPositions>& out) {
    if (sample.starts || !codec_->can_encode(sample.cell)) {
        close_packet(out);
        codec_->restart(sample.cell);
        out.push_back({{sample.cell}, true, {}});
        ++cost_.fulls;
        cost_.full_bits += full_bits_;
        return;
    }
    if (deltas_per_packet_ == 1)
        codec_->encode_alone(sample.cell, packet_.bits);
    else
        codec_->encode(sample.cell, coder_);
    packet_.cells.push_back(sample.cell);
    if (packet_.cells.size() == deltas_per_packet_) close_packet(out);
}

void CostMeter::finish(std::vector<CodedPositions>& out) { close_packet(out); }

void CostMeter::close_packet(std::vector<CodedPositions>& out) {
    if (packet_.cells.empty()) return;
    if (deltas_per_packet_ > 1) coder_.finish();
    const std::size_t deltas = packet_.cells.size(), bits = packet_.bits.size();
    const std::size_t each = (2 * bits + deltas) / (2 * deltas);
    if (cost_.deltas_by_bits.size() <= each) cost_.deltas_by_bits.resize(each + 1);
    cost_.deltas_by_bits[each] += deltas;
    cost_.deltas += deltas;
    cost_.delta_bits += bits;
    out.push_back(packet_);
    packet_.cells.clear();
    packet_.bits.clear();
}

void CostCheck::check(const CodedPositions& packet) {
    if (packet.is_full) return codec_->restart(packet.cells.front());
    entropy::BitReader reader(packet.bits.bytes(), packet.bits.size());
    entropy::Decoder decoder(reader);
    try {
        for (const Cell& cell : packet.cells) {
            const auto got = alone_ ? codec_->decode_alone(reader) : codec_->decode(decoder);
            if (got != cell) throw std::logic_error("what was decoded is not what was coded");
        }
    } catch (const DataError& e) {
        throw std::logic_error(std::string("what was coded cannot be decoded: ") + e.what());
    }
    if (reader.left() != 0) throw std::logic_error("the decoder left bits");
}

}  // namespace seautils::position
