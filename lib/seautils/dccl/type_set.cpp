#include "seautils/dccl/type_set.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/crypto.hpp"
#include "seautils/dccl/legacy_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <unordered_map>

namespace seautils::dccl {

struct TypeSet::Impl {
    explicit Impl(CodecOptions options) : codec(std::move(options)) {}

    schema::Pool pool;
    schema::LayoutSet layouts;  ///< of the legacy types
    LegacySchema legacy;
    LegacyOptions legacy_options;
    std::optional<Cipher> cipher;
    std::set<std::int32_t> skip_crypto_ids;
    Codec codec;
    std::vector<Type> types;
    std::unordered_map<const Program*, const Type*> by_program;
    std::bitset<256> first_bytes;
    std::vector<std::pair<std::string, std::string>> left_out;
    bool chosen = false;
    Collisions collisions = Collisions::refuse;

    void load_protobuf(const std::vector<std::string>& messages, const ProgramOptions& options);
    void load_legacy(const std::vector<std::string>& messages,
                     const std::vector<std::string>& files);
    std::shared_ptr<const Program> compile(const google::protobuf::Descriptor& descriptor,
                                           const ProgramOptions& options);
    void load(const std::shared_ptr<const Program>& program);
    void add(const google::protobuf::Descriptor& descriptor, const ProgramOptions& options);
    LegacyOptions options_for(const LegacyMessage& message) const;
};

namespace {

bool is_xml(const std::string& path) { return path.ends_with(".xml"); }

}  // namespace

TypeSet::TypeSet(const std::vector<std::string>& schemas, const std::vector<std::string>& messages,
                 const ProgramOptions& program_options, CodecOptions codec_options,
                 Collisions collisions) {
    const auto xml =
        static_cast<std::size_t>(std::count_if(schemas.begin(), schemas.end(), is_xml));
    if (xml != 0 && xml != schemas.size()) {
        throw ConfigError("schemas of DCCL 1 (.xml) and of protobuf cannot be mixed");
    }
    const auto passphrase = codec_options.passphrase;
    const bool lenient = codec_options.lenient;
    const std::int64_t now_s = codec_options.now_s;
    const auto skip = codec_options.skip_crypto_ids;
    impl_ = std::make_unique<Impl>(std::move(codec_options));
    impl_->collisions = collisions;
    impl_->chosen = !messages.empty();
    if (xml == 0) {
        for (const std::string& path : schemas) impl_->pool.load(path);
        impl_->load_protobuf(messages, program_options);
    } else {
        impl_->legacy_options.lenient = lenient;
        impl_->legacy_options.now_s = now_s;
        impl_->skip_crypto_ids = skip;
        if (passphrase) impl_->cipher.emplace(*passphrase);
        impl_->load_legacy(messages, schemas);
    }
    for (const Type& type : impl_->types) {
        if (type.program) impl_->by_program[type.program.get()] = &type;
        if (!type.program || !type.program->has_id())
            impl_->first_bytes.set();
        else
            impl_->first_bytes.set(type.program->id_code() & 0xff);
    }
}

TypeSet::~TypeSet() = default;
TypeSet::TypeSet(TypeSet&&) noexcept = default;
TypeSet& TypeSet::operator=(TypeSet&&) noexcept = default;

/// Compiles, and says where in the schema that fails.
std::shared_ptr<const Program> TypeSet::Impl::compile(
    const google::protobuf::Descriptor& descriptor, const ProgramOptions& options) {
    try {
        return Program::compile(pool.layout(descriptor), options);
    } catch (const ConfigError& e) {
        const std::string_view what = e.what();
        const std::string head = "message " + descriptor.full_name() + ": field ";
        const std::size_t end = what.find(": ", head.size());
        const bool of_field = what.starts_with(head) && end != what.npos;
        const std::string_view path =
            of_field ? what.substr(head.size(), end - head.size()) : std::string_view();
        throw ConfigError(pool.place(descriptor, path) + e.what());
    }
}

void TypeSet::Impl::load(const std::shared_ptr<const Program>& program) {
    try {
        codec.load(program);
    } catch (const ConfigError& e) {
        if (collisions == Collisions::keep) return;
        throw ConfigError(pool.place(*program->layout().descriptor, {}) + e.what());
    }
}

void TypeSet::Impl::add(const google::protobuf::Descriptor& descriptor,
                        const ProgramOptions& options) {
    Type type;
    type.layout = &pool.layout(descriptor);
    type.name = type.layout->full_name;
    type.program = compile(descriptor, options);
    load(type.program);
    types.push_back(std::move(type));
}

void TypeSet::Impl::load_protobuf(const std::vector<std::string>& messages,
                                  const ProgramOptions& options) {
    for (const std::string& name : messages) {
        const google::protobuf::Descriptor& descriptor = pool.message(name);
        const bool twice = std::any_of(types.begin(), types.end(), [&](const Type& t) {
            return t.layout->descriptor == &descriptor;
        });
        if (!twice) add(descriptor, options);
    }
    if (chosen) return;
    for (const google::protobuf::Descriptor* descriptor : pool.messages()) {
        const MessageOptions o = message_options(*descriptor);
        if (!o.id && !o.omit_id) continue;  // not meant to be a message by itself
        std::shared_ptr<const Program> program;
        const schema::Layout& layout = pool.layout(*descriptor);
        try {
            program = compile(*descriptor, options);
        } catch (const ConfigError& e) {
            left_out.emplace_back(layout.full_name, e.what());
            continue;
        }
        load(program);
        types.push_back({layout.full_name, &layout, program, nullptr});
    }
    if (!types.empty()) return;
    throw ConfigError(left_out.empty() ? "no message of the schema has an id (option (dccl.msg).id)"
                                       : left_out.front().second);
}

void TypeSet::Impl::load_legacy(const std::vector<std::string>& messages,
                                const std::vector<std::string>& files) {
    legacy = dccl::load_legacy(files, layouts);
    for (const LegacyMessage& m : legacy.messages) {
        if (!chosen || std::find(messages.begin(), messages.end(), m.name()) != messages.end()) {
            types.push_back({m.name(), &m.layout(), nullptr, &m});
        }
    }
    for (const std::string& name : messages) {
        const bool known =
            std::any_of(types.begin(), types.end(), [&](const Type& t) { return t.name == name; });
        if (!known) throw ConfigError(fmt::format("message {} is not in the schema", quote(name)));
    }
}

LegacyOptions TypeSet::Impl::options_for(const LegacyMessage& message) const {
    LegacyOptions options = legacy_options;
    if (cipher && !skip_crypto_ids.contains(static_cast<std::int32_t>(message.id())))
        options.cipher = &*cipher;
    return options;
}

const std::vector<Type>& TypeSet::types() const { return impl_->types; }
const std::vector<std::pair<std::string, std::string>>& TypeSet::left_out() const {
    return impl_->left_out;
}
const std::vector<std::string>& TypeSet::ignored_tags() const { return impl_->legacy.ignored_tags; }
schema::Pool& TypeSet::pool() { return impl_->pool; }

const Type* TypeSet::usual() const {
    return impl_->chosen || single() ? &impl_->types.front() : nullptr;
}

const Type& TypeSet::type(std::string_view name) const {
    const Type* found = nullptr;
    for (const Type& type : impl_->types) {
        if (type.name == name) return type;
        const bool tail = type.name.size() > name.size() && type.name.ends_with(name) &&
                          type.name[type.name.size() - name.size() - 1] == '.';
        if (tail && found != nullptr)
            throw DataError(fmt::format("type {} is ambiguous", quote(name)));
        if (tail) found = &type;
    }
    if (found != nullptr) return *found;
    for (const auto& [left, reason] : impl_->left_out) {
        if (left == name)
            throw DataError(fmt::format("type {} was left out: {}", quote(name), reason));
    }
    std::vector<std::string> names;
    for (const Type& type : impl_->types) names.push_back(type.name);
    const std::string near = nearest(name, names);
    throw DataError(fmt::format("type {} is not loaded{}", quote(name),
                                near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

void TypeSet::set_now(std::int64_t now_s) {
    impl_->codec.set_now(now_s);
    impl_->legacy_options.now_s = now_s;
}

void TypeSet::encode(const Type& type, const schema::Values& values, std::string& out) {
    if (type.program) return impl_->codec.encode(*type.program, values, out);
    dccl::encode(*type.legacy, values, impl_->options_for(*type.legacy), out);
}

TypeSet::Decoded TypeSet::decode(std::string_view bytes, schema::Values& values) {
    const Type& first = impl_->types.front();
    if (first.program) {
        const bool taken = single() && !first.program->has_id();
        const Codec::Decoded d =
            impl_->codec.decode(bytes, values, taken ? first.program.get() : nullptr);
        return {impl_->by_program.at(d.program), d.bytes};
    }
    const std::int32_t id = legacy_id(bytes);
    for (const Type& type : impl_->types) {
        if (static_cast<std::int32_t>(type.legacy->id()) != id) continue;
        return {&type, dccl::decode(*type.legacy, bytes, impl_->options_for(*type.legacy), values)};
    }
    throw DataError(fmt::format("identifier {} is of no message that is loaded", id));
}

bool TypeSet::is_padding(std::string_view rest) const {
    if (rest.find_first_not_of('\0') != rest.npos) return false;
    return std::none_of(impl_->types.begin(), impl_->types.end(), [](const Type& t) {
        return t.program != nullptr && t.program->has_id() && t.program->id() == 0;
    });
}

std::map<std::string, std::uint32_t> repeats(const Type& type) {
    std::map<std::string, std::uint32_t> all;
    if (type.program == nullptr) {
        for (const schema::Field& f : type.layout->fields) {
            if (f.repeated) all[f.name] = type.legacy->array_length(f.name);
        }
        return all;
    }
    for (const FieldReport& row : type.program->report()) {
        if (row.max_repeat == 0) continue;
        std::string path = row.path;
        for (std::size_t k; (k = path.find("[]")) != std::string::npos;) path.erase(k, 2);
        all[path] = row.max_repeat;
    }
    return all;
}

bool TypeSet::may_begin(char byte) const {
    return impl_->first_bytes[static_cast<unsigned char>(byte)];
}

}  // namespace seautils::dccl
