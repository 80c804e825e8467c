#include "seautils/dccl/codec.hpp"

#include "seautils/core/text.hpp"
#include "seautils/dccl/codec_impl.hpp"

#include <fmt/format.h>

namespace seautils::dccl {

namespace {

/// What the identifier of a frame says.
struct Identifier {
    std::uint32_t code;  ///< as Program::id_code()
    unsigned bits;
};

[[noreturn]] void too_short(std::size_t wanted, std::size_t given) {
    throw Truncated("the identifier takes " + where_left(wanted, "byte", given));
}

/// @param ccl  whether frames begin with a CCL identifier
Identifier read_identifier(std::string_view bytes, bool ccl) {
    const auto byte = [&](std::size_t k) {
        if (k >= bytes.size()) too_short(k + 1, bytes.size());
        return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k]));
    };
    std::size_t at = 0;
    std::uint32_t escape = 0;
    if (ccl) {
        if (byte(0) != 0x20) return {byte(0), 8};
        escape = 0x20;
        at = 1;
    }
    std::uint32_t code = byte(at);
    unsigned bits = 8;
    if ((code & 1) != 0) {
        code |= byte(at + 1) << 8;
        bits = 16;
        if (code >> 1 < 128) {
            throw DataError(
                fmt::format("identifier {} stands in two bytes where one is enough", code >> 1));
        }
    }
    return ccl ? Identifier{code << 8 | escape, bits + 8} : Identifier{code, bits};
}

std::int32_t id_of(const Identifier& identifier, bool ccl) {
    std::uint32_t code = identifier.code;
    if (ccl && identifier.bits == 8) return static_cast<std::int32_t>(0x0CC10000 + code);
    if (ccl) code >>= 8;
    return static_cast<std::int32_t>(code >> 1);
}

/// @throws DataError  a required field is unset in the message or below; its path
void check_required(const schema::Layout& layout, const schema::Values& values,
                    std::uint32_t block) {
    for (const std::uint32_t k : layout.to_check) {
        const schema::Field& f = layout.fields[k];
        const schema::Slot& slot = values[block + k];
        if (f.required && !slot.present) throw FieldError{f.name, "is required and not given"};
        if (f.kind != schema::Kind::message || !slot.present) continue;
        const std::uint32_t count = f.repeated ? slot.aux : 1;
        for (std::uint32_t e = 0; e < count; ++e) {
            const schema::Slot& one =
                f.repeated ? values[static_cast<std::uint32_t>(slot.u) + e] : slot;
            try {
                check_required(*f.message, values, static_cast<std::uint32_t>(one.u));
            } catch (FieldError& error) {
                error.enter(f.repeated ? fmt::format("{}[{}]", f.name, e) : f.name);
                throw;
            }
        }
    }
}

/// With --header-only what the body requires may be missing, but not what the header does.
void check_required_head(const Program& program, const schema::Values& values) {
    const std::vector<Op>& ops = program.head();
    for (std::size_t at = 0; at < ops.size(); at = ops[at].end) {
        const schema::Field* f = ops[at].field;
        if (f == nullptr || !f->required || f->kind == schema::Kind::message) continue;
        if (!values[ops[at].slot].present) throw FieldError{f->name, "is required and not given"};
    }
}

/// Puts adaptive models back where they were unless the message went through.
class Learning {
public:
    Learning(const Program& program, std::map<std::string, entropy::Counts>& counts)
        : counts_(counts) {
        for (std::size_t k = 0; k < program.model_count(); ++k) {
            if (program.model_at(k).is_adaptive) before_ = counts;
        }
    }
    Learning(const Learning&) = delete;
    Learning& operator=(const Learning&) = delete;
    ~Learning() {
        if (!before_.empty()) counts_.swap(before_);
    }
    void keep() { before_.clear(); }

private:
    std::map<std::string, entropy::Counts>& counts_;
    std::map<std::string, entropy::Counts> before_;
};

/// Map key: CCL and other identifiers of equal code differ in length.
std::uint32_t key_of(std::uint32_t code, unsigned bits) { return code | bits << 26; }

}  // namespace

Codec::Codec(CodecOptions options) : impl_(std::make_unique<Impl>()) {
    if (options.passphrase) impl_->cipher.emplace(*options.passphrase);
    options.passphrase.reset();
    impl_->options = std::move(options);
}
Codec::~Codec() = default;
Codec::Codec(Codec&&) noexcept = default;
Codec& Codec::operator=(Codec&&) noexcept = default;

