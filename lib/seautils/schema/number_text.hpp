#ifndef SEAUTILS_SCHEMA_NUMBER_TEXT_HPP
#define SEAUTILS_SCHEMA_NUMBER_TEXT_HPP

#include <cstdint>
#include <string>

namespace seautils::schema {

void append_integer(std::string& out, std::int64_t x);
void append_integer(std::string& out, std::uint64_t x);

/// Appends the shortest decimal that reads back as the same double: plain from 1e-4 to 1e16, and
/// where six decimals are enough; with an exponent beyond; `nan`, `inf`, `-inf`.
void append_double(std::string& out, double x);

/// The same for a binary32 number, which reads back the same when it is rounded to binary32. A
/// whole number below 1e9 is written out.
void append_float(std::string& out, float x);

/// So many decimals, all of them written: x to the nearest, halves away from 0. Never `-0.00`.
/// Beyond 2^53 units of the last decimal, and what is no number, as append_double() has it.
/// @param decimals  0 to 12
void append_fixed(std::string& out, double x, unsigned decimals);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_NUMBER_TEXT_HPP
