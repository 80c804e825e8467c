#include "seautils/schema/layout.hpp"

#include "seautils/core/error.hpp"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <deque>
#include <numeric>

namespace seautils::schema {

namespace {

using google::protobuf::FieldDescriptor;

constexpr std::size_t max_fields = 100'000;

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

template <class Less>
std::vector<std::uint32_t> sorted_indices(std::size_t count, Less less) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    std::stable_sort(indices.begin(), indices.end(), less);
    return indices;
}

void fill_indices(Layout& layout) {
    layout.by_name.clear();
    for (Field& f : layout.fields) f.json_key = "\"" + f.name + "\":";
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        layout.by_name.emplace(layout.fields[k].name, k);
    }
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        if (!layout.fields[k].json_name.empty())
            layout.by_name.emplace(layout.fields[k].json_name, k);
    }
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        const Field& f = layout.fields[k];
        if (f.required || f.kind == Kind::message) layout.to_check.push_back(k);
    }
    layout.by_number = sorted_indices(layout.fields.size(), [&](std::uint32_t a, std::uint32_t b) {
        return layout.fields[a].number < layout.fields[b].number;
    });
    layout.timestamp = layout.full_name == "google.protobuf.Timestamp" &&
                       layout.fields.size() == 2 && layout.fields[0].kind == Kind::int64 &&
                       layout.fields[1].kind == Kind::int32;
}

void fill_indices(EnumLayout& e) {
    e.by_name = sorted_indices(e.values.size(), [&](std::uint32_t a, std::uint32_t b) {
        return e.values[a].name < e.values[b].name;
    });
    e.by_number = sorted_indices(e.values.size(), [&](std::uint32_t a, std::uint32_t b) {
        return e.values[a].number < e.values[b].number;
    });
}

}  // namespace

const EnumLayout::Value* EnumLayout::find(std::string_view name) const {
    const auto at =
        std::lower_bound(by_name.begin(), by_name.end(), name,
                         [&](std::uint32_t k, std::string_view n) { return values[k].name < n; });
    return at != by_name.end() && values[*at].name == name ? &values[*at] : nullptr;
}

const EnumLayout::Value* EnumLayout::find(std::int32_t number) const {
    const auto at =
        std::lower_bound(by_number.begin(), by_number.end(), number,
                         [&](std::uint32_t k, std::int32_t n) { return values[k].number < n; });
    return at != by_number.end() && values[*at].number == number ? &values[*at] : nullptr;
}

std::int32_t Layout::find(std::string_view name, std::uint32_t hint) const {
    if (hint < fields.size() && fields[hint].name == name) return static_cast<std::int32_t>(hint);
    const auto at = by_name.find(name);
    return at == by_name.end() ? -1 : static_cast<std::int32_t>(at->second);
}

std::int32_t Layout::search_number(std::int32_t number) const {
    const auto at =
        std::lower_bound(by_number.begin(), by_number.end(), number,
                         [&](std::uint32_t k, std::int32_t n) { return fields[k].number < n; });
    return at != by_number.end() && fields[*at].number == number ? static_cast<std::int32_t>(*at)
                                                                 : -1;
}

struct LayoutSet::Impl {
    std::deque<Layout> layouts;
    std::deque<EnumLayout> enums;
    std::unordered_map<const google::protobuf::Descriptor*, Layout*> of;
    std::unordered_map<const google::protobuf::EnumDescriptor*, EnumLayout*> of_enum;
    std::size_t fields = 0;

    const EnumLayout& enumeration(const google::protobuf::EnumDescriptor& descriptor);
    Layout& begin(const google::protobuf::Descriptor& descriptor, std::vector<Layout*>& open);
    Field field(const FieldDescriptor& f, std::vector<Layout*>& open);
};

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
    if (++fields > max_fields) throw ConfigError("the schema has more than 100000 fields");
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

LayoutSet::LayoutSet() : impl_(std::make_unique<Impl>()) {}
LayoutSet::~LayoutSet() = default;
LayoutSet::LayoutSet(LayoutSet&&) noexcept = default;
LayoutSet& LayoutSet::operator=(LayoutSet&&) noexcept = default;

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

const Layout& LayoutSet::add(Layout layout) {
    impl_->fields += layout.fields.size();
    if (impl_->fields > max_fields) throw ConfigError("the schema has more than 100000 fields");
    Layout& kept = impl_->layouts.emplace_back(std::move(layout));
    fill_indices(kept);
    return kept;
}

const EnumLayout& LayoutSet::add(EnumLayout enumeration) {
    EnumLayout& kept = impl_->enums.emplace_back(std::move(enumeration));
    fill_indices(kept);
    return kept;
}

}  // namespace seautils::schema
