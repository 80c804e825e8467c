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

/// All bytes of a file that has to be there.
/// @throws Error(no_input)  it is not there, or cannot be opened or read
/// @throws ConfigError      it is longer than `most`, 1 GiB at most
std::string read_input_file(const std::string& path, std::size_t most);
/// All that comes from a descriptor; `name` stands for it in messages.
/// @throws  as read_input_file()
std::string read_input_descriptor(int fd, const std::string& name, std::size_t most);

/// Whether what was written outlives a loss of power.
enum class Sync {
    no,   ///< it may be the old file then, the new one, or cut: it should carry a check
    yes,  ///< it is on the disk before the call returns, which may take long
};

/// Puts a file in the place of what `path` was, at one stroke: whoever opens it finds the old one or
/// the new one, also after a kill at any moment.
/// @throws Error(cannot_create), Error(io)
void replace_file(const std::string& path, std::string_view bytes, Sync sync = Sync::no);

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_WHOLE_FILE_HPP
