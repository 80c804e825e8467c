#ifndef SEAUTILS_SCHEMA_FIELD_PATH_HPP
#define SEAUTILS_SCHEMA_FIELD_PATH_HPP

#include "seautils/schema/values.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::schema {

/// A field of a message, or of a message in it, by its path: `dest`, `header.dest`.
class FieldPath {
public:
    /// @throws ConfigError  there is no such field (proposes the nearest name); it is repeated, or a
    ///                      message
    FieldPath(const Layout& layout, std::string_view path);

    const Field& field() const { return *field_; }

    /// Its slot, or nullptr where it, or a message that it lies in, is not set.
    const Slot* find(const Values& values) const;

private:
    std::vector<std::uint32_t> steps_;
    const Field* field_ = nullptr;
};

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_FIELD_PATH_HPP
