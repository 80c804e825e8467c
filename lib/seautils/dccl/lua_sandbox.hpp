#ifndef SEAUTILS_DCCL_LUA_SANDBOX_HPP
#define SEAUTILS_DCCL_LUA_SANDBOX_HPP

#include "seautils/schema/values.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

struct lua_State;

namespace seautils::dccl {

/// What the functions that Lua calls know; each Lua state points to its own (lua_context).
struct LuaContext {
    std::size_t used_bytes = 0;
    unsigned instructions = 0;  ///< of this run, in steps of the hook
    std::uint64_t message_instructions = 0;
    bool counts_messages = false;
    const schema::Values* values = nullptr;  ///< of this run
    std::uint64_t run = 0;                   ///< number of this run
};
LuaContext& lua_context(lua_State* lua);

/// Why Lua gave up: one line, without a place.
struct LuaFailure {
    std::string reason;
    bool out_of_memory = false;
};

/// A Lua state with nothing in it that a hostile script could use.
///
/// Lua reports errors by longjmp: what runs inside of protect() must have no variable with a
/// destructor alive at a call of Lua, and must throw nothing.
class LuaSandbox {
public:
    /// @throws std::bad_alloc
    LuaSandbox();
    ~LuaSandbox();
    LuaSandbox(const LuaSandbox&) = delete;
    LuaSandbox& operator=(const LuaSandbox&) = delete;

    LuaContext& context() { return context_; }

    /// Calls body(lua, argument) in protected mode.
    /// @throws LuaFailure
    void protect(void (*body)(lua_State*, void*), void* argument);

    /// Compiles a text (no byte code) whose globals are those of the sandbox.
    /// @return  its place in Lua's registry
    /// @throws LuaFailure
    int compile(std::string_view text);
    /// Lets go of what compile() returned. @throws LuaFailure
    void forget(int reference);
    void collect_garbage();

    /// Begins a run: its limits hold from here on. @throws LuaFailure  the message's are used up
    void start_run(const schema::Values& values);

private:
    LuaContext context_;
    lua_State* lua_ = nullptr;
};

/// Pushes the table behind the globals of all scripts. Inside of protect().
void push_globals(lua_State* lua);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LUA_SANDBOX_HPP
