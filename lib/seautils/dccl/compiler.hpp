#ifndef SEAUTILS_DCCL_COMPILER_HPP
#define SEAUTILS_DCCL_COMPILER_HPP

#include "seautils/dccl/program.hpp"

#include <string>
#include <vector>

namespace seautils::dccl {

/// Families of codecs that a schema can name.
enum class Family : std::uint8_t {
    standard,
    time,
    fixed_value,
    presence,
    var_bytes,
    hash,
    native,
    arithmetic,
    ccl,
    custom,  ///< of ProgramOptions
};

/// A codec by its registered name.
struct CodecChoice {
    Family family = Family::standard;
    int version = 0;  ///< the digit of its name; 0 where it has none
    CclCodec ccl = CclCodec::latloncompressed;
    std::string name;  ///< "dccl.default4"
};

/// The codec that `name` means in a message of codec version `version`: a name that ends in no
/// digit is tried with the version first. Nothing where there is none.
std::optional<CodecChoice> find_codec(const std::string& name, int version);

/// Whether the codec exists for the field's type.
bool fits(const CodecChoice& codec, const schema::Field& field);

/// Turns a message type into a Program: used once, then thrown away.
class Compiler {
public:
    Compiler(const schema::Layout& layout, const ProgramOptions& options);
    std::shared_ptr<const Program> run();

private:
    enum class Part : std::uint8_t { undetermined, head, body };
    /// Where in the tree, and in which pass, a message is compiled.
    struct Place {
        Part pass = Part::head;
        Part part = Part::undetermined;  ///< settled by an enclosing in_head, or not
        bool both_passes = true;         ///< the message is entered in either pass
        int message_version = 4;
        std::string path;  ///< "" or "leg."
        int depth = 0;
    };
    struct Bits {
        std::uint64_t min = 0, max = 0;
    };

    void identifier();
    Bits message(const schema::Layout& layout, std::vector<Op>& ops, const Place& place);
    Bits selectors(const schema::Layout& layout, std::vector<Op>& ops);
    void field(const schema::Layout& layout, std::uint32_t index, std::vector<Op>& ops,
               const Place& place, Bits& sum, std::vector<std::uint64_t>& largest_member);
    void add_lost(const schema::Field& field, std::uint32_t index, std::vector<Op>& ops,
                  const Place& place);
    void add(const schema::Field& field, std::uint32_t index, const FieldOptions& options,
             std::vector<Op>& ops, const Place& place, const Place& inside);
    Bits sub_message(Op& op, const CodecChoice& codec, std::vector<Op>& ops, const Place& inside,
                     const std::string& path);
    static FieldReport report(const Op& op, const FieldOptions& options);
    CodecChoice choose(const schema::Field& field, const FieldOptions& options,
                       const std::string& path) const;
    bool is_required(const schema::Field& field) const;
    void repeat(Op& op, const FieldOptions& options, Bits element, const std::string& path);
    void conditions(Op& op, const FieldOptions& options, const std::string& path);

    // compile_field.cpp: the bits of one element, by kind of codec.
    Bits element(Op& op, const FieldOptions& options, const CodecChoice& codec,
                 const std::string& path);
    Bits number(Op& op, const FieldOptions& options, const std::string& path);
    Bits enumeration(Op& op, const FieldOptions& options, int version, const std::string& path);
    Bits text(Op& op, const FieldOptions& options, const CodecChoice& codec,
              const std::string& path);
    Bits time(Op& op, const FieldOptions& options, const std::string& path);
    Bits fixed_value(Op& op, const FieldOptions& options, const std::string& path);
    Bits hash(Op& op, const FieldOptions& options, const std::string& path);
    Bits native(Op& op, const std::string& path);
    Bits arithmetic(Op& op, const FieldOptions& options, const std::string& path);
    Bits ccl(Op& op, const FieldOptions& options, const CodecChoice& codec,
             const std::string& path);
    Bits custom(Op& op, const FieldOptions& options, const CodecChoice& codec,
                const std::string& path);
    Bits with_presence(Op& op, Bits bits) const;
    double step(const Op& op, const FieldOptions& options, double min, double max,
                const std::string& path) const;

    std::vector<Pruning> pruning(const schema::Layout& layout, int depth);
    std::uint64_t count_slots(const schema::Layout& layout, int depth);

    [[noreturn]] void refuse(const std::string& path, const std::string& what) const;

    const schema::Layout& layout_;
    const ProgramOptions& options_;
    MessageOptions root_;
    std::shared_ptr<Program> program_;
    std::vector<const schema::Layout*> open_;  ///< the messages that enclose the current one
    std::size_t steps_ = 0;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_COMPILER_HPP
