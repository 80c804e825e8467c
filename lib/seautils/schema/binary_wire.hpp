#ifndef SEAUTILS_SCHEMA_BINARY_WIRE_HPP
#define SEAUTILS_SCHEMA_BINARY_WIRE_HPP

#include "seautils/schema/layout.hpp"

namespace seautils::schema {

/// Wire types of the binary form.
enum WireType : unsigned {
    varint = 0,
    fixed64 = 1,
    length = 2,
    begin_group = 3,
    end_group = 4,
    fixed32 = 5
};

inline unsigned wire_type_of(WireForm form) {
    switch (form) {
        case WireForm::varint:
        case WireForm::zigzag:
            return varint;
        case WireForm::fixed32:
            return fixed32;
        case WireForm::fixed64:
            return fixed64;
        case WireForm::length:
            return length;
        case WireForm::group:
            return begin_group;
    }
    return varint;
}

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_BINARY_WIRE_HPP
