#ifndef SEAUTILS_MODEM_FIELDS_HPP
#define SEAUTILS_MODEM_FIELDS_HPP

#include "seautils/record/record.hpp"
#include "seautils/stream/nmea.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seautils::modem {

/// The fields of a Micro-Modem's sentence as numbers. An empty field, and one that the sentence does
/// not reach, is absent; anything else that is no number of its range is refused, by name.
class Fields {
public:
    explicit Fields(const stream::Sentence& sentence) : sentence_(&sentence) {}

    /// @throws DataError  `CACYC field 2 'x' is not a whole number 0 to 127`
    std::optional<std::int64_t> maybe_whole(std::size_t k, std::int64_t least,
                                            std::int64_t most) const;
    std::optional<double> maybe_real(std::size_t k) const;

    /// The same of a field that must be there. @throws DataError
    std::uint32_t whole(std::size_t k, std::uint32_t most) const;
    /// A modem's address, 0 to 127.
    std::uint32_t address(std::size_t k) const { return whole(k, 127); }

    /// Bytes of hexadecimal digits, in either case. @throws DataError
    std::string bytes(std::size_t k) const;

    std::string_view text(std::size_t k) const { return (*sentence_)[k]; }
    std::size_t count() const { return sentence_->fields(); }

    /// @throws DataError  fewer fields than `least`
    void need(std::size_t least) const;
    /// @throws DataError  names the sentence, the field and its text
    [[noreturn]] void refuse(std::size_t k, std::string_view wanted) const;

private:
    /// The sentence's address, cut and quoted where it is too long to be one.
    std::string name() const;

    const stream::Sentence* sentence_;
};

/// `hhmmss` or `hhmmss.ffff` as nanoseconds since midnight; absent where it is no such time.
std::optional<std::int64_t> time_of_day_ns(std::string_view text);

/// `yyyymmdd` as nanoseconds since 1970; absent where it is no such date.
std::optional<std::int64_t> date_ns(std::string_view text);

/// The instant with this time of day that is nearest to `near`.
record::UtcTime nearest_day(std::int64_t time_of_day_ns, record::UtcTime near);

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_FIELDS_HPP
