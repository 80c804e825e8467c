#ifndef SEAUTILS_DCCL_REPORT_HPP
#define SEAUTILS_DCCL_REPORT_HPP

#include "seautils/dccl/number.hpp"
#include "seautils/schema/layout.hpp"

#include <cstdint>
#include <string>

namespace seautils::dccl {

/// How a field is put on the wire.
enum class OpKind : std::uint8_t {
    integer,
    floating,
    boolean,
    enumeration,
    text,
    message,
    selectors,  ///< which member of each oneof is set; first in a version 4 message's body
    time,
    fixed_value,  ///< the static codec: no bits
    hash,
    native,  ///< protobuf's own value encoding
    arithmetic,
    ccl,
    custom,  ///< a FieldCodec of the program
    lost,    ///< a header leaf below a body message, which versions 3 and 4 never send
};

/// A row of the report on what a schema costs (dccl-info).
struct FieldReport {
    int depth = 0;  ///< 0: a field of the root
    const schema::Field* field = nullptr;
    std::string path;   ///< "leg.seq", "sample[].depth"
    std::string codec;  ///< resolved name, "dccl.default4"
    std::uint64_t min_bits = 0, max_bits = 0;
    bool in_head = false;
    bool lost = false;
    std::uint32_t min_repeat = 0, max_repeat = 0;
    bool has_bounds = false;
    double min = 0, max = 0, resolution = 0;
    std::string unit;
    std::uint32_t max_length = 0;
    OpKind kind = OpKind::lost;
    NumberCode number;               ///< of numbers, enumerations and times
    bool has_presence_cost = false;  ///< a code or a bit is spent on "not set"
    bool has_conditions = false;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_REPORT_HPP
