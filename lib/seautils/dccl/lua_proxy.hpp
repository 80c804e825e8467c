#ifndef SEAUTILS_DCCL_LUA_PROXY_HPP
#define SEAUTILS_DCCL_LUA_PROXY_HPP

#include "seautils/schema/values.hpp"

#include <cstdint>

struct lua_State;

namespace seautils::dccl {

/// What Lua holds for a message or for a repeated field: where it is. Nothing is copied before a
/// script asks for it. Valid in the run that it was made for (LuaContext::run).
struct LuaProxy {
    const schema::Layout* layout;  ///< the message's, or that of the repeated field
    const schema::Field* field;    ///< the repeated field; nullptr: this is a message
    std::uint32_t at;              ///< first slot
    std::uint32_t count;           ///< elements
    std::uint64_t run;
};

/// Makes the proxies' behaviour known to a Lua state, and the function `pairs`, which takes nothing
/// else. Inside of LuaSandbox::protect().
void open_proxies(lua_State* lua);

/// Pushes a proxy, which is Lua's from then on. Inside of LuaSandbox::protect().
LuaProxy* push_proxy(lua_State* lua, const LuaProxy& proxy);

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_LUA_PROXY_HPP
