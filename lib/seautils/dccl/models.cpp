#include "seautils/dccl/models.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/builtin_files.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/pool.hpp"

#include <fmt/format.h>

namespace seautils::dccl {

namespace {

/// Calls `take` with each element of a repeated field, or with the one value of a singular field.
template <class Take>
void each(const schema::Values& values, const char* name, Take take) {
    const std::int32_t index = values.layout().find(name);
    const schema::Slot& slot = values[static_cast<std::uint32_t>(index)];
    if (!slot.present) return;
    if (!values.layout().fields[static_cast<std::size_t>(index)].repeated) return take(slot);
    for (std::uint32_t k = 0; k < slot.aux; ++k) {
        take(values[static_cast<std::uint32_t>(slot.u) + k]);
    }
}

entropy::Model to_model(const schema::Values& values) {
    entropy::Model m;
    each(values, "name", [&](const schema::Slot& s) { m.name = values.text(s); });
    each(values, "frequency",
         [&](const schema::Slot& s) { m.frequency.push_back(static_cast<std::uint32_t>(s.u)); });
    each(values, "eof_frequency",
         [&](const schema::Slot& s) { m.eof_frequency = static_cast<std::uint32_t>(s.u); });
    each(values, "out_of_range_frequency", [&](const schema::Slot& s) {
        m.out_of_range_frequency = static_cast<std::uint32_t>(s.u);
    });
    each(values, "value_bound", [&](const schema::Slot& s) { m.value_bound.push_back(s.d); });
    each(values, "is_adaptive", [&](const schema::Slot& s) { m.is_adaptive = s.i != 0; });
    return m;
}

}  // namespace

void add_model(const std::string& text, std::map<std::string, entropy::Model>& models) {
    schema::Pool pool;
    for (const schema::BuiltinFile& file : schema::builtin_files()) {
        if (file.path.ends_with("/arithmetic.proto")) {
            pool.load_text("arithmetic_model.proto", std::string(file.text));
        }
    }
    schema::Values values;
    const schema::Layout& layout = pool.layout(pool.message("dccl.arith.protobuf.ArithmeticModel"));
    try {
        schema::read_text(text, pool, layout, values);
    } catch (const DataError& e) {
        throw ConfigError(fmt::format("arithmetic model: {}", e.what()));
    }
    entropy::Model model = to_model(values);
    entropy::check(model);
    const std::string name = model.name;
    if (!models.try_emplace(name, std::move(model)).second) {
        throw ConfigError(fmt::format("arithmetic model {} is given twice", quote(name)));
    }
}

}  // namespace seautils::dccl
