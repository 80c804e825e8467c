#include "seautils/core/text.hpp"
#include "seautils/dccl/survey.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seautils::dccl {

namespace {

using Json = nlohmann::ordered_json;

/// Whole numbers without a fraction: 31, not 31.0.
Json number(double x) {
    const bool whole = x == std::floor(x) && std::fabs(x) < 9007199254740992.0;
    return whole ? Json(static_cast<std::int64_t>(x)) : Json(x);
}

Json as_json(const FieldSurvey& f) {
    Json row = {{"path", f.path}, {"type", f.type}};
    if (!f.codec.empty()) row["codec"] = f.codec;
    row["part"] = f.part;
    if (f.min) row["min"] = number(*f.min);
    if (f.max) row["max"] = number(*f.max);
    if (f.resolution) row["resolution"] = number(*f.resolution);
    if (!f.unit.empty()) row["unit"] = f.unit;
    if (f.max_length != 0) row["max_length"] = f.max_length;
    if (f.values != 0) row["values"] = f.values;
    if (f.max_repeat != 0) {
        row["min_repeat"] = f.min_repeat;
        row["max_repeat"] = f.max_repeat;
    }
    row["min_bits"] = f.min_bits;
    row["max_bits"] = f.max_bits;
    return row;
}

Json as_json(const Remark& remark) {
    Json row = {{"kind", remark.kind}};
    if (!remark.field.empty()) row["field"] = remark.field;
    row["text"] = remark.text;
    return row;
}

template <class Rows>
Json array_of(const Rows& rows) {
    Json array = Json::array();
    for (const auto& row : rows) array.push_back(as_json(row));
    return array;
}

/// "7", or "7 to 12".
std::string range(std::uint64_t min, std::uint64_t max) {
    return min == max ? fmt::format("{}", min) : fmt::format("{} to {}", min, max);
}

std::string bounds(const FieldSurvey& f) {
    std::string text;
    if (f.min && f.max) text = fmt::format("{:.10g} to {:.10g}", *f.min, *f.max);
    if (!f.unit.empty() && !text.empty()) text += " " + f.unit;
    if (f.max_length != 0) text = fmt::format("up to {} bytes", f.max_length);
    if (f.values != 0) text = fmt::format("{} values", f.values);
    if (f.max_repeat != 0) {
        text += (text.empty() ? "" : ", ") + range(f.min_repeat, f.max_repeat) + " times";
    }
    return text;
}

using Row = std::array<std::string, 6>;

Row cells(const FieldSurvey& f) {
    return {f.path,
            f.type,
            bounds(f),
            f.resolution ? fmt::format("{:.6g}", *f.resolution) : "",
            range(f.min_bits, f.max_bits),
            f.part};
}

void append_rows(const std::vector<Row>& rows, std::string& out) {
    std::array<std::size_t, 6> width{};
    for (const Row& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
    }
    for (const Row& row : rows) {
        std::string line = " ";
        for (std::size_t k = 0; k < row.size(); ++k) {
            const bool right = k == 3 || k == 4;
            const std::string gap(width[k] - row[k].size(), ' ');
            line += " " + (right ? gap + row[k] : row[k] + gap) + " ";
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + '\n';
    }
}

std::string times(std::uint64_t bytes, std::uint64_t dccl) {
    return fmt::format("{} bytes ({:.1f} times as much)", bytes,
                       static_cast<double>(bytes) / static_cast<double>(dccl));
}

std::string bits(std::uint64_t least, std::uint64_t most) {
    return least == most ? counted(most, "bit") : range(least, most) + " bits";
}

void append_totals(const Survey& s, std::string& out) {
    out +=
        fmt::format("  identifier {}, header {}, body {}\n", bits(s.id_bits, s.id_bits),
                    bits(s.head_min_bits, s.head_max_bits), bits(s.body_min_bits, s.body_max_bits));
    if (!s.typical || s.typical->dccl == 0) return;
    out += fmt::format("  typical: {} bytes; in protobuf {}; in plain 32-bit numbers {}\n",
                       s.typical->dccl, times(s.typical->protobuf, s.typical->dccl),
                       times(s.typical->plain, s.typical->dccl));
}

}  // namespace

void append_json(const Survey& s, std::string& out) {
    Json json = {{"message", s.name}};
    if (s.id) json["id"] = *s.id;
    json["codec_version"] = s.codec_version;
    json["min_bytes"] = s.min_bytes;
    json["largest_bytes"] = s.max_bytes;
    json["max_bytes"] = s.limit_bytes;
    json["id_bits"] = s.id_bits;
    json["head_min_bits"] = s.head_min_bits;
    json["head_max_bits"] = s.head_max_bits;
    json["body_min_bits"] = s.body_min_bits;
    json["body_max_bits"] = s.body_max_bits;
    json["fields"] = array_of(s.fields);
    if (s.typical) {
        json["typical"] = {{"dccl_bytes", s.typical->dccl},
                           {"protobuf_bytes", s.typical->protobuf},
                           {"plain_bytes", s.typical->plain}};
    }
    json["lint"] = array_of(s.remarks);
    out += json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append_table(const Survey& s, std::string& out) {
    out += fmt::format("{}: {}, codec version {}, {} bytes of at most {}\n", s.name,
                       s.id ? fmt::format("id {}", *s.id) : "no id", s.codec_version,
                       range(s.min_bytes, s.max_bytes), s.limit_bytes);
    std::vector<Row> rows{{"field", "type", "bounds", "resolution", "bits", "part"}};
    for (const FieldSurvey& f : s.fields) rows.push_back(cells(f));
    append_rows(rows, out);
    append_totals(s, out);
    for (const Remark& remark : s.remarks) {
        out += "  ! " + (remark.field.empty() ? "" : remark.field + ": ") + remark.text + " [" +
               remark.kind + "]\n";
    }
    out += '\n';
}

}  // namespace seautils::dccl
