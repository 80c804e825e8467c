#include "seautils/dccl/conditions.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/lua_proxy.hpp"
#include "seautils/dccl/lua_sandbox.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include <cmath>
#include <unordered_map>

namespace seautils::dccl {

namespace {

/// Compiled scripts are forgotten when Lua holds more than this.
constexpr std::size_t max_kept_bytes = ConditionEngine::max_memory_bytes / 2;

constexpr std::size_t max_reason_bytes = 200;

/// Lua's reasons quote parts of the script as they are.
std::string printable(std::string reason) {
    if (reason.size() > max_reason_bytes) reason.resize(max_reason_bytes);
    for (char& c : reason) {
        if (c < ' ' || c > '~') c = c == '\n' || c == '\t' ? ' ' : '?';
    }
    return reason;
}

std::string message(const std::string& script, const std::string& reason) {
    return fmt::format("condition {}: {}", quote(script), printable(reason));
}

struct Result {
    int type = LUA_TNIL;
    bool truth = false;
    double number = 0;
};

struct Call {
    int script;
    std::uint32_t index;
    BlockRef root, self;
    Result result;
};

void call_script(lua_State* lua, void* argument) {
    auto& call = *static_cast<Call*>(argument);
    push_globals(lua);
    lua_pushinteger(lua, call.index);
    lua_setfield(lua, -2, "this_index");
    lua_rawgeti(lua, LUA_REGISTRYINDEX, call.script);
    lua_call(lua, 0, 1);
    call.result.type = lua_type(lua, -1);
    call.result.truth = lua_toboolean(lua, -1) != 0;
    if (call.result.type == LUA_TNUMBER) call.result.number = lua_tonumber(lua, -1);
}

LuaProxy* make_global(lua_State* lua, const char* name) {
    push_globals(lua);
    LuaProxy* proxy = push_proxy(lua, {});
    lua_setfield(lua, -2, name);
    lua_pop(lua, 1);
    return proxy;
}

}  // namespace

struct ConditionEngine::Impl {
    LuaSandbox sandbox;
    LuaProxy* self = nullptr;  // Lua's, kept alive by its table of globals
    LuaProxy* root = nullptr;
    std::unordered_map<std::string, int> scripts;

    int compile(const std::string& script);
    int compiled(const std::string& script);
    void forget_scripts();
    void attempt(const std::string& script, const schema::Values& values, Call& call);
    Result run(const std::string& script, const schema::Values& values, BlockRef root_block,
               BlockRef self_block, std::uint32_t index);
};

int ConditionEngine::Impl::compile(const std::string& script) {
    if (script.size() > max_script_bytes) {
        throw LuaFailure{fmt::format("{} bytes are more than {}", script.size(), max_script_bytes)};
    }
    if (sandbox.context().used_bytes > max_kept_bytes) forget_scripts();
    if (script.find("return") != std::string::npos) return sandbox.compile(script);
    return sandbox.compile("return " + script);
}

void ConditionEngine::Impl::forget_scripts() {
    for (const auto& kept : scripts) sandbox.forget(kept.second);
    scripts.clear();
    sandbox.collect_garbage();
}

int ConditionEngine::Impl::compiled(const std::string& script) {
    const auto found = scripts.find(script);
    if (found != scripts.end()) return found->second;
    return scripts.emplace(script, compile(script)).first->second;
}

void ConditionEngine::Impl::attempt(const std::string& script, const schema::Values& values,
                                    Call& call) {
    call.script = compiled(script);
    sandbox.start_run(values);
    *root = {call.root.layout, nullptr, call.root.block, 0, sandbox.context().run};
    *self = {call.self.layout, nullptr, call.self.block, 0, sandbox.context().run};
    sandbox.protect(call_script, &call);
}

Result ConditionEngine::Impl::run(const std::string& script, const schema::Values& values,
                                  BlockRef root_block, BlockRef self_block, std::uint32_t index) {
    Call call{LUA_NOREF, index, root_block, self_block, {}};
    try {
        try {
            attempt(script, values, call);
        } catch (const LuaFailure& failure) {
            if (!failure.out_of_memory) throw;
            forget_scripts();  // whether it fails must not depend on what ran before
            attempt(script, values, call);
        }
    } catch (const LuaFailure& failure) {
        throw DataError(message(script, failure.reason));
    }
    return call.result;
}

ConditionEngine::ConditionEngine() : impl_(std::make_unique<Impl>()) {
    impl_->sandbox.protect(
        [](lua_State* lua, void* argument) {
            auto& impl = *static_cast<Impl*>(argument);
            open_proxies(lua);
            impl.self = make_global(lua, "this");
            impl.root = make_global(lua, "root");
        },
        impl_.get());
}

ConditionEngine::~ConditionEngine() = default;
ConditionEngine::ConditionEngine(ConditionEngine&&) noexcept = default;
ConditionEngine& ConditionEngine::operator=(ConditionEngine&&) noexcept = default;

void ConditionEngine::check(const std::string& script) {
    try {
        impl_->sandbox.forget(impl_->compile(script));
    } catch (const LuaFailure& failure) {
        throw ConfigError(message(script, failure.reason));
    }
}

void ConditionEngine::start_message() {
    impl_->sandbox.context().counts_messages = true;
    impl_->sandbox.context().message_instructions = 0;
}

bool ConditionEngine::test(const std::string& script, const schema::Values& values, BlockRef root,
                           BlockRef self, std::uint32_t index) {
    return impl_->run(script, values, root, self, index).truth;
}

std::optional<double> ConditionEngine::number(const std::string& script,
                                              const schema::Values& values, BlockRef root,
                                              BlockRef self, std::uint32_t index) {
    const Result result = impl_->run(script, values, root, self, index);
    if (result.type == LUA_TNIL) return std::nullopt;
    if (result.type != LUA_TNUMBER) throw DataError(message(script, "gives no number"));
    if (std::isnan(result.number)) throw DataError(message(script, "gives NaN"));
    return result.number;
}

}  // namespace seautils::dccl
