#ifndef FMT_FORMAT_H
#define FMT_FORMAT_H

#include <string>
#include <string_view>

/// Stands in for fmt, which is not there for each machine and takes long to compile: the program
/// is about the bits of codecs, and not about what they say of errors.
namespace fmt {

template <class... Args>
std::string format(std::string_view text, const Args&...) {
    return std::string(text);
}

}  // namespace fmt

#endif  // FMT_FORMAT_H
