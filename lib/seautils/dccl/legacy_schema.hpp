#ifndef SEAUTILS_DCCL_LEGACY_SCHEMA_HPP
#define SEAUTILS_DCCL_LEGACY_SCHEMA_HPP

#include "seautils/schema/layout.hpp"

#include <cstdint>
#include <list>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::dccl {

enum class LegacyKind : std::uint8_t { boolean, number, string, enumeration, hex, fixed };

/// A field of a DCCL 1 message. Scaled numbers count steps of 10^-precision.
struct LegacyField {
    std::string name;
    LegacyKind kind = LegacyKind::number;
    double min = 0, max = 0;  ///< numbers, inclusive
    int precision = 0;        ///< decimals, -12 to 12; negative: tens, hundreds, …
    double max_delta = 0;     ///< 0: the elements of an array are coded one by one
    std::uint32_t array_length = 1;
    std::uint32_t max_length = 0;     ///< string: characters; hex: bytes
    std::vector<std::string> values;  ///< enumeration: its names; fixed: its only value
    unsigned width = 0;               ///< bits of element 0, and of each where no max_delta is
    unsigned delta_width = 0;         ///< bits of the other elements

    std::uint64_t bits() const;  ///< of all elements
    /// x in steps, rounded to the nearest, halves to even; and back, so rounded, as the double
    /// nearest to the decimal number. Back it is never -0.
    double scaled(double x) const;
    double unscaled(double steps) const;
    /// A bound or a difference in steps: whole where it is meant to be (0.3 / 0.1).
    double bound_scaled(double x) const;
    /// From the least to the greatest, in steps: of element 0, and of a difference from it.
    double key_span() const { return bound_scaled(max) - bound_scaled(min); }
    double delta_span() const { return 2 * bound_scaled(max_delta); }
};

/// Places of the header's parts in the layout; the fields of the body follow.
enum LegacyHeader : std::uint32_t {
    header_time,
    header_src,
    header_dest,
    header_multimessage,
    header_broadcast,
    header_unused,
    header_ccl_id,
    header_id,
    header_parts
};

/// A message of DCCL 1. Its layout holds the header's parts first, by their names ("_time",
/// "_src_id", …, or as the file renames them), then the body's fields.
class LegacyMessage {
public:
    const std::string& name() const { return name_; }
    std::uint32_t id() const { return id_; }
    std::uint32_t max_bytes() const { return max_bytes_; }  ///< `<size>`
    std::uint64_t body_bits() const { return body_bits_; }
    std::uint64_t largest_bytes() const { return 6 + (body_bits_ + 7) / 8; }
    const std::vector<LegacyField>& fields() const { return fields_; }
    const schema::Layout& layout() const { return *layout_; }
    /// Elements of the field of that name.
    std::uint32_t array_length(std::string_view name) const;

private:
    friend class LegacyLoader;
    std::string name_;
    std::uint32_t id_ = 0, max_bytes_ = 0;
    std::uint64_t body_bits_ = 0;
    std::vector<LegacyField> fields_;
    const schema::Layout* layout_ = nullptr;
};

struct LegacySchema {
    std::list<LegacyMessage> messages;      ///< in the order of the files; addresses stay
    std::vector<std::string> ignored_tags;  ///< tags without a meaning here, each once, in order
};

/// Reads XML files of DCCL 1 (`message_set`). Limits: 1 MiB a file, 512 messages (their ids),
/// 65,536 bytes a message, 10,000 fields.
///
/// Left open by the sources, and decided so: `<repeat/>` leaves static fields single; a max_delta
/// of 0 means none; names of fields and header parts must differ. A number is at most 2^53 steps
/// from 0, or 2^51 where it has a precision: beyond, a double does not keep each step apart.
/// @throws Error(no_input)  cannot be opened
/// @throws ConfigError      `FILE:LINE: what`: not well-formed, a tag that is missing, a number that
///                          is none, a layout that is longer than `<size>`, ids or names twice
LegacySchema load_legacy(const std::vector<std::string>& files, schema::LayoutSet& layouts);

/// The same for one text (tests, fuzzing); `file` stands for it in messages.
LegacySchema parse_legacy(const std::string& file, std::string_view xml,
                          schema::LayoutSet& layouts);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LEGACY_SCHEMA_HPP
