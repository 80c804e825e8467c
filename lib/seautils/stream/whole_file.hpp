#ifndef SEAUTILS_STREAM_WHOLE_FILE_HPP
#define SEAUTILS_STREAM_WHOLE_FILE_HPP

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::stream {

/// All bytes of a file, cut after `most`; nothing where there is no such file.
/// @throws Error(no_input)  it cannot be opened or read
std::optional<std::string> read_whole_file(const std::string& path, std::size_t most);

/// Puts a file in the place of what `path` was, at one stroke: whoever opens it finds the old one or
/// the new one. It is not synced, which could take long; after a loss of power it may be either, or
/// cut, so it should carry a check.
/// @throws Error(cannot_create), Error(io)
void replace_file(const std::string& path, std::string_view bytes);

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_WHOLE_FILE_HPP
