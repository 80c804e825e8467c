#ifndef SEAUTILS_DCCL_MODELS_HPP
#define SEAUTILS_DCCL_MODELS_HPP

#include "seautils/entropy/arithmetic.hpp"

#include <map>
#include <string>

namespace seautils::dccl {

/// Reads a model of the arithmetic codec, a `dccl.arith.protobuf.ArithmeticModel` in protobuf's
/// text format, and adds it under its name.
/// @throws ConfigError  malformed, inconsistent (entropy::check), or a name that is there already
void add_model(const std::string& text, std::map<std::string, entropy::Model>& models);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_MODELS_HPP
