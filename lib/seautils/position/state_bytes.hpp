#ifndef SEAUTILS_POSITION_STATE_BYTES_HPP
#define SEAUTILS_POSITION_STATE_BYTES_HPP

#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::position {

/// The bytes of Codec::save(): a version, whole numbers in as many bytes as they need, and a check
/// sum of all.
class StateWriter {
public:
    explicit StateWriter(std::uint8_t version) : bytes_(1, static_cast<char>(version)) {}
    void number(std::int64_t value);
    void text(std::string_view bytes);  ///< with its length
    /// All of it, with the check sum.
    std::string finish() const;

private:
    std::string bytes_;
};

/// The inverse. Reads no further than the bytes go, whatever they are.
class StateReader {
public:
    /// @param bytes  must outlive the reader
    /// @throws DataError  of another version, which is named; cut; the check sum is wrong
    StateReader(std::string_view bytes, std::uint8_t version);

    /// @throws DataError  outside of the range, or the bytes end
    std::int64_t number(std::int64_t least, std::int64_t most);
    /// @throws DataError  unless the number is this one: the state is of other options
    void same(std::int64_t value);
    /// @throws DataError  the bytes end
    std::string_view text();
    /// @throws DataError  bytes are left
    void finish() const;

private:
    std::int64_t any();

    std::string_view rest_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_STATE_BYTES_HPP
