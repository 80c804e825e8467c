#ifndef SEAUTILS_DCCL_CODEC_HPP
#define SEAUTILS_DCCL_CODEC_HPP

#include "seautils/dccl/program.hpp"
#include "seautils/schema/values.hpp"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>

namespace google::protobuf {
class Message;
}

namespace seautils::dccl {

/// How a codec works; the same for all its types.
struct CodecOptions {
    /// What loses data is done silently, as the reference library does unless it is told to be
    /// strict: a number out of range becomes unset (or the minimum where there is no "unset"),
    /// over-long texts and surplus elements are cut, missing elements are padded, values of static
    /// fields and of header fields that never travel are dropped. Else each of these is refused.
    bool lenient = false;
    /// Code the header alone.
    bool header_only = false;
    /// Decode times to the resolution that is on the wire, where the reference drops digits that
    /// `resolution` (and not `precision`) stated.
    bool full_time_resolution = false;
    /// Bodies are encrypted where this is set (AES-256, key SHA-256 of it).
    std::optional<std::string> passphrase;
    /// Ids of messages that are not encrypted all the same.
    std::set<std::int32_t> skip_crypto_ids;
    /// The receiver's clock, seconds since 1970, UTC: gives a time its day, a CCL date its year.
    std::int64_t now_s = 0;
};

/// Encodes and decodes messages of any number of types.
///
/// A value: make as many as you like. Each is usable from one thread at a time; the Programs are
/// shared. Adaptive arithmetic models learn from what passes through, separately for each
/// direction.
class Codec {
public:
    explicit Codec(CodecOptions options = {});
    ~Codec();
    Codec(Codec&&) noexcept;
    Codec& operator=(Codec&&) noexcept;

    /// Adds a type. @throws ConfigError  its id is another type's already
    void load(std::shared_ptr<const Program> program);

    /// The loaded type of that name, or nullptr.
    const Program* find(std::string_view name) const;

    /// For the time that passes between records.
    void set_now(std::int64_t now_s);

    /// Appends the encoded message to `out`, which is unchanged when an exception is thrown.
    /// @throws DataError  names the field by its path, quotes the value, states the bound
    void encode(const Program& program, const schema::Values& values, std::string& out);

    /// What a decoded frame was.
    struct Decoded {
        const Program* program;
        std::size_t bytes;  ///< how many of the given bytes it took
    };

    /// Decodes the message that `bytes` begins with; surplus bytes are left alone.
    /// @param expected  the type it must be; nullptr: told by the identifier. A type with omit_id
    ///                  can only be decoded as expected
    /// @throws DataError  too short, an unknown identifier, another type than expected, …
    Decoded decode(std::string_view bytes, schema::Values& values,
                   const Program* expected = nullptr);

    /// The loaded type that the identifier names, and nothing else of the bytes is looked at.
    /// @throws DataError  too short, or unknown
    const Program& identify(std::string_view bytes) const;

    /// Bytes that the message takes, without encoding it for good (adaptive models stay).
    std::size_t size(const Program& program, const schema::Values& values);

    /// The same for protobuf messages, of the very type that the program's layout describes.
    void encode(const Program& program, const google::protobuf::Message& message, std::string& out);
    Decoded decode(std::string_view bytes, google::protobuf::Message& message,
                   const Program& expected);

    struct Impl;  ///< codec_impl.hpp; not for users

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_CODEC_HPP
