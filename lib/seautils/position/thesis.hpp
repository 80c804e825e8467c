#ifndef SEAUTILS_POSITION_THESIS_HPP
#define SEAUTILS_POSITION_THESIS_HPP

#include "seautils/position/codec.hpp"
#include "seautils/position/delta_model.hpp"
#include "seautils/position/observer.hpp"

#include <array>

namespace seautils::position {

/// The codecs of T. Schneider's thesis (MIT/WHOI 2013, chapter 3): an observer says where the
/// vehicle is expected, and the difference is coded with the weights of a model, x, y, z in turn.
///
/// - A position of which a delta is out of the model's bounds cannot be coded: it is sent as a full
///   fix. learn() of such a one is restart(), as both ends do then.
/// - Within a packet, out_of_range_symbol says that the next position is such a one, and that the
///   packet ends; eof_symbol, that it ends. decode() takes both for the end (in whichever axis the
///   first of them stands), and nothing is learnt. The end is a symbol of every packet, also of
///   those that hold one position; that costs 0.014 bit of them.
/// - A new codec knows no position: can_encode() is false until restart() or learn().
class ThesisCodec final : public Codec {
public:
    /// @param options  of the kind fixed or kalman; in their ranges
    explicit ThesisCodec(const CodecOptions& options);
    ThesisCodec(const ThesisCodec& other);
    ThesisCodec& operator=(const ThesisCodec&) = delete;

    std::unique_ptr<Codec> clone() const override { return std::make_unique<ThesisCodec>(*this); }
    void restart(const Cell& cell) override;
    bool can_encode(const Cell& next) const override { return symbols(next).has_value(); }
    void encode(const Cell& next, entropy::Encoder& out) override;
    std::optional<Cell> decode(entropy::Decoder& in) override;
    void learn(const Cell& next) override;
    bool has_end() const override { return true; }
    void encode_end(entropy::Encoder& out) override {
        encode(0, entropy::eof_symbol, observer_->predict(), out);
    }
    /// That the next position cannot be coded, and that the packet ends.
    void encode_out_of_range(entropy::Encoder& out) const {
        encode(0, entropy::out_of_range_symbol, observer_->predict(), out);
    }
    std::string save() const override;
    void load(std::string_view state) override;

private:
    using Symbols = std::array<entropy::Symbol, 3>;

    /// Of the deltas to this position; nothing: it cannot be coded.
    std::optional<Symbols> symbols(const Cell& next) const;
    void encode(std::size_t axis, entropy::Symbol symbol, const Prediction& prediction,
                entropy::Encoder& out) const;
    entropy::Symbol decode(std::size_t axis, const Prediction& prediction,
                           entropy::Decoder& in) const;
    void learn(const Cell& next, const Symbols& symbols);
    /// What both ends must agree on, as save() states it.
    std::array<std::int64_t, 5> agreed() const;

    CodecOptions options_;
    std::int64_t bound_;  ///< of a delta, in cells
    std::unique_ptr<Observer> observer_;
    std::unique_ptr<DeltaModel> model_;
    bool knows_position_ = false;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_THESIS_HPP
