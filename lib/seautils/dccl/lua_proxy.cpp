#include "seautils/dccl/lua_proxy.hpp"

#include "seautils/dccl/lua_sandbox.hpp"

#include <google/protobuf/descriptor.h>
#include <lua.hpp>

#include <limits>
#include <new>
#include <string_view>

namespace seautils::dccl {

namespace {

using schema::EnumLayout;
using schema::Field;
using schema::Kind;
using schema::Layout;
using schema::Slot;

const char metatable_key = 0;  // its address is the key in Lua's registry

void push_text(lua_State* lua, std::string_view text) {
    lua_pushlstring(lua, text.data(), text.size());
}

void push_unsigned(lua_State* lua, std::uint64_t value) {
    constexpr std::uint64_t max = std::numeric_limits<lua_Integer>::max();
    if (value <= max)
        lua_pushinteger(lua, static_cast<lua_Integer>(value));
    else
        lua_pushnumber(lua, static_cast<lua_Number>(value));
}

void push_enumerator(lua_State* lua, const EnumLayout& enumeration, std::int64_t number) {
    const EnumLayout::Value* value = enumeration.find(static_cast<std::int32_t>(number));
    if (value != nullptr)
        push_text(lua, value->name);
    else
        lua_pushinteger(lua, number);
}

/// The value of a field that is not repeated, or of an element.
void push_value(lua_State* lua, const Field& field, const Slot& slot) {
    const LuaContext& context = lua_context(lua);
    switch (field.kind) {
        case Kind::boolean:
            lua_pushboolean(lua, slot.i != 0);
            return;
        case Kind::int32:
        case Kind::int64:
            lua_pushinteger(lua, slot.i);
            return;
        case Kind::uint32:
        case Kind::uint64:
            push_unsigned(lua, slot.u);
            return;
        case Kind::float32:
        case Kind::float64:
            lua_pushnumber(lua, slot.d);
            return;
        case Kind::string:
        case Kind::bytes:
            push_text(lua, context.values->text(slot));
            return;
        case Kind::enumeration:
            push_enumerator(lua, *field.enumeration, slot.i);
            return;
        case Kind::message:
            push_proxy(
                lua, {field.message, nullptr, static_cast<std::uint32_t>(slot.u), 0, context.run});
            return;
    }
}

/// The default that the schema states, or the type's.
void push_default(lua_State* lua, const google::protobuf::FieldDescriptor& field) {
    using google::protobuf::FieldDescriptor;
    switch (field.cpp_type()) {
        case FieldDescriptor::CPPTYPE_BOOL:
            lua_pushboolean(lua, field.default_value_bool());
            return;
        case FieldDescriptor::CPPTYPE_INT32:
            lua_pushinteger(lua, field.default_value_int32());
            return;
        case FieldDescriptor::CPPTYPE_INT64:
            lua_pushinteger(lua, field.default_value_int64());
            return;
        case FieldDescriptor::CPPTYPE_UINT32:
            push_unsigned(lua, field.default_value_uint32());
            return;
        case FieldDescriptor::CPPTYPE_UINT64:
            push_unsigned(lua, field.default_value_uint64());
            return;
        case FieldDescriptor::CPPTYPE_FLOAT:
            lua_pushnumber(lua, static_cast<double>(field.default_value_float()));
            return;
        case FieldDescriptor::CPPTYPE_DOUBLE:
            lua_pushnumber(lua, field.default_value_double());
            return;
        case FieldDescriptor::CPPTYPE_STRING:
            push_text(lua, field.default_value_string());
            return;
        case FieldDescriptor::CPPTYPE_ENUM:
            push_text(lua, field.default_value_enum()->name());
            return;
        case FieldDescriptor::CPPTYPE_MESSAGE:
            lua_pushnil(lua);
            return;
    }
}

bool is_proto3(const Field& field) {
    return field.descriptor != nullptr &&
           field.descriptor->file()->syntax() == google::protobuf::FileDescriptor::SYNTAX_PROTO3;
}

bool has_default(const Field& field) {
    if (field.descriptor == nullptr || field.kind == Kind::message) return false;
    return !field.has_presence || field.descriptor->has_default_value();
}

void push_field(lua_State* lua, const LuaProxy& message, std::size_t index) {
    const LuaContext& context = lua_context(lua);
    const Field& field = message.layout->fields[index];
    const Slot& slot = (*context.values)[message.at + static_cast<std::uint32_t>(index)];
    if (field.repeated) {
        if (slot.aux == 0 && !is_proto3(field)) return lua_pushnil(lua);
        push_proxy(lua, {message.layout, &field, static_cast<std::uint32_t>(slot.u), slot.aux,
                         context.run});
    } else if (slot.present) {
        push_value(lua, field, slot);
    } else if (has_default(field)) {
        push_default(lua, *field.descriptor);
    } else {
        lua_pushnil(lua);
    }
}

/// Name of the member that is set in the oneof of that name; nil if there is none.
void push_oneof_case(lua_State* lua, const LuaProxy& message, std::string_view name) {
    for (const schema::Oneof& oneof : message.layout->oneofs) {
        if (oneof.synthetic || oneof.name != name) continue;
        for (const std::uint32_t member : oneof.fields) {
            if (!(*lua_context(lua).values)[message.at + member].present) continue;
            return push_text(lua, message.layout->fields[member].name);
        }
    }
    lua_pushnil(lua);
}

const LuaProxy& proxy_at(lua_State* lua, int index) {
    const auto* proxy = static_cast<const LuaProxy*>(lua_touserdata(lua, index));
    if (proxy->run != lua_context(lua).run) luaL_error(lua, "the message is gone");
    return *proxy;
}

void index_message(lua_State* lua, const LuaProxy& message) {
    if (lua_type(lua, 2) != LUA_TSTRING) return lua_pushnil(lua);
    std::size_t size = 0;
    const char* text = lua_tolstring(lua, 2, &size);
    const std::string_view name(text, size);
    const std::int32_t index = message.layout->find(name);
    if (index < 0 || message.layout->fields[static_cast<std::size_t>(index)].name != name) {
        return push_oneof_case(lua, message, name);
    }
    push_field(lua, message, static_cast<std::size_t>(index));
}

void index_repeated(lua_State* lua, const LuaProxy& repeated) {
    int is_integer = 0;
    const lua_Integer index = lua_tointegerx(lua, 2, &is_integer);
    if (is_integer == 0 || index < 1 || index > repeated.count) return lua_pushnil(lua);
    const Slot& slot =
        (*lua_context(lua).values)[repeated.at + static_cast<std::uint32_t>(index - 1)];
    if (slot.present)
        push_value(lua, *repeated.field, slot);
    else
        lua_pushnil(lua);
}

int on_index(lua_State* lua) {
    const LuaProxy& proxy = proxy_at(lua, 1);
    if (proxy.field != nullptr)
        index_repeated(lua, proxy);
    else
        index_message(lua, proxy);
    return 1;
}

int on_length(lua_State* lua) {
    const LuaProxy& proxy = proxy_at(lua, 1);
    if (proxy.field == nullptr) return luaL_error(lua, "attempt to get length of a message");
    lua_pushinteger(lua, proxy.count);
    return 1;
}

int on_equal(lua_State* lua) {
    const LuaProxy& a = proxy_at(lua, 1);
    const LuaProxy& b = proxy_at(lua, 2);
    lua_pushboolean(lua, a.layout == b.layout && a.field == b.field && a.at == b.at);
    return 1;
}

int on_assign(lua_State* lua) { return luaL_error(lua, "messages cannot be changed"); }

int next_element(lua_State* lua) {
    const LuaProxy& repeated = proxy_at(lua, 1);
    const lua_Integer index = luaL_checkinteger(lua, 2);
    lua_settop(lua, 1);
    if (index < 0 || index >= repeated.count) return 0;
    lua_pushinteger(lua, index + 1);
    index_repeated(lua, repeated);
    return 2;
}

int pairs(lua_State* lua) {
    const bool repeated = lua_type(lua, 1) == LUA_TUSERDATA && proxy_at(lua, 1).field != nullptr;
    if (!repeated) return luaL_error(lua, "pairs takes a repeated field only");
    lua_pushcfunction(lua, next_element);
    lua_pushvalue(lua, 1);
    lua_pushinteger(lua, 0);
    return 3;
}

}  // namespace

void open_proxies(lua_State* lua) {
    static const luaL_Reg functions[] = {{"__index", on_index},
                                         {"__len", on_length},
                                         {"__eq", on_equal},
                                         {"__newindex", on_assign},
                                         {nullptr, nullptr}};
    luaL_newlib(lua, functions);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &metatable_key);
    push_globals(lua);
    lua_pushcfunction(lua, pairs);
    lua_setfield(lua, -2, "pairs");
    lua_pop(lua, 1);
}

LuaProxy* push_proxy(lua_State* lua, const LuaProxy& proxy) {
    auto* made = static_cast<LuaProxy*>(lua_newuserdata(lua, sizeof(LuaProxy)));
    *made = proxy;
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &metatable_key);
    lua_setmetatable(lua, -2);
    return made;
}

}  // namespace seautils::dccl
