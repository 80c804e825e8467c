#ifndef SEAUTILS_POSITION_CODEC_HPP
#define SEAUTILS_POSITION_CODEC_HPP

#include "seautils/entropy/coder.hpp"
#include "seautils/position/cell.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::position {

/// What both ends of a link know of one vehicle's track, and how they code its next position from
/// that. Positions follow each other at an even interval of time.
///
/// Integers only: two codecs of the same options that learnt the same positions in the same order
/// code the next one in the same bits, on any machine, however those positions were sent (in
/// packets of one or of many, or not at all: learn()). After an exception of decode() the codec is
/// to be thrown away: decode with a clone of what is known.
class Codec {
public:
    virtual ~Codec() = default;
    virtual std::unique_ptr<Codec> clone() const = 0;

    /// A position that both ends know otherwise: a full fix, at the start and after a gap. What was
    /// learnt of the vehicle's ways is kept; that it moves is forgotten.
    virtual void restart(const Cell& cell) = 0;

    /// Whether encode() can code this one next; if not, it is sent as a full fix.
    virtual bool can_encode(const Cell& next) const = 0;

    /// Codes the next position, and learns it. @throws std::logic_error  can_encode() is false
    virtual void encode(const Cell& next, entropy::Encoder& out) = 0;
    /// The inverse; nothing: the sender put encode_end() here.
    /// @throws DataError  the bits end, or lead beyond the limits of a Cell
    virtual std::optional<Cell> decode(entropy::Decoder& in) = 0;

    /// Learns the next position as encode() does, and codes nothing. The first of all is a restart().
    virtual void learn(const Cell& next) = 0;
    /// Learns a position `ahead` (2 or more) intervals after the last one, which was `from`; those
    /// between are not known. A codec that has no better way of its own starts anew one interval
    /// before, as if the vehicle had gone straight on.
    virtual void learn_ahead(std::uint32_t ahead, const Cell& from, const Cell& to);

    /// Codes one position as all that a packet holds, and learns it: in the fewest whole bits.
    virtual void encode_alone(const Cell& next, entropy::BitString& out);
    /// The inverse; reads exactly what encode_alone() put. @throws DataError  as decode()
    virtual std::optional<Cell> decode_alone(entropy::BitReader& in);

    /// Whether "no more positions" has a code: codecs of the thesis, for packets that hold fewer
    /// positions than was agreed. (Others count them in the header of the packet.)
    virtual bool has_end() const { return false; }
    /// @throws std::logic_error  has_end() is false
    virtual void encode_end(entropy::Encoder& out);

    /// All that was learnt, to be kept over a restart: bytes that load() of a codec of the same
    /// options takes, the same on any machine. They begin with a version.
    virtual std::string save() const = 0;
    /// @throws DataError  of another version (named), of other options, cut or damaged; the codec
    ///                    is then as it was
    virtual void load(std::string_view state) = 0;
};

/// Which codec, and what both ends must agree on. Whole numbers, so that they are the same at both.
struct CodecOptions {
    enum class Kind {
        mix,     ///< predictors mixed in the logistic domain (mix.hpp)
        fixed,   ///< of the thesis: the vehicle goes on at its speed and heading
        kalman,  ///< of the thesis: Kalman filter of position, velocity and acceleration
    };
    enum class Model { uniform, gaussian, adaptive };  ///< of fixed and kalman

    Kind kind = Kind::mix;
    Model model = Model::adaptive;
    std::int64_t interval_ms = 10'000;   ///< between positions, tau: 1 to 86,400,000
    std::int64_t speed_mmps = 1'500;     ///< the vehicle's usual speed: 1 to 100,000; fixed, kalman
    std::int64_t resolution_mm = 1'000;  ///< of a Cell: 1 to 1,000,000
    bool small = false;                  ///< mix: two thirds of the memory
    /// mix: the waypoints of the mission in order, at most 65,535; x, y and z of each, cells. Both ends
    /// know them: turns then are no surprise. None: no plan.
    std::vector<Cell> plan;
};

/// @throws ConfigError  a number out of its range, named
std::unique_ptr<Codec> make_codec(const CodecOptions& options);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_CODEC_HPP
