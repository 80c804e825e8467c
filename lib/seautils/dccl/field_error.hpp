#ifndef SEAUTILS_DCCL_FIELD_ERROR_HPP
#define SEAUTILS_DCCL_FIELD_ERROR_HPP

#include "seautils/core/error.hpp"
#include "seautils/schema/layout.hpp"

#include <string>
#include <string_view>

namespace seautils::dccl {

/// The frame ends before the message does: more bytes may help.
class Truncated : public DataError {
public:
    using DataError::DataError;
};

/// What is wrong with a field, on its way up through the messages that enclose it.
struct FieldError {
    std::string path;
    std::string what;  ///< "99999 is outside 0 to 6000 m"
    bool truncated = false;

    void enter(std::string_view enclosing) {
        path.insert(0, path.empty() || path.front() == '[' ? "" : ".");
        path.insert(0, enclosing);
    }
    /// @throws Truncated or DataError
    [[noreturn]] void raise(const schema::Layout& layout) const {
        const std::string text = path + " " + what + " (message " + layout.full_name + ")";
        if (truncated) throw Truncated(text);
        throw DataError(text);
    }
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_FIELD_ERROR_HPP
