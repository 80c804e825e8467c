#include "seautils/schema/csv.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/number_text.hpp"

#include <fmt/format.h>

namespace seautils::schema {

namespace {

constexpr std::size_t max_columns = 10'000;
constexpr int max_depth = 32;

void append_cell(std::string& out, std::string_view text) {
    if (text.find_first_of(",\"\r\n") == text.npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    out += '"';
}

void append_value(std::string& out, const Field& f, const Slot& s, const Values& values) {
    switch (f.kind) {
        case Kind::boolean:
            out += s.i != 0 ? "true" : "false";
            return;
        case Kind::uint32:
        case Kind::uint64:
            return append_integer(out, s.u);
        case Kind::float32:
            return append_float(out, static_cast<float>(s.d));
        case Kind::float64:
            return append_double(out, s.d);
        case Kind::string:
            return append_cell(out, values.text(s));
        case Kind::bytes:
            return append_base64(out, values.text(s));
        case Kind::enumeration:
            if (const EnumLayout::Value* v = f.enumeration->find(static_cast<std::int32_t>(s.i))) {
                return append_cell(out, v->name);
            }
            return append_integer(out, s.i);
        default:
            return append_integer(out, s.i);
    }
}

/// Lists the leaves of a message: each with its name and the steps that lead to it.
class Lister {
public:
    Lister(const std::map<std::string, std::uint32_t>& max_repeat, std::vector<std::string>& names,
           std::vector<std::vector<std::uint32_t>>& paths)
        : max_repeat_(max_repeat), names_(names), paths_(paths) {}

    void message(const Layout& layout, const std::string& shown, const std::string& plain,
                 std::vector<std::uint32_t> steps, int depth) {
        if (depth > max_depth) throw ConfigError("nested deeper than 32 messages");
        for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
            const Field& f = layout.fields[k];
            const std::string path = plain + f.name;
            steps.push_back(k);
            if (f.repeated) {
                const auto found = max_repeat_.find(path);
                const std::uint32_t count = found == max_repeat_.end() ? 1 : found->second;
                for (std::uint32_t e = 0; e < count; ++e) {
                    steps.push_back(e);
                    one(f, fmt::format("{}{}[{}]", shown, f.name, e), path, steps, depth);
                    steps.pop_back();
                }
            } else {
                one(f, shown + f.name, path, steps, depth);
            }
            steps.pop_back();
        }
    }

private:
    void one(const Field& f, const std::string& shown, const std::string& plain,
             const std::vector<std::uint32_t>& steps, int depth) {
        if (f.kind == Kind::message)
            return message(*f.message, shown + ".", plain + ".", steps, depth + 1);
        if (names_.size() >= max_columns) throw ConfigError("more than 10000 columns");
        names_.push_back(shown);
        paths_.push_back(steps);
    }

    const std::map<std::string, std::uint32_t>& max_repeat_;
    std::vector<std::string>& names_;
    std::vector<std::vector<std::uint32_t>>& paths_;
};

}  // namespace

CsvWriter::CsvWriter(const Layout& layout, const std::map<std::string, std::uint32_t>& max_repeat)
    : layout_(&layout), max_repeat_(max_repeat) {
    Lister(max_repeat, columns_, paths_).message(layout, "", "", {}, 1);
}

void CsvWriter::header(std::string& out) const {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
        if (k > 0) out += ',';
        append_cell(out, columns_[k]);
    }
    out += '\n';
}

void CsvWriter::row(const Values& values, std::string& out) const {
    for (std::size_t column = 0; column < paths_.size(); ++column) {
        if (column > 0) out += ',';
        const Layout* layout = layout_;
        std::uint32_t at = 0;
        const std::vector<std::uint32_t>& steps = paths_[column];
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const Field& f = layout->fields[steps[k]];
            at += steps[k];
            if (!values[at].present) break;
            if (f.repeated) {
                if (steps[++k] >= values[at].aux) break;
                at = static_cast<std::uint32_t>(values[at].u) + steps[k];
                if (!values[at].present) break;
            }
            if (f.kind != Kind::message) {
                append_value(out, f, values[at], values);
                break;
            }
            layout = f.message;
            at = static_cast<std::uint32_t>(values[at].u);
        }
    }
    out += '\n';
}

}  // namespace seautils::schema
