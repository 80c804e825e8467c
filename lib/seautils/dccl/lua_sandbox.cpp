#include "seautils/dccl/lua_sandbox.hpp"

#include "seautils/dccl/conditions.hpp"

#include <lua.hpp>

#include <cstdlib>
#include <cstring>
#include <new>

namespace seautils::dccl {

namespace {

constexpr unsigned hook_step = 1000;  // instructions
constexpr unsigned run_cost = 200;    // what a run counts for at least, in instructions
constexpr std::size_t largest_string = ConditionEngine::max_string_bytes + 64;  // with its head
constexpr const char* chunk_name = "=condition";

const char keys[2] = {};  // the addresses are keys of Lua's registry
const char* const globals_key = &keys[0];
const char* const environment_key = &keys[1];

/// Lua's allocator. What Lua does with a string in one instruction takes time by its length, so
/// that strings have a limit of their own.
void* allocate(void* context, void* old, std::size_t old_size, std::size_t size) {
    auto& c = *static_cast<LuaContext*>(context);
    if (old == nullptr) {  // old_size is the type of the new object
        if (old_size == LUA_TSTRING && size > largest_string) return nullptr;
        old_size = 0;
    }
    if (size == 0) {
        std::free(old);
        c.used_bytes -= old_size;
        return nullptr;
    }
    const std::size_t used = c.used_bytes - old_size + size;
    if (size > old_size && used > ConditionEngine::max_memory_bytes) return nullptr;
    void* block = std::realloc(old, size);
    if (block != nullptr) c.used_bytes = used;
    return block;
}

void on_count(lua_State* lua, lua_Debug*) {
    LuaContext& c = lua_context(lua);
    c.instructions += hook_step;
    c.message_instructions += hook_step;
    if (c.instructions >= ConditionEngine::max_instructions) {
        luaL_error(lua, "runs for more than %d instructions",
                   static_cast<int>(ConditionEngine::max_instructions));
    }
}

int read_only(lua_State* lua) { return luaL_error(lua, "globals and libraries cannot be changed"); }

/// The message proxies pass for the tables that they stand in for.
const char* type_name(lua_State* lua, int index) {
    const int type = lua_type(lua, index);
    return type == LUA_TUSERDATA ? "table" : lua_typename(lua, type);
}

int type(lua_State* lua) {
    luaL_checkany(lua, 1);
    lua_pushstring(lua, type_name(lua, 1));
    return 1;
}

bool is_plain(lua_State* lua, int index) {
    const int type = lua_type(lua, index);
    return type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING;
}

/// As Lua's, but what would be an address, another one in each process, is the type.
int tostring(lua_State* lua) {
    luaL_checkany(lua, 1);
    if (is_plain(lua, 1))
        luaL_tolstring(lua, 1, nullptr);
    else
        lua_pushstring(lua, type_name(lua, 1));
    return 1;
}

/// string.format (its first upvalue), for the same reason without tables and functions.
int format(lua_State* lua) {
    const int count = lua_gettop(lua);
    for (int k = 1; k <= count; ++k) {
        if (!is_plain(lua, k)) return luaL_argerror(lua, k, "no plain value");
    }
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, count, LUA_MULTRET);
    return lua_gettop(lua);
}

/// Pushes a new table with some fields of the one on top, and takes that away.
void keep(lua_State* lua, const char* const* first, const char* const* last) {
    lua_newtable(lua);
    for (; first != last; ++first) {
        lua_getfield(lua, -2, *first);
        lua_setfield(lua, -2, *first);
    }
    lua_remove(lua, -2);
}

/// Replaces the table on top by one through which it can be read and not changed.
void protect_table(lua_State* lua) {
    lua_newtable(lua);
    lua_createtable(lua, 0, 2);
    lua_pushvalue(lua, -3);
    lua_setfield(lua, -2, "__index");
    lua_pushcfunction(lua, read_only);
    lua_setfield(lua, -2, "__newindex");
    lua_setmetatable(lua, -2);
    lua_remove(lua, -2);
}

void open_string(lua_State* lua) {
    static constexpr const char* kept[] = {"byte",  "char",    "format", "len",
                                           "lower", "reverse", "sub",    "upper"};
    lua_pushcfunction(lua, luaopen_string);
    lua_call(lua, 0, 1);
    keep(lua, std::begin(kept), std::end(kept));
    lua_getfield(lua, -1, "format");
    lua_pushcclosure(lua, format, 1);
    lua_setfield(lua, -2, "format");
    lua_pushliteral(lua, "");  // its metatable is that of all strings
    lua_getmetatable(lua, -1);
    lua_pushvalue(lua, -3);
    lua_setfield(lua, -2, "__index");
    lua_pop(lua, 2);
    protect_table(lua);
}

void open_math(lua_State* lua) {
    lua_pushcfunction(lua, luaopen_math);
    lua_call(lua, 0, 1);
    for (const char* name : {"random", "randomseed"}) {
        lua_pushnil(lua);
        lua_setfield(lua, -2, name);
    }
    protect_table(lua);
}

void open_globals(lua_State* lua) {
    static constexpr const char* kept[] = {"ipairs", "select", "tonumber"};
    lua_pushcfunction(lua, luaopen_base);
    lua_call(lua, 0, 1);
    keep(lua, std::begin(kept), std::end(kept));
    lua_pushcfunction(lua, type);
    lua_setfield(lua, -2, "type");
    lua_pushcfunction(lua, tostring);
    lua_setfield(lua, -2, "tostring");
    open_string(lua);
    lua_setfield(lua, -2, "string");
    open_math(lua);
    lua_setfield(lua, -2, "math");
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, globals_key);
    protect_table(lua);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, environment_key);
    lua_pushnil(lua);  // the base library's own table of globals is out of reach now
    lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}

