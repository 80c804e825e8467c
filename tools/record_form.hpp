#ifndef SEAUTILS_TOOLS_RECORD_FORM_HPP
#define SEAUTILS_TOOLS_RECORD_FORM_HPP

#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/stream/hex.hpp"

#include <string>
#include <string_view>

namespace seautils::tools {

/// Appends a record: where `format` is "delimited", its binary form behind its length; else a line
/// of JSON.
inline void append_record(const schema::Values& values, std::string_view format, std::string& out) {
    if (format == "delimited") {
        std::string bytes;
        schema::write_binary(values, bytes);
        return stream::append_delimited(out, bytes);
    }
    schema::write_json(values, out);
    out += '\n';
}

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_RECORD_FORM_HPP
