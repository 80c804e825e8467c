#ifndef SEAUTILS_STREAM_NMEA_HPP
#define SEAUTILS_STREAM_NMEA_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace seautils::stream {

/// Most bytes of a sentence, its line end not counted. NMEA 0183 itself allows 80; a flexible data
/// packet of a Micro-Modem takes 4200.
inline constexpr std::size_t longest_sentence = 8192;

enum class Checksum : std::uint8_t {
    absent,  ///< the sentence has none
    good,    ///< it is that of the bytes
    wrong,   ///< it is not: nothing of the sentence can be relied on
};

/// Why a line is no sentence.
enum class SentenceFault : std::uint8_t {
    none,
    no_start,         ///< no `$` or `!` in it, or nothing behind it
    too_long,         ///< more than longest_sentence bytes
    too_many_fields,  ///< more than Sentence::most_fields
    bad_byte,         ///< a byte that is not printable ASCII
    bad_ending,       ///< behind `*` are not just two hexadecimal digits
};

/// `$TTSSS,field,field*HH`, as views into the line that it was read from.
///
///     Sentence s;
///     parse_sentence("$CACYC,0,1,2,0,1,1*58\r\n", s);
///     s.address()  // "CACYC"
///     s[3]         // "2"
///     s[9]         // "": there is none
class Sentence {
public:
    static constexpr std::size_t most_fields = 96;

    /// Talker and type: what stands before the first comma.
    std::string_view address() const { return (*this)[0]; }
    /// The two letters that say who speaks: `CC`, `CA`, `SN`, `GP`; shorter where the address is.
    std::string_view talker() const { return address().substr(0, 2); }
    /// What is said: `CYC`.
    std::string_view type() const { return address().substr(talker().size()); }

    /// Number of fields behind the address.
    std::size_t fields() const { return pieces_ - 1; }
    /// Field k from 1, the address at 0; empty where there is none.
    std::string_view operator[](std::size_t k) const {
        if (k >= pieces_) return {};
        return body_.substr(starts_[k], starts_[k + 1] - starts_[k] - 1);
    }
    /// Field k and all behind it, with their commas: free text.
    std::string_view from(std::size_t k) const {
        return k >= pieces_ ? std::string_view() : body_.substr(starts_[k]);
    }

    char start() const { return start_; }              ///< `$`, or `!` of encapsulated data
    std::string_view body() const { return body_; }    ///< between `$` and `*`
    std::string_view noise() const { return noise_; }  ///< what the line has before `$`
    Checksum checksum() const { return checksum_; }
    std::uint8_t computed() const { return computed_; }  ///< XOR of the bytes of body()
    std::uint8_t stated() const { return stated_; }      ///< 0 where it is absent

private:
    friend SentenceFault parse_sentence(std::string_view line, Sentence& sentence) noexcept;
    SentenceFault split() noexcept;

    std::string_view body_, noise_;
    std::size_t pieces_ = 1;
    std::array<std::uint16_t, most_fields + 2> starts_{0, 1};  ///< of each piece, and past the last
    char start_ = '$';
    Checksum checksum_ = Checksum::absent;
    std::uint8_t computed_ = 0, stated_ = 0;
};

/// Reads one line, which may end in blanks, `\r` and `\n`. The sentence begins at the last `$`, where
/// there is none at the first `!`; what is before it is noise (a line that was cut short when the
/// modem started anew). A wrong checksum is no fault here: see Sentence::checksum().
///
/// @param sentence  views into `line`; unspecified where a fault is returned
SentenceFault parse_sentence(std::string_view line, Sentence& sentence) noexcept;

/// `checksum 5B is not the 4A of its bytes`, `bytes that are not printable`: why a line cannot be
/// used, for messages. Empty where there is no fault, and the checksum is not wrong.
std::string sentence_fault(SentenceFault fault, const Sentence& sentence);

/// XOR of the bytes: the checksum of what stands between `$` and `*`.
std::uint8_t nmea_checksum(std::string_view body) noexcept;

/// Appends `$body*HH\r\n`, HH in upper case.
///
/// @param body  address and fields with their commas: `CCCYC,0,1,2,0,1,1`
/// @throws DataError  empty; a byte that is not printable ASCII, or is `$`, `!` or `*`; longer than
///                    longest_sentence allows
void append_sentence(std::string& out, std::string_view body);

/// The same as a text of its own.
std::string sentence(std::string_view body);

}  // namespace seautils::stream

#endif  // SEAUTILS_STREAM_NMEA_HPP
