#include "seautils/dccl/resync.hpp"

#include "seautils/core/error.hpp"
#include "seautils/dccl/field_error.hpp"

namespace seautils::dccl {

Found find_message(TypeSet& types, std::string_view bytes, bool ended) {
    schema::Values values;
    std::string again;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        if (!types.may_begin(bytes[at])) continue;
        const std::string_view rest = bytes.substr(at);
        try {
            const TypeSet::Decoded decoded = types.decode(rest, values);
            again.clear();
            types.encode(*decoded.type, values, again);
            if (again == rest.substr(0, decoded.bytes)) return {at, true};
        } catch (const Truncated&) {
            if (!ended) return {at, false};
        } catch (const DataError&) {
            continue;
        }
    }
    return {bytes.size(), false};
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

}  // namespace seautils::dccl
