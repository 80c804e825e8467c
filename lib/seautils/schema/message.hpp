#ifndef SEAUTILS_SCHEMA_MESSAGE_HPP
#define SEAUTILS_SCHEMA_MESSAGE_HPP

#include "seautils/schema/pool.hpp"
#include "seautils/schema/values.hpp"

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace seautils::schema {

/// Copies a message's fields into `values`. `message` must be of layout.descriptor's type.
/// @throws DataError  more values than Values can hold, or more than 32 levels
void from_message(const google::protobuf::Message& message, const Layout& layout, Values& values);

/// The other way: clears the message first. A legacy null element becomes the type's default.
void to_message(const Values& values, google::protobuf::Message& message);

/// The same two; but messages of compiled classes, which read and write their binary form faster
/// than reflection reaches their fields, go by way of that form.
class MessageBridge {
public:
    void read(const google::protobuf::Message& message, const Layout& layout, Values& values);
    void write(const Values& values, google::protobuf::Message& message);

private:
    std::string wire_;  ///< kept, so that nothing is allocated from message to message
};

/// Reads protobuf's binary form into `values` without a message in between. Unknown fields, and
/// enumerators that a closed enumeration does not declare, are skipped; a sub-message that comes twice is merged, a scalar's last value counts, packed and
/// unpacked are both read.
/// @return whether nothing was skipped
/// @throws DataError  malformed or truncated (names the byte offset), more than 32 levels, invalid
///                    UTF-8 in a string
bool read_binary(std::string_view bytes, const Layout& layout, Values& values);

/// Appends protobuf's binary form, fields in order of number (as protobuf's own serializer does).
void write_binary(const Values& values, std::string& out);

/// Reads protobuf's text format (one message, on one or more lines) by way of a protobuf message.
/// @throws DataError  `line L column C: what` of the first fault (without the line where it is 1)
void read_text(std::string_view text, Pool& pool, const Layout& layout, Values& values);

/// Appends the text format on one line, fields in order of number, no line end.
void write_text(const Values& values, std::string& out);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_MESSAGE_HPP
