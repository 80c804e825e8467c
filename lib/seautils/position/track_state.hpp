#ifndef SEAUTILS_POSITION_TRACK_STATE_HPP
#define SEAUTILS_POSITION_TRACK_STATE_HPP

#include "seautils/position/codec.hpp"
#include "seautils/position/horizon.hpp"
#include "seautils/position/packet.hpp"
#include "seautils/position/state_bytes.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::position {

/// What is known of a track up to a reference, at either end: it depends only on the steps learnt,
/// not on the packets that they came in. A value.
class TrackState {
public:
    /// Nothing is known of the session that starts at that time.
    /// @param options  outlives it; so for all that are copied from it
    TrackState(const LinkOptions& options, const Codec& codec, const Horizon& horizon,
               std::int64_t start_ms);
    TrackState(const TrackState& other);
    TrackState& operator=(const TrackState& other);
    TrackState(TrackState&&) noexcept = default;
    TrackState& operator=(TrackState&&) noexcept = default;

    std::int64_t start_ms() const { return start_ms_; }
    std::uint64_t number() const { return number_; }  ///< of the last position; 0: none yet
    const Fix& last() const { return last_; }
    /// Stands for all steps learnt, the session and the options.
    std::uint64_t mark() const { return mark_; }
    /// How far ahead positions were of late.
    Habit habit() const;
    /// When a position so many intervals later is due.
    std::int64_t due_ms(std::uint32_t ahead) const;

    /// The step that leads there: full if the time is not as due, or where the codec cannot.
    Step step_to(const Fix& fix, std::uint32_t ahead) const;
    void learn(const Step& step);

    /// One position of several, the next one; learns it.
    void encode(const Step& step, entropy::Encoder& out);
    Step decode(entropy::Decoder& in);

    /// As all that a packet holds: ahead 1 is the next one, more is over the horizon. Learns it.
    void encode_alone(const Step& step, entropy::BitString& out);
    Step decode_alone(std::uint32_t ahead, bool is_full, entropy::BitReader& in);

    /// The newest position, before others in the same coder; does not learn it.
    void encode_peek(const Step& step, entropy::Encoder& out) const;
    Step decode_peek(std::uint32_t ahead, bool is_full, entropy::Decoder& in) const;

    std::string save() const;
    /// @throws DataError  damaged, or of other options
    void load(std::string_view state);

private:
    static constexpr std::int64_t long_since = 16;

    Step full_step(std::uint32_t ahead, entropy::Decoder& in) const;
    Step decoded(const std::optional<Cell>& cell);
    void note(const Step& step);

    const LinkOptions* options_;
    std::unique_ptr<Codec> codec_;
    std::unique_ptr<Horizon> horizon_;
    std::int64_t start_ms_;
    std::uint64_t number_ = 0;
    Fix last_;
    std::uint64_t mark_;
    std::int64_t mean_skipped_q8_ = 0;      ///< intervals between positions that stayed unknown
    std::int64_t averaged_ = 0;             ///< steps in that mean, at most long_since
    std::int64_t since_jump_ = long_since;  ///< steps, at most that
};

/// Any 64 bits. (A number of a position: get_number() refuses what would overflow.)
void put_word(StateWriter& out, std::uint64_t word);
std::uint64_t get_word(StateReader& in);
std::uint64_t get_number(StateReader& in);
void put(StateWriter& out, const Fix& fix);
void put(StateWriter& out, const Step& step);
/// @throws DataError  also: beyond the limits of a Cell
Fix get_fix(StateReader& in);
Step get_step(StateReader& in);

/// The mark after a step from the state with the mark before.
std::uint64_t mark_after(std::uint64_t mark, const Step& step);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_TRACK_STATE_HPP
