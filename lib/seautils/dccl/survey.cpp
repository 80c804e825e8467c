#include "seautils/dccl/survey.hpp"

#include "seautils/core/error.hpp"
#include "seautils/dccl/legacy_schema.hpp"
#include "seautils/schema/message.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <cmath>
#include <string_view>
#include <unordered_set>

namespace seautils::dccl {

namespace {

std::string declared_type(const schema::Field& f) {
    std::string name = f.descriptor->type_name();
    if (f.kind == schema::Kind::enumeration) name += " " + f.descriptor->enum_type()->name();
    if (f.kind == schema::Kind::message) name += " " + f.descriptor->message_type()->name();
    if (f.repeated) return "repeated " + name;
    return f.required ? "required " + name : name;
}

FieldSurvey describe(const FieldReport& row) {
    FieldSurvey field;
    field.path = row.path;
    field.type = declared_type(*row.field);
    field.codec = row.codec;
    field.part = row.lost ? "none" : row.in_head ? "head" : "body";
    const bool number = row.kind == OpKind::integer || row.kind == OpKind::floating;
    if (number) {
        field.min = row.number.min;
        field.max = row.number.max;
        field.resolution = row.number.resolution;
    }
    if (row.kind == OpKind::enumeration) {
        field.values = static_cast<std::uint32_t>(row.field->enumeration->values.size());
    }
    field.unit = row.unit;
    if (row.kind == OpKind::text) field.max_length = row.max_length;
    field.min_repeat = row.min_repeat;
    field.max_repeat = row.max_repeat;
    field.min_bits = row.min_bits;
    field.max_bits = row.max_bits;
    return field;
}

/// None where the typical values do not pass: a schema may be such that none do.
std::optional<TypicalBytes> typical_bytes(const std::shared_ptr<const Program>& program,
                                          std::int64_t now_s) {
    schema::Values values;
    std::string dccl, protobuf;
    CodecOptions options;
    options.now_s = now_s;
    try {
        typical_values(*program, now_s, values);
        Codec codec(options);
        codec.load(program);
        codec.encode(*program, values, dccl);
        schema::write_binary(values, protobuf);
    } catch (const DataError&) {
        return std::nullopt;
    }
    return TypicalBytes{dccl.size(), protobuf.size(), plain_bytes(values)};
}

/// The rows that tell something: a version 2 message is entered for the header and again for the
/// body, and has a row in the part that none of its bits are in.
std::vector<FieldSurvey> describe_fields(const Program& program) {
    const std::vector<FieldReport> report = program.report();
    std::unordered_set<std::string_view> travelling;
    for (const FieldReport& row : report) {
        if (row.max_bits > 0) travelling.insert(row.path);
    }
    std::vector<FieldSurvey> fields;
    for (const FieldReport& row : report) {
        const bool elsewhere = row.max_bits == 0 && travelling.contains(row.path);
        if (!elsewhere) fields.push_back(describe(row));
    }
    return fields;
}

Survey describe(const std::shared_ptr<const Program>& shared, std::int64_t now_s) {
    const Program& program = *shared;
    Survey s;
    s.name = program.name();
    if (program.has_id()) s.id = program.id();
    s.codec_version = program.codec_version();
    s.id_bits = program.id_bits();
    s.head_min_bits = program.head_min_bits();
    s.head_max_bits = program.head_max_bits();
    s.body_min_bits = program.body_min_bits();
    s.body_max_bits = program.body_max_bits();
    s.min_bytes = program.smallest_bytes();
    s.max_bytes = program.largest_bytes();
    s.limit_bytes = program.max_bytes();
    s.fields = describe_fields(program);
    s.typical = typical_bytes(shared, now_s);
    s.remarks = lint(program);
    return s;
}

FieldSurvey describe(const LegacyField& f) {
    constexpr const char* names[] = {"bool", "number", "string", "enum", "hex", "static"};
    FieldSurvey field;
    field.path = f.name;
    field.type = names[static_cast<std::size_t>(f.kind)];
    field.part = "body";
    if (f.kind == LegacyKind::number) {
        field.min = f.min;
        field.max = f.max;
        field.resolution = std::pow(10.0, -f.precision);
    }
    if (f.kind == LegacyKind::enumeration) {
        field.values = static_cast<std::uint32_t>(f.values.size());
    }
    field.max_length = f.max_length;
    if (f.array_length > 1) field.min_repeat = field.max_repeat = f.array_length;
    field.min_bits = field.max_bits = f.bits();
    return field;
}

Survey describe(const LegacyMessage& message) {
    constexpr unsigned header_bits = 48, id_bits = 9;
    Survey s;
    s.name = message.name();
    s.id = static_cast<std::int32_t>(message.id());
    s.codec_version = 1;
    s.id_bits = id_bits;
    s.head_min_bits = s.head_max_bits = header_bits - id_bits;
    s.body_min_bits = s.body_max_bits = message.body_bits();
    s.min_bytes = header_bits / 8;  // zero bytes at the end are not sent
    s.max_bytes = message.largest_bytes();
    s.limit_bytes = message.max_bytes();
    for (const LegacyField& f : message.fields()) s.fields.push_back(describe(f));
    return s;
}

void name_collisions(std::vector<Survey>& surveys) {
    for (Survey& one : surveys) {
        for (const Survey& other : surveys) {
            if (&one == &other || !one.id || one.id != other.id) continue;
            one.remarks.insert(one.remarks.begin(),
                               {"id-collision", "",
                                fmt::format("{} has the identifier {} too: a receiver that loads "
                                            "both cannot tell them apart",
                                            other.name, *other.id)});
        }
    }
}

}  // namespace

std::vector<Survey> survey(const TypeSet& types, std::int64_t now_s) {
    std::vector<Survey> surveys;
    for (const Type& type : types.types()) {
        surveys.push_back(type.program ? describe(type.program, now_s) : describe(*type.legacy));
    }
    name_collisions(surveys);
    return surveys;
}

}  // namespace seautils::dccl
