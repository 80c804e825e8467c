// Messages declared by a table, so that a tool need not read a schema to start.
#ifndef SEAUTILS_TOOLS_MESSAGE_TABLE_HPP
#define SEAUTILS_TOOLS_MESSAGE_TABLE_HPP

#include "seautils/schema/layout.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace seautils::tools {

/// Repeats messages of a schema: the file is the contract, and tests compare. Fields have the numbers 1, 2, 3, … in
/// their order.
class MessageTable {
protected:
    struct Declared {
        const char* name;
        schema::Kind kind;
        bool repeated = false;
        const schema::Layout* message = nullptr;
        const schema::EnumLayout* enumeration = nullptr;
    };

    static Declared part(const char* name, const schema::Layout& message, bool repeated = false) {
        return {
            .name = name, .kind = schema::Kind::message, .repeated = repeated, .message = &message};
    }
    static Declared choice(const char* name, const schema::EnumLayout& enumeration) {
        return {.name = name, .kind = schema::Kind::enumeration, .enumeration = &enumeration};
    }

    const schema::Layout& add_message(const char* full_name,
                                      std::initializer_list<Declared> fields) {
        schema::Layout layout;
        layout.full_name = full_name;
        for (const Declared& d : fields) {
            schema::Field f;
            f.name = d.name;
            f.number = static_cast<std::int32_t>(layout.fields.size()) + 1;
            f.kind = d.kind;
            f.repeated = d.repeated;
            f.message = d.message;
            f.enumeration = d.enumeration;
            const bool text = d.kind == schema::Kind::string || d.kind == schema::Kind::message;
            f.packed = d.repeated && !text;
            if (text) f.wire_form = schema::WireForm::length;
            if (d.kind == schema::Kind::float64) f.wire_form = schema::WireForm::fixed64;
            if (d.kind == schema::Kind::float32) f.wire_form = schema::WireForm::fixed32;
            f.has_presence = layout.full_name != "google.protobuf.Timestamp";  // that is proto3
            layout.fields.push_back(std::move(f));
        }
        return set_.add(std::move(layout));
    }

    const schema::EnumLayout& add_enumeration(const char* full_name,
                                              std::initializer_list<const char*> names) {
        schema::EnumLayout e;
        e.full_name = full_name;
        for (const char* value : names)
            e.values.push_back({value, static_cast<std::int32_t>(e.values.size())});
        return set_.add(std::move(e));
    }

private:
    schema::LayoutSet set_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_MESSAGE_TABLE_HPP