void Codec::load(std::shared_ptr<const Program> program) {
    Impl& c = *impl_;
    for (const auto& other : c.programs) {
        if (other == program) return;
    }
    if (program->has_id()) {
        const auto [at, fresh] =
            c.by_id_code.try_emplace(key_of(program->id_code(), program->id_bits()), program.get());
        if (!fresh) {
            throw ConfigError(fmt::format("id {} is both message {} and message {}", program->id(),
                                          at->second->name(), program->name()));
        }
    }
    if (program->has_conditions() && !c.engine) c.engine.emplace();
    for (std::size_t k = 0; k < program->model_count(); ++k) {
        const entropy::Model& model = program->model_at(k);
        c.encoder_counts.try_emplace(model.name, model);
        c.decoder_counts.try_emplace(model.name, model);
    }
    c.programs.push_back(std::move(program));
}

const Program* Codec::find(std::string_view name) const {
    for (const auto& program : impl_->programs) {
        if (program->name() == name) return program.get();
    }
    return nullptr;
}

void Codec::set_now(std::int64_t now_s) { impl_->options.now_s = now_s; }

void Codec::encode(const Program& program, const schema::Values& values, std::string& out) {
    Impl& c = *impl_;
    const std::size_t start = out.size();
    Learning learning(program, c.encoder_counts);
    if (c.engine) c.engine->start_message();
    try {
        if (!c.options.header_only)
            check_required(program.layout(), values, 0);
        else if (!c.options.lenient)
            check_required_head(program, values);
        Encoder encoder(c, program, values);
        c.writer.reset();
        c.writer.put(program.id_code(), program.id_bits());
        encoder.part(program.head());
        c.writer.append_to(out);
        if (c.options.header_only) return learning.keep();
        const std::size_t body = out.size();
        c.writer.reset();
        encoder.part(program.body());
        c.writer.append_to(out);
        if (const Cipher* cipher = c.cipher_for(program)) {
            const std::string head = out.substr(start, body - start);
            cipher->apply(head, out.data() + body, out.size() - body);
        }
        learning.keep();
    } catch (const FieldError& e) {
        out.resize(start);
        e.raise(program.layout());
    } catch (...) {
        out.resize(start);
        throw;
    }
}

const Program& Codec::identify(std::string_view bytes) const {
    bool ccl = false;
    for (const auto& program : impl_->programs) ccl |= program->id_codec() == IdCodec::ccl;
    const Identifier identifier = read_identifier(bytes, ccl);
    const auto found = impl_->by_id_code.find(key_of(identifier.code, identifier.bits));
    if (found == impl_->by_id_code.end()) {
        throw DataError(
            fmt::format("identifier {} is of no message that is loaded", id_of(identifier, ccl)));
    }
    return *found->second;
}

Codec::Decoded Codec::decode(std::string_view bytes, schema::Values& values,
                             const Program* expected) {
    Impl& c = *impl_;
    const Program* program = expected;
    if (program == nullptr || program->has_id()) program = &identify(bytes);
    if (expected != nullptr && program != expected) {
        throw DataError(fmt::format("identifier {} is of message {}, not of {}", program->id(),
                                    program->name(), expected->name()));
    }
    values.reset(program->layout());
    Learning learning(*program, c.decoder_counts);
    if (c.engine) c.engine->start_message();
    try {
        Decoder decoder(c, *program, values);
        BitReader reader(bytes);
        reader.skip(program->id_bits());
        decoder.part(program->head(), reader);
        std::size_t used = reader.bytes_touched();
        if (!c.options.header_only) {
            std::string_view body = bytes.substr(used);
            const Cipher* cipher = c.cipher_for(*program);
            if (cipher != nullptr) {
                // A count may name up to twice max_repeat; no body is longer than that.
                const std::uint64_t longest = program->body_max_bits() / 4 + 64;
                c.body.assign(body.substr(0, longest));
                cipher->apply(bytes.substr(0, used), c.body.data(), c.body.size());
                body = c.body;
            }
            reader = BitReader(body);
            decoder.part(program->body(), reader);
            used += reader.bytes_touched();
        }
        decoder.prune();
        learning.keep();
        return {program, used};
    } catch (const FieldError& e) {
        e.raise(program->layout());
    }
}

std::size_t Codec::size(const Program& program, const schema::Values& values) {
    const auto counts = impl_->encoder_counts;
    std::string out;
    encode(program, values, out);
    impl_->encoder_counts = counts;
    return out.size();
}

void Codec::encode(const Program& program, const google::protobuf::Message& message,
                   std::string& out) {
    impl_->bridge.read(message, program.layout(), impl_->scratch);
    encode(program, impl_->scratch, out);
}

Codec::Decoded Codec::decode(std::string_view bytes, google::protobuf::Message& message,
                             const Program& expected) {
    const Decoded decoded = decode(bytes, impl_->scratch, &expected);
    impl_->bridge.write(impl_->scratch, message);
    return decoded;
}

}  // namespace seautils::dccl
