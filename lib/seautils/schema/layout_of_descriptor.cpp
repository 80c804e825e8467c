#include "seautils/schema/layout_set.hpp"

#include <google/protobuf/descriptor.h>

namespace seautils::schema {

namespace {

using google::protobuf::FieldDescriptor;

Kind kind_of(const FieldDescriptor& f) {
    switch (f.cpp_type()) {
        case FieldDescriptor::CPPTYPE_INT32:
            return Kind::int32;
        case FieldDescriptor::CPPTYPE_INT64:
            return Kind::int64;
        case FieldDescriptor::CPPTYPE_UINT32:
            return Kind::uint32;
        case FieldDescriptor::CPPTYPE_UINT64:
            return Kind::uint64;
        case FieldDescriptor::CPPTYPE_DOUBLE:
            return Kind::float64;
        case FieldDescriptor::CPPTYPE_FLOAT:
            return Kind::float32;
        case FieldDescriptor::CPPTYPE_BOOL:
            return Kind::boolean;
        case FieldDescriptor::CPPTYPE_ENUM:
            return Kind::enumeration;
        case FieldDescriptor::CPPTYPE_MESSAGE:
            return Kind::message;
        case FieldDescriptor::CPPTYPE_STRING:
            break;
    }
    return f.type() == FieldDescriptor::TYPE_BYTES ? Kind::bytes : Kind::string;
}

WireForm wire_form_of(const FieldDescriptor& f) {
    switch (f.type()) {
        case FieldDescriptor::TYPE_SINT32:
        case FieldDescriptor::TYPE_SINT64:
            return WireForm::zigzag;
        case FieldDescriptor::TYPE_FIXED32:
        case FieldDescriptor::TYPE_SFIXED32:
        case FieldDescriptor::TYPE_FLOAT:
            return WireForm::fixed32;
        case FieldDescriptor::TYPE_FIXED64:
        case FieldDescriptor::TYPE_SFIXED64:
        case FieldDescriptor::TYPE_DOUBLE:
            return WireForm::fixed64;
        case FieldDescriptor::TYPE_STRING:
        case FieldDescriptor::TYPE_BYTES:
        case FieldDescriptor::TYPE_MESSAGE:
            return WireForm::length;
        case FieldDescriptor::TYPE_GROUP:
            return WireForm::group;
        default:
            return WireForm::varint;
    }
}

}  // namespace

const EnumLayout& LayoutSet::Impl::enumeration(const google::protobuf::EnumDescriptor& descriptor) {
    EnumLayout*& known = of_enum[&descriptor];
    if (known != nullptr) return *known;
    EnumLayout& e = enums.emplace_back();
    known = &e;
    e.full_name = descriptor.full_name();
    e.descriptor = &descriptor;
    e.open = descriptor.file()->syntax() == google::protobuf::FileDescriptor::SYNTAX_PROTO3;
    for (int k = 0; k < descriptor.value_count(); ++k) {
        e.values.push_back({descriptor.value(k)->name(), descriptor.value(k)->number()});
    }
    fill_indices(e);
    return e;
}

/// The layout, which is put on the list of those to be filled when it is new.
Layout& LayoutSet::Impl::begin(const google::protobuf::Descriptor& descriptor,
                               std::vector<Layout*>& open) {
    Layout*& known = of[&descriptor];
    if (known == nullptr) {
        known = &layouts.emplace_back();
        known->full_name = descriptor.full_name();
        known->descriptor = &descriptor;
        open.push_back(known);
    }
    return *known;
}

Field LayoutSet::Impl::field(const FieldDescriptor& f, std::vector<Layout*>& open) {
    count_fields(1);
    Field field;
    field.name = f.name();
    field.json_name = f.json_name();
    field.number = f.number();
    field.kind = kind_of(f);
    field.wire_form = wire_form_of(f);
    field.required = f.is_required();
    field.repeated = f.is_repeated();
    field.packed = f.is_packed();
    field.has_presence = f.has_presence();
    field.descriptor = &f;
    if (const auto* oneof = f.containing_oneof()) field.oneof = oneof->index();
    if (field.kind == Kind::message) field.message = &begin(*f.message_type(), open);
    if (field.kind == Kind::enumeration) field.enumeration = &enumeration(*f.enum_type());
    return field;
}

const Layout& LayoutSet::of(const google::protobuf::Descriptor& descriptor) {
    std::vector<Layout*> open;
    Layout& root = impl_->begin(descriptor, open);
    while (!open.empty()) {
        Layout& layout = *open.back();
        open.pop_back();
        const google::protobuf::Descriptor& d = *layout.descriptor;
        for (int k = 0; k < d.oneof_decl_count(); ++k) {
            layout.oneofs.push_back({d.oneof_decl(k)->name(), {}, k >= d.real_oneof_decl_count()});
        }
        for (int k = 0; k < d.field_count(); ++k) {
            layout.fields.push_back(impl_->field(*d.field(k), open));
            const std::int32_t oneof = layout.fields.back().oneof;
            if (oneof >= 0)
                layout.oneofs[static_cast<std::size_t>(oneof)].fields.push_back(
                    static_cast<std::uint32_t>(k));
        }
        fill_indices(layout);
    }
    return root;
}

}  // namespace seautils::schema
