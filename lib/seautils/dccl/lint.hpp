#ifndef SEAUTILS_DCCL_LINT_HPP
#define SEAUTILS_DCCL_LINT_HPP

#include "seautils/dccl/program.hpp"
#include "seautils/schema/values.hpp"

#include <string>
#include <vector>

namespace seautils::dccl {

/// A remark on a schema: correct as it is, but it costs more, or holds less, than its author thinks.
struct Remark {
    std::string kind;   ///< kebab-case, for scripts: "wasted-codes"
    std::string field;  ///< its path, or empty where the message as a whole is meant
    std::string text;   ///< one line, with the way out
};

/// What can be said of one message:
///
/// | kind | means |
/// |---|---|
/// | `wasted-codes` | a quarter or more of a number's codes stand for nothing: wider bounds are free, or slightly narrower ones save a bit |
/// | `no-time-in-header` | encrypted bodies of equal headers share a key stream, and this header has no time and no number of 16 bits or more that could count |
/// | `lost-field` | marked in_head inside of a body message: codec versions 3 and 4 never send it |
/// | `unreachable-bound` | a float's own bound is out of its range, because binary32 rounds it outwards |
/// | `over-mtu` | the message may not fit into frames of 32, 64 or 256 bytes; names the field that passes the limit |
/// | `cut-values` | an integer in steps that have a fraction: the format cuts it instead of rounding |
/// | `bounds-off-grid` | min or max is no multiple of the step that `precision` states |
/// | `time-precision` | precision of an integer time, which other releases of the reference read differently |
/// | `length-lost` | bytes of fixed size (codec versions 2 and 3) come back with zeros behind them |
std::vector<Remark> lint(const Program& program);

/// A message with typical values: numbers at the middle of their bounds, texts half full, one
/// quarter of the repeats (at least one), the first enumerator, the first member of each oneof.
/// Times are `now_s`. What has conditions is left out.
void typical_values(const Program& program, std::int64_t now_s, schema::Values& values);

/// Bytes that a struct of plain 32-bit numbers would take for these values: four for each number,
/// bool and enumerator, eight where the type has 64 bits, texts padded to four.
std::uint64_t plain_bytes(const schema::Values& values);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LINT_HPP
