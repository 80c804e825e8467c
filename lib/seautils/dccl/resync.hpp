#ifndef SEAUTILS_DCCL_RESYNC_HPP
#define SEAUTILS_DCCL_RESYNC_HPP

#include "seautils/dccl/type_set.hpp"

#include <map>

namespace seautils::dccl {

/// Where in unframed bytes a message begins.
struct Found {
    std::size_t skipped;  ///< bytes before it
    bool synchronous;     ///< false: nothing yet, more bytes may tell
};

/// Looks for the first place at which a message decodes and encodes to the same bytes again: what
/// noise seldom does. Not for adaptive arithmetic models, which cannot follow a lost message.
/// @param ended  no more bytes will come: a message that is cut short does not count
Found find_message(TypeSet& types, std::string_view bytes, bool ended);

/// The largest number of elements of each repeated field of a type, by its path ("sample"): what
/// schema::CsvWriter makes its columns of.
std::map<std::string, std::uint32_t> repeats(const Type& type);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_RESYNC_HPP
