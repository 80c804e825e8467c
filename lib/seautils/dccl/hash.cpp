#include "seautils/dccl/hash.hpp"

#include "seautils/dccl/murmur.hpp"
#include "seautils/dccl/program.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>

#include <memory>
#include <optional>
#include <string>

namespace seautils::dccl {

namespace {

using google::protobuf::Descriptor;

/// The text of a serialized options message, which the schema's own pool knows by its name.
std::string options_text(const google::protobuf::DescriptorPool& pool, const char* type,
                         const std::optional<std::string>& bytes, bool with_max_bytes) {
    if (!bytes) return {};
    const Descriptor* descriptor = pool.FindMessageTypeByName(type);
    if (descriptor == nullptr) return {};
    google::protobuf::DynamicMessageFactory factory(&pool);
    const std::unique_ptr<google::protobuf::Message> message(
        factory.GetPrototype(descriptor)->New());
    if (!message->ParsePartialFromString(*bytes)) return {};
    if (!with_max_bytes) {
        message->GetReflection()->ClearField(message.get(),
                                             descriptor->FindFieldByName("max_bytes"));
    }
    return message->DebugString();
}

std::string field_text(const google::protobuf::FieldDescriptor& field) {
    google::protobuf::FieldDescriptorProto proto;
    field.CopyTo(&proto);
    proto.clear_name();
    proto.clear_type_name();
    proto.clear_default_value();
    proto.clear_options();
    return proto.DebugString();
}

class Hasher {
public:
    Hasher(const Program& program, const std::vector<Op>& ops)
        : program_(program), ops_(ops), pool_(*program.layout().descriptor->file()->pool()) {}

    std::uint64_t part(const Descriptor& message, std::size_t first, std::size_t last) const {
        std::uint64_t h = 0;
        for (std::size_t at = first; at < last; ++at) {
            const Op& op = ops_[at];
            if (op.kind == OpKind::selectors) {
                for (int k = 0; k < message.oneof_decl_count(); ++k) {
                    h = comb(h, std_string_hash(message.oneof_decl(k)->DebugString()));
                }
                continue;
            }
            if (op.kind == OpKind::lost) continue;
            h = field(h, op, at);
            at = op.end - 1;
        }
        return h;
    }

private:
    std::uint64_t field(std::uint64_t h, const Op& op, std::size_t at) const {
        const google::protobuf::FieldDescriptor& f = *op.field->descriptor;
        h = comb(h, std_string_hash(field_text(f)));
        h = comb(h, std_string_hash(
                        options_text(pool_, "dccl.DCCLFieldOptions", raw_field_options(f), true)));
        if (op.kind == OpKind::message) return comb(h, part(*f.message_type(), at + 1, op.end));
        const bool hashed = op.kind == OpKind::enumeration && program_.enum_code(op).hashed;
        return comb(h, hashed ? std_string_hash(f.enum_type()->DebugString()) : 0);
    }

    const Program& program_;
    const std::vector<Op>& ops_;
    const google::protobuf::DescriptorPool& pool_;
};

}  // namespace

std::uint64_t hash_definition(const Program& program) {
    const Descriptor& root = *program.layout().descriptor;
    const std::uint64_t options = std_string_hash(options_text(
        *root.file()->pool(), "dccl.DCCLMessageOptions", raw_message_options(root), false));
    std::uint64_t h = 0;
    for (const std::vector<Op>* ops : {&program.head(), &program.body()}) {
        h = comb(h, options);
        h = comb(h, Hasher(program, *ops).part(root, 0, ops->size()));
    }
    return h;
}

}  // namespace seautils::dccl
