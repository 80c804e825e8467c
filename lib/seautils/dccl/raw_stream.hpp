#ifndef SEAUTILS_DCCL_RAW_STREAM_HPP
#define SEAUTILS_DCCL_RAW_STREAM_HPP

#include "seautils/dccl/type_set.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace seautils::dccl {

/// Messages back to back with nothing between them, as a modem or a file of it gives them: one
/// begins where the one before it ends.
///
/// Where a byte is wrong or lost, that place is lost too. The stream then looks for the next one at
/// which a message decodes and encodes to the same bytes again, what noise seldom does. (Adaptive
/// arithmetic models cannot follow a lost message.)
class RawStream {
public:
    /// Decodes the message that the bytes begin with, passes it on, and returns how many it took.
    using Decode = std::function<std::size_t(std::string_view bytes)>;
    /// Is told what is wrong at a byte of the stream. It ends the reading by throwing.
    using Refuse = std::function<void(std::uint64_t offset, const std::string& what)>;

    /// @param types  must outlive it
    RawStream(TypeSet& types, Decode decode, Refuse refuse);

    /// Takes what messages it can.
    /// @param bytes   all that was not taken yet
    /// @param offset  of their first in the stream
    /// @param ended   no more will come: a message that is cut short is refused
    /// @return        how many bytes were taken
    std::size_t take(std::string_view bytes, std::uint64_t offset, bool ended);

private:
    std::size_t find(std::string_view bytes, bool ended);
    void lose(std::uint64_t offset, const std::string& what);
    void skipped(std::uint64_t end);

    TypeSet& types_;
    Decode decode_;
    Refuse refuse_;
    bool lost_ = false;
    std::uint64_t lost_at_ = 0;
    schema::Values values_;
    std::string again_;
};

/// Decodes each message of a record that may hold several back to back. Zeros behind the last one
/// are no matter where they are padding (TypeSet::is_padding).
/// @param lenient     other bytes that are left over are no matter either
/// @throws DataError  no message begins there, or bytes are left over behind those that were decoded
void decode_record(const TypeSet& types, std::string_view record, const RawStream::Decode& decode,
                   bool lenient);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_RAW_STREAM_HPP
