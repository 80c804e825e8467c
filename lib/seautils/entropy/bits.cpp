#include "seautils/entropy/bits.hpp"

#include "seautils/core/error.hpp"

namespace seautils::entropy {

void BitReader::none_left() { throw DataError("ends within a number"); }

}  // namespace seautils::entropy
