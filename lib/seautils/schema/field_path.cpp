#include "seautils/schema/field_path.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

namespace seautils::schema {

namespace {

[[noreturn]] void unknown(std::string_view name, const Layout& layout) {
    std::vector<std::string> names;
    for (const Field& f : layout.fields) names.push_back(f.name);
    const std::string near = nearest(name, names);
    throw ConfigError(fmt::format("field {} is not in message {}{}", quote(name), layout.full_name,
                                  near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

}  // namespace

FieldPath::FieldPath(const Layout& layout, std::string_view path) {
    const Layout* in = &layout;
    std::string_view rest = path;
    for (;;) {
        const std::string_view name = rest.substr(0, rest.find('.'));
        const std::int32_t index = in->find(name);
        if (index < 0) unknown(name, *in);
        field_ = &in->fields[static_cast<std::size_t>(index)];
        steps_.push_back(static_cast<std::uint32_t>(index));
        if (field_->repeated) throw ConfigError("field " + quote(path) + " is repeated");
        if (name.size() == rest.size()) break;
        rest.remove_prefix(name.size() + 1);
        if (field_->kind != Kind::message)
            throw ConfigError("field " + quote(path) + ": " + field_->name + " is no message");
        in = field_->message;
    }
    if (field_->kind == Kind::message) throw ConfigError("field " + quote(path) + " is a message");
}

const Slot* FieldPath::find(const Values& values) const {
    std::uint32_t block = 0;
    for (std::size_t k = 0;; ++k) {
        const Slot& slot = values[block + steps_[k]];
        if (k + 1 == steps_.size()) return slot.present || !field_->has_presence ? &slot : nullptr;
        if (!slot.present) return nullptr;
        block = static_cast<std::uint32_t>(slot.u);
    }
}

}  // namespace seautils::schema