struct Source {
    std::string_view text;
    int reference;
};

void compile_source(lua_State* lua, void* argument) {
    auto& source = *static_cast<Source*>(argument);
    const int status =
        luaL_loadbufferx(lua, source.text.data(), source.text.size(), chunk_name, "t");
    if (status != LUA_OK) lua_error(lua);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, environment_key);
    lua_setupvalue(lua, -2, 1);  // _ENV
    source.reference = luaL_ref(lua, LUA_REGISTRYINDEX);
}

struct Body {
    void (*function)(lua_State*, void*);
    void* argument;
};

int call_body(lua_State* lua) {
    const auto& body = *static_cast<const Body*>(lua_touserdata(lua, 1));
    lua_settop(lua, 0);
    body.function(lua, body.argument);
    return 0;
}

/// The message on top of the stack, without the place that Lua puts in front.
std::string reason(lua_State* lua, int status) {
    if (status == LUA_ERRMEM) return "takes too much memory";
    if (lua_type(lua, -1) != LUA_TSTRING) return "fails";
    std::size_t size = 0;
    const char* text = lua_tolstring(lua, -1, &size);
    std::string_view message(text, size);
    const std::string_view place = "condition:";
    if (message.starts_with(place)) {
        const std::size_t end = message.find_first_not_of("0123456789", place.size());
        if (message.substr(end).starts_with(": ")) message.remove_prefix(end + 2);
    }
    return std::string(message);
}

}  // namespace

LuaContext& lua_context(lua_State* lua) {
    return **static_cast<LuaContext**>(lua_getextraspace(lua));
}

void push_globals(lua_State* lua) { lua_rawgetp(lua, LUA_REGISTRYINDEX, globals_key); }

LuaSandbox::LuaSandbox() {
    lua_ = lua_newstate(allocate, &context_);
    if (lua_ == nullptr) throw std::bad_alloc();
    *static_cast<LuaContext**>(lua_getextraspace(lua_)) = &context_;
    try {
        protect([](lua_State* lua, void*) { open_globals(lua); }, nullptr);
    } catch (const LuaFailure&) {
        lua_close(lua_);
        throw std::bad_alloc();
    }
}

LuaSandbox::~LuaSandbox() { lua_close(lua_); }

void LuaSandbox::protect(void (*body)(lua_State*, void*), void* argument) {
    Body both{body, argument};
    lua_pushcfunction(lua_, call_body);
    lua_pushlightuserdata(lua_, &both);
    const int status = lua_pcall(lua_, 1, 0, 0);
    if (status == LUA_OK) return;
    LuaFailure failure{reason(lua_, status), status == LUA_ERRMEM};
    lua_settop(lua_, 0);
    collect_garbage();
    throw failure;
}

int LuaSandbox::compile(std::string_view text) {
    lua_sethook(lua_, nullptr, 0, 0);
    Source source{text, LUA_NOREF};
    protect(compile_source, &source);
    return source.reference;
}

void LuaSandbox::forget(int reference) {
    protect(
        [](lua_State* lua, void* argument) {
            luaL_unref(lua, LUA_REGISTRYINDEX, *static_cast<int*>(argument));
        },
        &reference);
}

// Not only for the memory: Lua takes what a run left in unused places of its stack for alive until
// it is collected with nothing on the stack.
void LuaSandbox::collect_garbage() { lua_gc(lua_, LUA_GCCOLLECT, 0); }

void LuaSandbox::start_run(const schema::Values& values) {
    context_.values = &values;
    context_.instructions = 0;
    ++context_.run;
    context_.message_instructions += run_cost;
    if (context_.counts_messages &&
        context_.message_instructions > ConditionEngine::max_message_instructions) {
        throw LuaFailure{"the message's conditions run for too long"};
    }
    lua_sethook(lua_, on_count, LUA_MASKCOUNT, hook_step);
}

}  // namespace seautils::dccl
