#ifndef SEAUTILS_POSITION_DELTA_MODEL_HPP
#define SEAUTILS_POSITION_DELTA_MODEL_HPP

#include "seautils/entropy/coder.hpp"
#include "seautils/entropy/model.hpp"
#include "seautils/position/codec.hpp"
#include "seautils/position/observer.hpp"
#include "seautils/position/state_bytes.hpp"

#include <cstdint>
#include <memory>

namespace seautils::position {

/// How likely each difference of a position from its prediction is held to be, an axis at a time.
///
/// Symbols are those of entropy: eof_symbol, out_of_range_symbol, then -bound to bound. "No more"
/// is a symbol of the first axis (x) only, as a packet can end between positions and not within
/// one. Those two have the weight 1 and are never learnt, so that the state is the same however the
/// positions were put into packets.
class DeltaModel {
public:
    virtual ~DeltaModel() = default;
    virtual std::unique_ptr<DeltaModel> clone() const = 0;

    /// @param axis       0 to 2: x, y, z
    /// @param deviation  of the prediction, in 1/65536 cell, 1 to 2^40; of the Gaussian model
    virtual std::uint32_t total(std::size_t axis) const = 0;
    virtual entropy::Counts::Part part(std::size_t axis, entropy::Symbol symbol,
                                       std::int64_t deviation) const = 0;
    /// @param cumulative  less than the total
    virtual entropy::Symbol find(std::size_t axis, std::uint32_t cumulative,
                                 std::int64_t deviation) const = 0;
    virtual void learn(std::size_t axis, entropy::Symbol symbol) = 0;

    virtual void save(StateWriter& out) const = 0;
    /// @throws DataError  damaged; the model is then to be thrown away
    virtual void load(StateReader& in) = 0;
};

/// Deltas of `bound` cells and less, on either side: 1 to max_delta. 50 m, as the reference figures
/// have it (101 values of 1 m, eq. 3.24), or 2 s*tau where that is more: a vehicle that turns back
/// is so far from where it was expected, and a lesser bound makes each turn a full fix. No more than
/// max_delta cells: of 1 mm, 5 m.
std::int64_t delta_bound(const CodecOptions& options);

/// uniform: each value weighs 1. gaussian: normal about the prediction, of the observer's
/// deviation (2 bounds at most), cut off at the bounds, in 2^20 parts, and 1 for each value so that none has none.
/// adaptive: each value weighs 1 and once more for each time that it came (to 2^30 in all).
std::unique_ptr<DeltaModel> make_delta_model(CodecOptions::Model model, std::int64_t bound);

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_DELTA_MODEL_HPP
