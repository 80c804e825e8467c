#ifndef SEAUTILS_DCCL_SURVEY_HPP
#define SEAUTILS_DCCL_SURVEY_HPP

#include "seautils/dccl/lint.hpp"
#include "seautils/dccl/type_set.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seautils::dccl {

/// A field, as a line of the table that describes a message.
struct FieldSurvey {
    std::string path;   ///< "leg.seq"; elements of a repeated message: "sample[].depth_m"
    std::string type;   ///< as declared: "double", "repeated uint32", "enum State"
    std::string codec;  ///< "dccl.default4"; empty for DCCL 1
    std::string part;   ///< "head", "body", or "none" for what never travels
    std::optional<double> min, max;                ///< of a number, inclusive
    std::optional<double> resolution;              ///< step from one value to the next
    std::string unit;                              ///< as declared, or empty
    std::uint32_t max_length = 0;                  ///< of texts, bytes; 0: not a text
    std::uint32_t values = 0;                      ///< of enumerations: how many; 0: none
    std::uint32_t min_repeat = 0, max_repeat = 0;  ///< both 0: not repeated
    std::uint64_t min_bits = 0, max_bits = 0;      ///< in one message around it
};

/// Bytes of a message with typical values (lint.hpp).
struct TypicalBytes {
    std::uint64_t dccl = 0;
    std::uint64_t protobuf = 0;  ///< in protobuf's binary form
    std::uint64_t plain = 0;     ///< as a struct of 32-bit numbers
};

/// What a message type costs on the link, and what is to be said about it.
struct Survey {
    std::string name;
    std::optional<std::int32_t> id;  ///< none where the schema says omit_id
    int codec_version = 0;           ///< 2 to 4; 1 for the XML
    unsigned id_bits = 0;
    std::uint64_t head_min_bits = 0, head_max_bits = 0;  ///< without the identifier
    std::uint64_t body_min_bits = 0, body_max_bits = 0;
    std::uint64_t min_bytes = 0, max_bytes = 0;  ///< encoded, identifier included
    std::uint64_t limit_bytes = 0;               ///< max_bytes of the schema; `<size>` of the XML
    std::vector<FieldSurvey> fields;             ///< in the order of the wire
    std::optional<TypicalBytes> typical;         ///< none for DCCL 1
    std::vector<Remark> remarks;
};

/// Describes each type; a further remark, `id-collision`, names types with the same identifier.
/// @param now_s  what times hold in the typical message, seconds since 1970
std::vector<Survey> survey(const TypeSet& types, std::int64_t now_s);

/// Appends the survey as one line of JSON, without its end.
void append_json(const Survey& survey, std::string& out);

/// Appends the survey as a table for people, an empty line behind it.
void append_table(const Survey& survey, std::string& out);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_SURVEY_HPP
