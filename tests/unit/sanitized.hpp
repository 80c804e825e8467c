#ifndef SEAUTILS_TESTS_SANITIZED_HPP
#define SEAUTILS_TESTS_SANITIZED_HPP

// Whether this is a build with AddressSanitizer: what takes a minute of whole tracks or grids there, and
// walks the same code as shorter tests, is left to the other builds.
#if defined(__SANITIZE_ADDRESS__)
#define SEAUTILS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SEAUTILS_SANITIZED 1
#endif
#endif

namespace seautils {

#ifdef SEAUTILS_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace seautils

#endif  // SEAUTILS_TESTS_SANITIZED_HPP
