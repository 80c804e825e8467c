#ifndef SEAUTILS_DCCL_FIELD_CODEC_HPP
#define SEAUTILS_DCCL_FIELD_CODEC_HPP

#include "seautils/dccl/bits.hpp"
#include "seautils/dccl/options.hpp"
#include "seautils/schema/values.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace seautils::dccl {

/// A codec of fields that the program brings along: schemas name it as they name the others,
/// `(dccl.field).codec`. It is asked for whole fields; of a sub-message, for all of it.
///
/// Not set is bounds().min zeros on the wire, which the encoder puts and decode() must leave unset.
/// A codec may keep state from message to message; then its Programs are for one Codec.
class FieldCodec {
public:
    struct Bounds {
        std::uint64_t min = 0, max = 0;  ///< bits of one element
    };

    virtual ~FieldCodec() = default;

    /// Asked once for each field, before the others are.
    /// @throws ConfigError  what of the field the codec does not take; without its name
    virtual Bounds bounds(const schema::Field& field, const FieldOptions& options) = 0;

    /// Puts bounds().min to bounds().max bits. It may be asked again for the same message, and for
    /// one that is not sent after all.
    /// @param slot  of values: the field, or the element; present
    /// @throws DataError  what of the values has no code
    virtual void encode(const schema::Field& field, const schema::Values& values,
                        const schema::Slot& slot, BitWriter& out) = 0;

    /// The inverse: takes exactly those bits, also where it leaves the slot unset because it cannot
    /// know what they mean.
    /// @param slot  index of the field, or the element; it is not present, but that a sub-message
    ///              of codec version 2 may be
    /// @throws DataError, OutOfBits  they are none of encode()
    virtual void decode(const schema::Field& field, BitReader& in, schema::Values& values,
                        std::uint32_t slot) = 0;
};

using FieldCodecs = std::map<std::string, std::shared_ptr<FieldCodec>>;  ///< by name

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_FIELD_CODEC_HPP
