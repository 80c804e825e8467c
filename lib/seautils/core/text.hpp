#ifndef SEAUTILS_CORE_TEXT_HPP
#define SEAUTILS_CORE_TEXT_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils {

/// The text on one line of UTF-8: control characters, and bytes that are not UTF-8, as \xNN; cut
/// after `most` bytes with "…".
std::string printable(std::string_view text, std::size_t most = std::string_view::npos);

/// A value as a message quotes it: printable, in single quotes, cut after 60 bytes with "…".
std::string quote(std::string_view value);

/// A library's sentence in the middle of ours: without its capital, unless it stands in a word that
/// is all capitals.
std::string lower_first(std::string sentence);

/// `1 byte`, `2 bytes`: a number with what it counts.
std::string counted(std::uint64_t n, std::string_view thing);

/// `6 bits where 0 are left`, `2 bytes where 1 is left`.
std::string where_left(std::uint64_t wanted, std::string_view thing, std::uint64_t left);

/// Bytes of the UTF-8 character that `text` begins with, 1 to 4; 0 where it begins with none
/// (overlong forms, surrogates and numbers above U+10FFFF are none).
std::size_t utf8_length(std::string_view text);

/// Whether all of the text is UTF-8.
bool is_valid_utf8(std::string_view text);

/// The candidate that `name` may have been meant for: fewest edits, at most a third of its letters,
/// the first of equals; empty where none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);

/// Appends base64 (RFC 4648 §4, with padding).
void append_base64(std::string& out, std::string_view bytes);

/// The bytes of base64 text, in the standard or the URL alphabet, with or without padding.
/// @throws DataError  names the first bad character and its column; or the text is cut short: bits
///                    behind the last whole byte are not zero
std::string from_base64(std::string_view text);

}  // namespace seautils

#endif  // SEAUTILS_CORE_TEXT_HPP
