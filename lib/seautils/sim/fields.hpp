#ifndef SEAUTILS_SIM_FIELDS_HPP
#define SEAUTILS_SIM_FIELDS_HPP

#include "seautils/stream/nmea.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace seautils::sim {

/// Why a modem does not do what it is told, as it says it in CAERR.
struct Refusal {
    int number = 0;  ///< 1 checksum, 2 not known, 3 a wrong field, 4 busy
    std::string text;
};

/// The fields of a command, from 1.
class Fields {
public:
    explicit Fields(const stream::Sentence& sentence) : sentence_(sentence) {}

    /// Empty where the sentence ends before it.
    std::string_view text(std::size_t k) const { return sentence_[k]; }
    /// All of them, with commas between.
    std::string_view all() const { return sentence_.from(1); }
    /// A whole number from `least` to `most`. @throws Refusal
    unsigned number(std::size_t k, unsigned least, unsigned most) const;
    /// The bytes of hexadecimal digits. @throws Refusal  others, or more than `most` bytes
    std::string bytes(std::size_t k, std::size_t most) const;
    /// @throws Refusal  there are fewer
    void need(std::size_t count) const;

private:
    const stream::Sentence& sentence_;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_FIELDS_HPP
