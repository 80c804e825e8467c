#ifndef SEAUTILS_DCCL_LEGACY_CODEC_HPP
#define SEAUTILS_DCCL_LEGACY_CODEC_HPP

#include "seautils/dccl/crypto.hpp"
#include "seautils/dccl/legacy_schema.hpp"
#include "seautils/schema/values.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::dccl {

struct LegacyOptions {
    /// What cannot be coded becomes "not given", as in the original: a value out of range, an
    /// unknown enumerator; texts and arrays that are too long are cut, surplus bytes are ignored.
    /// Else each of these is refused.
    bool lenient = false;
    const Cipher* cipher = nullptr;  ///< null: bodies are in the clear
    std::int64_t now_s = 0;          ///< the reference time, seconds since 1970, UTC
};

/// Appends the frame: 6 bytes of header, then the body without its trailing zero bytes.
///
/// A time that is not given is `now_s`; source, destination and flags are 0. Where element 0 of an
/// array with max_delta is not given, none of its elements is, as the format has it.
/// @throws DataError  names the field, quotes the value, states the bound
void encode(const LegacyMessage& message, const schema::Values& values,
            const LegacyOptions& options, std::string& out);

/// Decodes a frame; returns the bytes taken, which are all of them. The time gets the day that
/// brings it nearest to `now_s`. Flags and unused bits are present where they are not 0. Arrays
/// have all their elements, those not given as null.
/// @throws DataError  cut short in the header, longer than the message can be, a code that stands
///                    for nothing
std::size_t decode(const LegacyMessage& message, std::string_view bytes,
                   const LegacyOptions& options, schema::Values& values);

/// The identifier in a frame's header, 0 to 511. @throws DataError  too short, or another protocol
std::int32_t legacy_id(std::string_view bytes);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LEGACY_CODEC_HPP
