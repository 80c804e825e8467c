#ifndef SEAUTILS_STREAM_HEX_HPP
#define SEAUTILS_STREAM_HEX_HPP

#include <string>
#include <string_view>

namespace seautils::stream {

/// Appends two lower-case digits for each byte.
void append_hex(std::string& out, std::string_view bytes);

/// Replaces `bytes` by what the digits say, in either case; blanks around them are no matter.
/// @throws DataError  names the first character that is no digit and its column, or an odd number
void from_hex(std::string_view text, std::string& bytes);

/// Appends the bytes with their number in front as a varint: protobuf's length-delimited stream.
void append_delimited(std::string& out, std::string_view bytes);

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_HEX_HPP
