#ifndef SEAUTILS_DCCL_CONDITIONS_HPP
#define SEAUTILS_DCCL_CONDITIONS_HPP

#include "seautils/schema/values.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace seautils::dccl {

/// A message inside a Values.
struct BlockRef {
    const schema::Layout* layout;
    std::uint32_t block;
};

/// Runs the dynamic conditions of a schema: Lua 5.3 expressions over the values known so far.
///
/// A script without the text "return" gets "return " in front. It sees
/// - `this` and `root`: messages, read only. A field is a boolean, number or string (bytes too), an
///   enumerator its name, a 64-bit integer a Lua integer (above 2^63 - 1 a float), a sub-message
///   the same again; a repeated field takes `#x`, `x[i]` from 1, ipairs and pairs. An unset field
///   is its explicit default or nil; in proto3 the type's default and, if repeated, empty, but nil
///   where presence is kept. The name of a oneof gives that of the member that is set. Any other
///   name is nil.
/// - `this_index`: the number given.
/// - type, tostring, tonumber, select, ipairs, pairs (repeated fields only); of string: byte, char,
///   format, len, lower, reverse, sub, upper; of math all but random and randomseed.
///
/// It need not be trusted. It cannot change anything that another run sees; has no input, output,
/// clock, chance or addresses, no way to load code or to catch an error; and is stopped at
/// max_instructions, when Lua holds max_memory_bytes, or at a string above max_string_bytes (a
/// field's too). Whether it is stopped does not depend on what ran before.
///
/// One Lua state. Not thread-safe; movable.
class ConditionEngine {
public:
    static constexpr std::size_t max_script_bytes = 4096;
    static constexpr unsigned max_instructions = 100'000;
    static constexpr std::size_t max_memory_bytes = std::size_t{1} << 18;
    static constexpr std::size_t max_string_bytes = 4096;
    /// What the scripts of one message may take together; each run counts as 200 at least.
    static constexpr unsigned max_message_instructions = 5'000'000;

    ConditionEngine();
    ~ConditionEngine();
    ConditionEngine(ConditionEngine&&) noexcept;
    ConditionEngine& operator=(ConditionEngine&&) noexcept;

    /// Looks at the syntax only.
    /// @throws ConfigError  `condition 'SCRIPT': reason`
    void check(const std::string& script);

    /// A new message begins: from the first call on, max_message_instructions is enforced.
    void start_message();

    /// Whether the script's value is neither nil nor false. Compiled scripts are kept.
    /// @param root, self  the messages that `root` and `this` stand for, in `values`
    /// @param index       `this_index`
    /// @throws DataError  `condition 'SCRIPT': reason`
    bool test(const std::string& script, const schema::Values& values, BlockRef root, BlockRef self,
              std::uint32_t index);

    /// The script's value; nothing if it is nil.
    /// @throws DataError  as test, or it is something else, or NaN
    std::optional<double> number(const std::string& script, const schema::Values& values,
                                 BlockRef root, BlockRef self, std::uint32_t index);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_CONDITIONS_HPP
