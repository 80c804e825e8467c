// What the fuzz targets share.
#ifndef SEAUTILS_TESTS_FUZZ_COMMON_HPP
#define SEAUTILS_TESTS_FUZZ_COMMON_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

namespace fuzz {

/// What is being looked at: said when a law is broken.
inline std::string context;

/// A law that was broken: says which, and ends the run.
inline void require(bool holds, const char* law) {
    if (holds) return;
    std::fprintf(stderr, "broken: %s\n%s\n", law, context.c_str());
    std::abort();
}

/// What a person reads of a refusal: one line of UTF-8, not endless.
inline void check_message(const std::exception& e) {
    const std::string_view what = e.what();
    context = what;
    require(!what.empty() && what.size() < 2000, "a message is short");
    require(what.find('\n') == what.npos, "a message is one line");
    require(seautils::is_valid_utf8(what), "a message is UTF-8");
}

/// Runs `body`; false: it refused, in a decent message. Anything but an Error is a fault of ours.
template <class Body>
bool accepted(Body body) {
    try {
        body();
        return true;
    } catch (const seautils::Error& e) {
        check_message(e);
        return false;
    }
}

inline std::string_view view(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace fuzz

#endif  // SEAUTILS_TESTS_FUZZ_COMMON_HPP
