#ifndef SEAUTILS_DCCL_PROGRAM_HPP
#define SEAUTILS_DCCL_PROGRAM_HPP

#include "seautils/dccl/ccl.hpp"
#include "seautils/dccl/field_codec.hpp"
#include "seautils/dccl/number.hpp"
#include "seautils/dccl/options.hpp"
#include "seautils/dccl/report.hpp"
#include "seautils/entropy/arithmetic.hpp"
#include "seautils/schema/values.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace seautils::dccl {

/// How a string or bytes field is laid out.
enum class TextForm : std::uint8_t { counted, fixed };

/// One step of a program: a field of a message, or what stands for it. The steps of a sub-message
/// follow its own step, up to `end`.
struct Op {
    OpKind kind = OpKind::integer;
    bool presence_bit = false;  ///< a bit says whether anything follows
    bool repeated = false;
    bool empty_is_unset = false;  ///< text: length 0 decodes as unset (versions 2 and 3)
    bool plain = false;           ///< no repeat, oneof, condition or kind that has ways of its own
    bool in_oneof = false;        ///< takes no bits unless it is the selected member
    bool required = false;        ///< R of the specification: no null code, no presence bit
    bool drop_empty = false;      ///< version 2 message: nothing set inside means absent
    bool in_head = false;         ///< lost: its own in_head says that it is a header field
    TextForm text_form = TextForm::counted;
    CclCodec ccl = CclCodec::latloncompressed;
    std::uint8_t count_width = 0;   ///< repeated: bits of the count
    std::uint8_t length_width = 0;  ///< text: bits of the length
    std::uint32_t slot = 0;         ///< the field's index in its message
    std::uint32_t end = 0;          ///< message: one past its last step
    std::uint32_t min_repeat = 0, max_repeat = 1;
    bool counted = true;           ///< repeated: a count is written (version 3 and later)
    std::uint32_t max_length = 0;  ///< text: bytes; ccl: bits
    std::uint32_t extra = 0;       ///< index into the side table of its kind
    std::int32_t condition = -1;   ///< index of its conditions, or -1
    NumberCode number;
    const schema::Field* field = nullptr;  ///< null for selectors

    /// Bits of the whole field, repeats and presence included.
    std::uint64_t min_bits = 0, max_bits = 0;
    /// Bits of one element without presence bit or count: what stands for a missing one.
    std::uint64_t element_min_bits = 0;
};

/// Side tables, by Op::extra.
struct EnumCode {
    bool packed = true;
    bool hashed = true;  ///< its text counts in the definition's hash: not with the presence codec
    /// Packed: number of each position; and (number, position) sorted by number.
    std::vector<std::int32_t> numbers;
    std::vector<std::pair<std::int32_t, std::uint32_t>> positions;
};
struct TimeCode {
    double conversion = 1;          ///< field's unit per second: 1 (double), 1e6 (integers)
    std::int64_t period_s = 86400;  ///< the value comes round after so long
    double rounding = 1;            ///< decoded value: step in the field's unit
    double fine_rounding = 1;       ///< the same at the resolution that is on the wire
};
struct FixedValue {
    schema::Slot value;
    std::string text;
};
struct HashCode {
    std::uint64_t value = 0;  ///< as put on the wire
    std::uint8_t width = 0;
};
struct SelectorCode {
    struct Oneof {
        std::uint8_t width;
        std::vector<std::uint32_t> slots;
    };
    std::vector<Oneof> oneofs;
};
struct ConditionCode {
    Conditions scripts;
    bool asks_omit = false, asks_required = false, asks_bounds = false;
};
/// What a version 2 message looks like when nothing came in: a tree of the messages to look at.
struct Pruning {
    std::uint32_t slot = 0;
    bool repeated = false;
    bool drop_empty = false;
    const schema::Layout* layout = nullptr;
    std::vector<Pruning> below;
};

enum class IdCodec : std::uint8_t { standard, ccl };

/// What a message type is compiled with.
struct ProgramOptions {
    IdCodec id_codec = IdCodec::standard;
    /// Stands in for the schema's own id, or for one it lacks.
    std::optional<std::int32_t> user_id;
    /// Models of the arithmetic codec, by name.
    std::map<std::string, entropy::Model> models;
    /// Codecs that schemas may name beside ours, whose names stay ours.
    FieldCodecs field_codecs;
};

