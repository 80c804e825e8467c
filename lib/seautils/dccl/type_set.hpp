#ifndef SEAUTILS_DCCL_TYPE_SET_HPP
#define SEAUTILS_DCCL_TYPE_SET_HPP

#include "seautils/dccl/codec.hpp"
#include "seautils/dccl/legacy_schema.hpp"
#include "seautils/schema/pool.hpp"

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace seautils::dccl {

/// A message type that can be put on the wire: of a .proto file, or of the XML of DCCL 1.
struct Type {
    std::string name;
    const schema::Layout* layout = nullptr;
    std::shared_ptr<const Program> program;  ///< null for a legacy type
    const LegacyMessage* legacy = nullptr;   ///< null for a protobuf type
};

/// The largest number of elements of each repeated field of a type, by its path ("sample"): what
/// schema::CsvWriter makes its columns of.
std::map<std::string, std::uint32_t> repeats(const Type& type);

/// What to do when two types have one identifier, which a receiver cannot tell apart.
enum class Collisions : std::uint8_t { refuse, keep };

/// The types that a tool was given on its command line, with the codec that they share.
class TypeSet {
public:
    /// @param schemas   .proto files, folders of them, or .xml files of DCCL 1; not both kinds
    /// @param messages  names to choose; empty: all types that carry dccl options
    /// @param collisions  keep: only for looking at the types; frames are of the first with their id
    /// @throws ConfigError  nothing to code; a chosen type does not compile; two types share an id
    /// @throws Error        no_input: a file cannot be opened
    TypeSet(const std::vector<std::string>& schemas, const std::vector<std::string>& messages,
            const ProgramOptions& program_options, CodecOptions codec_options,
            Collisions collisions = Collisions::refuse);
    ~TypeSet();
    TypeSet(TypeSet&&) noexcept;
    TypeSet& operator=(TypeSet&&) noexcept;

    const std::vector<Type>& types() const;
    /// Types that were not chosen by name and do not compile: name and reason.
    const std::vector<std::pair<std::string, std::string>>& left_out() const;
    /// XML tags without a meaning here, each once.
    const std::vector<std::string>& ignored_tags() const;

    /// The type that records are of when they do not say: the first chosen, or the only one there
    /// is; else nullptr.
    const Type* usual() const;
    /// Whether there is but one type, so that a record need not name it.
    bool single() const { return types().size() == 1; }
    /// The type of that full name, or of that last part if it is unique.
    /// @throws DataError  names the nearest, or why it was left out
    const Type& type(std::string_view name) const;

    schema::Pool& pool();
    void set_now(std::int64_t now_s);

    /// As Codec::encode.
    void encode(const Type& type, const schema::Values& values, std::string& out);

    struct Decoded {
        const Type* type;
        std::size_t bytes;
    };
    /// As Codec::decode, by the identifier; a single type with omit_id is taken for granted. A
    /// legacy frame takes all the bytes.
    Decoded decode(std::string_view bytes, schema::Values& values);

    /// Whether some type's frames begin with this byte: a quick no for noise.
    bool may_begin(char byte) const;

    /// Whether the bytes behind a message are zeros that fill up a modem's frame, and not messages
    /// of the identifier 0.
    bool is_padding(std::string_view rest) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_TYPE_SET_HPP
