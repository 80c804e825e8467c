#ifndef SEAUTILS_DCCL_CODEC_IMPL_HPP
#define SEAUTILS_DCCL_CODEC_IMPL_HPP

#include "seautils/dccl/bits.hpp"
#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/conditions.hpp"
#include "seautils/dccl/crypto.hpp"
#include "seautils/dccl/dynamic.hpp"
#include "seautils/dccl/field_error.hpp"
#include "seautils/schema/message.hpp"

#include <map>
#include <unordered_map>

namespace seautils::dccl {

/// What a codec keeps from message to message.
struct Codec::Impl {
    CodecOptions options;
    std::optional<Cipher> cipher;
    std::optional<ConditionEngine> engine;  ///< made when the first type with conditions is loaded
    std::vector<std::shared_ptr<const Program>> programs;
    std::unordered_map<std::uint32_t, const Program*> by_id_code;
    std::map<std::string, entropy::Counts> encoder_counts, decoder_counts;  ///< by model name
    BitWriter writer;
    schema::Values scratch;
    schema::MessageBridge bridge;
    std::string body;
    std::vector<double> run;  ///< values of an arithmetic run

    const Cipher* cipher_for(const Program& program) const {
        if (!cipher || options.skip_crypto_ids.contains(program.id())) return nullptr;
        return &*cipher;
    }
};

/// The unit that the schema states, with a blank in front, or nothing.
std::string with_unit(const Op& op);
/// A value as a person wrote it.
std::string shown(const Op& op, const schema::Slot& slot, const schema::Values& values);
double as_double(const Op& op, const schema::Slot& slot);
/// Puts a number into a slot as its kind wants it; saturates what the kind cannot hold.
void set_number(schema::Kind kind, double x, schema::Slot& slot);
/// Position of an enumerator's number in its declaration (the first name's, for aliases).
std::optional<std::int64_t> position_of(const EnumCode& code, std::int64_t number);

/// Puts one message's values into bits. One object a message.
class Encoder {
public:
    Encoder(Codec::Impl& codec, const Program& program, const schema::Values& values)
        : codec_(codec), program_(program), values_(values), writer_(codec.writer) {}

    /// Writes the steps of one part. @throws FieldError
    void part(const std::vector<Op>& ops);

private:
    void range(std::size_t first, std::size_t last, const Frame& frame);
    void step(const Op& op, std::size_t at, const Frame& frame);
    void conditional(const Op& op, std::size_t at, const Frame& frame);
    void single(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame);
    void repeated(const Op& op, std::size_t at, const Frame& frame);
    bool omitted_element(const Op& op, std::uint32_t slot, bool present, const Frame& frame);
    void unset(const Op& op);
    void value(const Op& op, std::size_t at, const schema::Slot& slot, const Frame& frame);
    void selectors(const Op& op, const Frame& frame);
    void number(const Op& op, std::optional<std::uint64_t> code, const schema::Slot& slot);
    void boolean(const Op& op, bool on);
    void enumeration(const Op& op, const schema::Slot& slot);
    void text(const Op& op, const schema::Slot& slot);
    void time(const Op& op, const schema::Slot& slot);
    void fixed_value(const Op& op, const schema::Slot& slot);
    void native(const Op& op, const schema::Slot& slot);
    void arithmetic(const Op& op, const Frame& frame);
    void ccl(const Op& op, const schema::Slot& slot);
    void out_of_range(const Op& op, const schema::Slot& slot);
    Dynamic dynamic() { return Dynamic(*codec_.engine, program_, values_); }

    Codec::Impl& codec_;
    const Program& program_;
    const schema::Values& values_;
    BitWriter& writer_;
    const Op* ops_ = nullptr;
};

/// Takes one message's values out of bits. One object a message.
class Decoder {
public:
    Decoder(Codec::Impl& codec, const Program& program, schema::Values& values)
        : codec_(codec), program_(program), values_(values) {}

    /// Reads the steps of one part. @throws FieldError
    void part(const std::vector<Op>& ops, BitReader& reader);
    /// Last: takes out what a version 2 message cannot tell from absent.
    void prune();

private:
    void range(std::size_t first, std::size_t last, const Frame& frame);
    void step(const Op& op, std::size_t at, const Frame& frame);
    void conditional(const Op& op, std::size_t at, const Frame& frame);
    void single(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame);
    void settle(const Op& op, std::uint32_t slot);
    void repeated(const Op& op, std::size_t at, const Frame& frame);
    void selectors(const Op& op, const Frame& frame);
    void value(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame);
    void message(const Op& op, std::size_t at, std::uint32_t slot, const Frame& frame);
    std::uint32_t block_of(const Op& op, std::uint32_t slot);
    bool take_null(const Op& op, std::uint64_t& code);
    void number(const Op& op, schema::Slot& slot);
    void enumeration(const Op& op, schema::Slot& slot);
    void text(const Op& op, std::uint32_t slot);
    void time(const Op& op, schema::Slot& slot);
    void fixed_value(const Op& op, std::uint32_t slot);
    void hash(const Op& op, schema::Slot& slot);
    void native(const Op& op, schema::Slot& slot);
    void arithmetic(const Op& op, const Frame& frame);
    void ccl(const Op& op, std::uint32_t slot);
    void prune(const std::vector<Pruning>& below, std::uint32_t block);
    Dynamic dynamic() { return Dynamic(*codec_.engine, program_, values_); }

    Codec::Impl& codec_;
    const Program& program_;
    schema::Values& values_;
    BitReader* reader_ = nullptr;
    const Op* ops_ = nullptr;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_CODEC_IMPL_HPP