/// A message type compiled for the wire: immutable, shared by any number of codecs.
///
/// Source of all rules: DCCL codec versions 2, 3 and 4. Limits, beyond those of the format: nesting
/// 32; 20,000 steps; 2^18 values in one message; 65,536 repeats of one field; 1 MiB encoded.
class Program {
public:
    /// @param layout  of a protobuf type (its `descriptor` is set); must outlive the program
    /// @throws ConfigError  whatever the codec refuses at load: names the field by its path
    static std::shared_ptr<const Program> compile(const schema::Layout& layout,
                                                  const ProgramOptions& options = {});

    const schema::Layout& layout() const { return *layout_; }
    const std::string& name() const { return layout_->full_name; }
    int codec_version() const { return version_; }
    std::int32_t id() const { return id_; }
    bool has_id() const { return id_bits_ > 0; }
    std::uint32_t max_bytes() const { return max_bytes_; }  ///< the schema's limit

    /// Identifier bits as they go on the wire, and their number (0 with omit_id).
    std::uint32_t id_code() const { return id_code_; }
    unsigned id_bits() const { return id_bits_; }

    std::uint64_t head_min_bits() const { return head_min_; }  ///< without the identifier
    std::uint64_t head_max_bits() const { return head_max_; }
    std::uint64_t body_min_bits() const { return body_min_; }
    std::uint64_t body_max_bits() const { return body_max_; }

    /// Largest and smallest encoded size in bytes, with the identifier's real length.
    std::uint64_t largest_bytes() const;
    std::uint64_t smallest_bytes() const;
    /// The sizes as the reference's API reports them: the largest counts two bytes of identifier
    /// (three for CCL), the smallest one.
    std::uint64_t reported_max_size() const;
    std::uint64_t reported_min_size() const;

    /// 64-bit hash of the definition, as the hash codec truncates it.
    std::uint64_t definition_hash() const;

    /// Fields in the order of the wire: header, then body, then what is never sent.
    std::vector<FieldReport> report() const;

    /// Steps of the header and of the body.
    const std::vector<Op>& head() const { return head_; }
    const std::vector<Op>& body() const { return body_; }
    const EnumCode& enum_code(const Op& op) const { return enums_[op.extra]; }
    const TimeCode& time_code(const Op& op) const { return times_[op.extra]; }
    const FixedValue& fixed_value(const Op& op) const { return fixed_[op.extra]; }
    const HashCode& hash_code(const Op& op) const { return hashes_[op.extra]; }
    const SelectorCode& selectors(const Op& op) const { return selectors_[op.extra]; }
    const entropy::Model& model(const Op& op) const { return *models_[op.extra]; }
    const entropy::Model& model_at(std::size_t k) const { return *models_[k]; }
    FieldCodec& field_codec(const Op& op) const { return *field_codecs_[op.extra]; }
    std::size_t model_count() const { return models_.size(); }
    /// Only for a step whose `condition` is not negative.
    const ConditionCode& conditions(const Op& op) const {
        return conditions_[static_cast<std::size_t>(op.condition)];
    }
    bool has_conditions() const { return !conditions_.empty(); }
    const std::vector<Pruning>& pruning() const { return pruning_; }
    IdCodec id_codec() const { return id_codec_; }

private:
    friend class Compiler;
    Program() = default;

    const schema::Layout* layout_ = nullptr;
    IdCodec id_codec_ = IdCodec::standard;
    int version_ = 0;
    std::int32_t id_ = 0;
    bool omit_id_ = false;
    std::uint32_t max_bytes_ = 0;
    std::uint32_t id_code_ = 0;
    unsigned id_bits_ = 0;
    std::uint64_t head_min_ = 0, head_max_ = 0, body_min_ = 0, body_max_ = 0;
    std::vector<Op> head_, body_;
    std::vector<EnumCode> enums_;
    std::vector<TimeCode> times_;
    std::vector<FixedValue> fixed_;
    std::vector<HashCode> hashes_;
    std::vector<SelectorCode> selectors_;
    std::vector<std::shared_ptr<const entropy::Model>> models_;
    std::vector<std::shared_ptr<FieldCodec>> field_codecs_;
    std::vector<ConditionCode> conditions_;
    std::vector<Pruning> pruning_;
    std::vector<FieldReport> report_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_PROGRAM_HPP
