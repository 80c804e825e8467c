#include "seautils/dccl/compiler.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace seautils::dccl {

namespace {

using schema::Kind;

constexpr std::uint32_t longest_text = 1U << 20;

bool is_integer(Kind kind) {
    return kind == Kind::int32 || kind == Kind::int64 || kind == Kind::uint32 ||
           kind == Kind::uint64;
}
bool is_floating(Kind kind) { return kind == Kind::float32 || kind == Kind::float64; }
bool is_text(Kind kind) { return kind == Kind::string || kind == Kind::bytes; }

struct Registered {
    const char* name;
    Family family;
    int version;
};

constexpr Registered registered[] = {
    {"dccl.default2", Family::standard, 2},
    {"dccl.default3", Family::standard, 3},
    {"dccl.default4", Family::standard, 4},
    {"dccl.time2", Family::time, 2},
    {"dccl.time3", Family::time, 3},
    {"dccl.time4", Family::time, 4},
    {"_time", Family::time, 0},
    {"dccl.static2", Family::fixed_value, 2},
    {"dccl.static3", Family::fixed_value, 3},
    {"dccl.static4", Family::fixed_value, 4},
    {"_static", Family::fixed_value, 0},
    {"dccl.presence3", Family::presence, 3},
    {"dccl.presence4", Family::presence, 4},
    {"dccl.var_bytes3", Family::var_bytes, 3},
    {"dccl.var_bytes4", Family::var_bytes, 4},
    {"dccl.hash2", Family::hash, 2},
    {"dccl.hash3", Family::hash, 3},
    {"dccl.hash4", Family::hash, 4},
    {"dccl.native_protobuf", Family::native, 0},
    {"dccl.arithmetic", Family::arithmetic, 0},
    {"_arithmetic", Family::arithmetic, 0},
};

std::optional<CodecChoice> registered_codec(const std::string& name) {
    for (const Registered& r : registered) {
        if (name == r.name) return CodecChoice{r.family, r.version, {}, name};
    }
    if (const auto ccl = ccl_codec(name)) return CodecChoice{Family::ccl, 0, *ccl, name};
    return std::nullopt;
}

bool fits_ccl(CclCodec codec, Kind kind) {
    switch (codec) {
        case CclCodec::latloncompressed:
            return kind == Kind::float64;
        case CclCodec::fix_age:
            return kind == Kind::uint32;
        case CclCodec::time_date:
            return kind == Kind::uint64;
        case CclCodec::gfi_pitch_oil:
            return kind == Kind::message;
        default:
            return kind == Kind::float32;
    }
}

/// What a C++ stream extracts from the text, or nothing.
template <class T>
std::optional<T> extract(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    T value;
    return in >> value ? std::optional<T>(value) : std::nullopt;
}

/// Largest size of protobuf's own encoding, in bits; the smallest of the variable ones is 8.
unsigned native_bits(const schema::Field& f) {
    if (f.kind == Kind::boolean) return 8;
    switch (f.wire_form) {
        case schema::WireForm::fixed32:
            return 32;
        case schema::WireForm::fixed64:
            return 64;
        default:
            break;
    }
    const bool small = f.kind == Kind::uint32 ||
                       (f.kind == Kind::int32 && f.wire_form == schema::WireForm::zigzag);
    return small ? 40 : 80;
}

}  // namespace

std::optional<CodecChoice> find_codec(const std::string& name, int version) {
    if (name.empty()) return std::nullopt;
    if (name.back() < '0' || name.back() > '9') {
        if (auto codec = registered_codec(name + std::to_string(version))) return codec;
    }
    return registered_codec(name);
}

bool fits(const CodecChoice& codec, const schema::Field& f) {
    switch (codec.family) {
        case Family::standard:
        case Family::presence:
            return true;
        case Family::time:
            return f.kind == Kind::float64 || f.kind == Kind::int64 || f.kind == Kind::uint64;
        case Family::fixed_value:
            return is_text(f.kind) || is_floating(f.kind) || is_integer(f.kind);
        case Family::var_bytes:
            return is_text(f.kind);
        case Family::hash:
            return f.kind == Kind::uint32;
        case Family::native:
            return !is_text(f.kind);
        case Family::arithmetic:
            return is_integer(f.kind) || is_floating(f.kind) || f.kind == Kind::boolean ||
                   f.kind == Kind::enumeration;
        case Family::ccl:
            return fits_ccl(codec.ccl, f.kind);
        case Family::custom:
            return true;  // bounds() says more
    }
    return false;
}

Compiler::Bits Compiler::element(Op& op, const FieldOptions& options, const CodecChoice& codec,
                                 const std::string& path) {
    const Kind kind = op.field->kind;
    switch (codec.family) {
        case Family::time:
            return time(op, options, path);
        case Family::fixed_value:
            return fixed_value(op, options, path);
        case Family::hash:
            return hash(op, options, path);
        case Family::native:
            return native(op, path);
        case Family::arithmetic:
            return arithmetic(op, options, path);
        case Family::ccl:
            return ccl(op, options, codec, path);
        case Family::custom:
            return custom(op, options, codec, path);
        case Family::standard:
        case Family::presence:
        case Family::var_bytes:
            break;
    }
    const bool presence = codec.family == Family::presence && !op.required;
    if (presence) op.required = true;
    Bits bits;
    if (is_text(kind)) {
        bits = text(op, options, codec, path);
    } else if (kind == Kind::boolean) {
        op.kind = OpKind::boolean;
        op.number.null_code = !op.required;
        op.number.width = op.required ? 1 : 2;
        bits = {op.number.width, op.number.width};
    } else if (kind == Kind::enumeration) {
        bits = enumeration(op, options, codec.version, path);
        program_->enums_[op.extra].hashed = codec.family != Family::presence;
    } else {
        bits = number(op, options, path);
    }
    if (op.kind != OpKind::text) op.element_min_bits = bits.min;
    if (!presence) return bits;
    op.presence_bit = true;
    op.required = false;
    return {1, bits.max + 1};
}

double Compiler::step(const Op& op, const FieldOptions& options, double min, double max,
                      const std::string& path) const {
    if (options.precision && options.resolution) {
        refuse(path, "options precision and resolution exclude each other");
    }
    const double step =
        options.precision ? step_of_precision(*options.precision) : options.resolution.value_or(1);
    if (!(step > 0) || !std::isfinite(step))
        refuse(path, fmt::format("resolution {} is not above 0", step));
    if (!(min <= max) || !std::isfinite(max - min)) {
        refuse(path, fmt::format("min {} and max {} enclose nothing", min, max));
    }
    if (max > min && std::log2(max - min) - std::log2(step) > 53) {
        refuse(path,
               fmt::format("steps of {} from {} to {} take more than 53 bits", step, min, max));
    }
    if (is_integer(op.field->kind) && step >= 9223372036854775808.0) {
        refuse(path, fmt::format("resolution {} is beyond 64-bit integers", step));
    }
    for (const double bound : {min, max}) {
        if (options.resolution && !(std::fabs(quantize(bound, step, 1.0 / step) - bound) < 1e-10)) {
            refuse(path, fmt::format("bound {} is no multiple of resolution {}", bound, step));
        }
    }
    return step;
}

Compiler::Bits Compiler::number(Op& op, const FieldOptions& options, const std::string& path) {
    const Kind kind = op.field->kind;
    op.kind = is_floating(kind) ? OpKind::floating : OpKind::integer;
    if (!options.min) refuse(path, "option min is missing");
    if (!options.max) refuse(path, "option max is missing");
    const double resolution = step(op, options, *options.min, *options.max, path);
    double lowest = std::numeric_limits<double>::lowest();
    if (kind == Kind::uint32 || kind == Kind::uint64) lowest = 0;
    if (kind == Kind::int32) lowest = -2147483648.0;
    if (kind == Kind::int64) lowest = -9223372036854775808.0;
    if (kind == Kind::float32) lowest = std::numeric_limits<float>::lowest();
    if (*options.min < lowest) refuse(path, fmt::format("min {} is beyond its type", *options.min));
    op.number = make_number_code(kind, *options.min, *options.max, resolution, op.required);
    return {op.number.width, op.number.width};
}

Compiler::Bits Compiler::enumeration(Op& op, const FieldOptions& options, int version,
                                     const std::string& path) {
    op.kind = OpKind::enumeration;
    EnumCode code;
    code.packed = version == 2 || options.packed_enum;
    const auto& values = op.field->enumeration->values;
    std::int32_t low = values.front().number;
    std::int32_t high = low;
    for (std::uint32_t k = 0; k < values.size(); ++k) {
        code.numbers.push_back(values[k].number);
        code.positions.emplace_back(values[k].number, k);
        low = std::min(low, values[k].number);
        high = std::max(high, values[k].number);
    }
    std::sort(code.positions.begin(), code.positions.end());
    const double min = code.packed ? 0 : low;
    const double max = code.packed ? static_cast<double>(values.size() - 1) : high;
    const double resolution = step(op, options, min, max, path);
    op.number = make_number_code(Kind::int32, min, max, resolution, op.required);
    op.extra = static_cast<std::uint32_t>(program_->enums_.size());
    program_->enums_.push_back(std::move(code));
    return {op.number.width, op.number.width};
}

Compiler::Bits Compiler::text(Op& op, const FieldOptions& options, const CodecChoice& codec,
                              const std::string& path) {
    op.kind = OpKind::text;
    if (!options.max_length) refuse(path, "option max_length is missing");
    const std::uint32_t longest = *options.max_length;
    if (longest > longest_text)
        refuse(path, fmt::format("max_length {} is above {}", longest, longest_text));
    op.max_length = longest;
    const std::uint64_t bits = std::uint64_t{longest} * 8;
    const bool variable = codec.family == Family::var_bytes || codec.version == 4;
    if (!variable && op.field->kind == Kind::bytes) {
        op.text_form = TextForm::fixed;
        op.presence_bit = !op.required;
        op.element_min_bits = bits;
        return op.required ? Bits{bits, bits} : Bits{1, bits + 1};
    }
    const bool byte_count = !variable && codec.version == 2;
    if (byte_count && longest > 255) {
        refuse(path,
               fmt::format("max_length {} is above 255, the most of codec version 2", longest));
    }
    op.length_width = byte_count ? 8 : static_cast<std::uint8_t>(bits_for(longest + 1.0));
    op.element_min_bits = op.length_width;
    op.empty_is_unset = !variable;
    op.presence_bit = variable && !op.required;
    return op.presence_bit ? Bits{1, 1 + op.length_width + bits}
                           : Bits{op.length_width, op.length_width + bits};
}

Compiler::Bits Compiler::time(Op& op, const FieldOptions& options, const std::string& path) {
    op.kind = OpKind::time;
    if (options.num_days < 1 || options.num_days > 1'000'000) {
        refuse(path, fmt::format("num_days {} is outside 1 to 1000000", options.num_days));
    }
    TimeCode code;
    const bool seconds = op.field->kind == Kind::float64;
    code.conversion = seconds ? 1 : 1e6;
    code.period_s = std::int64_t{86400} * options.num_days;
    FieldOptions wire = options;
    if (options.precision && !seconds) wire.precision = *options.precision + 6;
    const double period = static_cast<double>(code.period_s);
    const double resolution = step(op, wire, 0, period, path);
    const std::int32_t digits = options.precision.value_or(seconds ? 0 : -6);
    code.rounding = step_of_precision(digits);
    code.fine_rounding = resolution * code.conversion;
    op.number = make_number_code(Kind::float64, 0, period, resolution, op.required);
    op.extra = static_cast<std::uint32_t>(program_->times_.size());
    program_->times_.push_back(code);
    op.element_min_bits = op.number.width;
    return {op.number.width, op.number.width};
}

Compiler::Bits Compiler::fixed_value(Op& op, const FieldOptions& options, const std::string& path) {
    op.kind = OpKind::fixed_value;
    if (!options.static_value) refuse(path, "option static_value is missing");
    const std::string& text = *options.static_value;
    FixedValue fixed;
    bool good = true;
    const auto take = [&](auto& to, auto value) {
        good = value.has_value();
        if (good) to = static_cast<std::decay_t<decltype(to)>>(*value);
    };
    switch (op.field->kind) {
        case Kind::int32:
            take(fixed.value.i, extract<std::int32_t>(text));
            break;
        case Kind::int64:
            take(fixed.value.i, extract<std::int64_t>(text));
            break;
        case Kind::uint32:
            take(fixed.value.u, extract<std::uint32_t>(text));
            break;
        case Kind::uint64:
            take(fixed.value.u, extract<std::uint64_t>(text));
            break;
        case Kind::float32:
            take(fixed.value.d, extract<float>(text));
            break;
        case Kind::float64:
            take(fixed.value.d, extract<double>(text));
            break;
        default:
            take(fixed.text, extract<std::string>(text));
            break;
    }
    if (!good) refuse(path, fmt::format("static_value {} is no value of its type", quote(text)));
    op.extra = static_cast<std::uint32_t>(program_->fixed_.size());
    program_->fixed_.push_back(std::move(fixed));
    return {};
}

Compiler::Bits Compiler::hash(Op& op, const FieldOptions& options, const std::string& path) {
    op.kind = OpKind::hash;
    const double max = options.max.value_or(-1);
    const auto width = static_cast<std::uint8_t>(bits_for(max + 1));
    if (options.min.value_or(-1) != 0 || !(max >= 1 && max <= 4294967295.0) ||
        std::ldexp(1.0, width) - 1 != max) {
        refuse(path, "a hash needs min 0 and max 2^n - 1, at most 4294967295");
    }
    op.extra = static_cast<std::uint32_t>(program_->hashes_.size());
    program_->hashes_.push_back({0, width});
    op.element_min_bits = width;
    return {width, width};
}

Compiler::Bits Compiler::native(Op& op, const std::string&) {
    op.kind = OpKind::native;
    op.presence_bit = !op.required;
    const unsigned most = native_bits(*op.field);
    const bool fixed = op.field->wire_form == schema::WireForm::fixed32 ||
                       op.field->wire_form == schema::WireForm::fixed64;
    const unsigned least = fixed ? most : 8;
    op.element_min_bits = least;
    if (op.field->kind == Kind::enumeration) {
        EnumCode code;
        for (std::uint32_t k = 0; k < op.field->enumeration->values.size(); ++k) {
            code.numbers.push_back(op.field->enumeration->values[k].number);
            code.positions.emplace_back(code.numbers.back(), k);
        }
        std::sort(code.positions.begin(), code.positions.end());
        op.extra = static_cast<std::uint32_t>(program_->enums_.size());
        program_->enums_.push_back(std::move(code));
    }
    return op.presence_bit ? Bits{1, most + 1} : Bits{least, most};
}

Compiler::Bits Compiler::arithmetic(Op& op, const FieldOptions& options, const std::string& path) {
    op.kind = OpKind::arithmetic;
    if (!options.arithmetic_model) refuse(path, "option [arithmetic] { model } is missing");
    const auto model = options_.models.find(*options.arithmetic_model);
    if (model == options_.models.end()) {
        refuse(path,
               fmt::format("arithmetic model {} is not loaded", quote(*options.arithmetic_model)));
    }
    op.extra = static_cast<std::uint32_t>(program_->models_.size());
    program_->models_.push_back(std::make_shared<const entropy::Model>(model->second));
    const std::uint32_t most = op.repeated ? std::min(options.max_repeat.value_or(1), 65536U) : 1;
    return {entropy::min_bits(model->second, most), entropy::max_bits(model->second, most)};
}

Compiler::Bits Compiler::ccl(Op& op, const FieldOptions& options, const CodecChoice& codec,
                             const std::string& path) {
    op.kind = OpKind::ccl;
    op.ccl = codec.ccl;
    if (codec.ccl == CclCodec::depth) {
        if (!options.ccl_bit_size) refuse(path, "option [ccl] { bit_size } is missing");
        if (*options.ccl_bit_size < 1 || *options.ccl_bit_size > 32) {
            refuse(path, fmt::format("bit_size {} is outside 1 to 32", *options.ccl_bit_size));
        }
    }
    if (codec.ccl == CclCodec::speed) {
        if (!options.ccl_thrust_mode_tag)
            refuse(path, "option [ccl] { thrust_mode_tag } is missing");
        const auto tag = static_cast<std::int32_t>(*options.ccl_thrust_mode_tag);
        const std::int32_t index = layout_.find_number(tag);
        if (index < 0 ||
            layout_.fields[static_cast<std::size_t>(index)].kind != Kind::enumeration) {
            refuse(path, fmt::format("thrust_mode_tag {} is no enumeration of the message", tag));
        }
        op.extra = static_cast<std::uint32_t>(index);
    }
    if (codec.ccl == CclCodec::fix_age) {  // follows the rule of numbers: optional ones take a null
        op.number = make_number_code(Kind::uint32, 0, 255, 1, op.required);
        op.max_length = 8;
        op.element_min_bits = op.number.width;
        return {op.number.width, op.number.width};
    }
    op.max_length = ccl_bits(codec.ccl, options.ccl_bit_size.value_or(0));
    op.element_min_bits = op.max_length;
    return {op.max_length, op.max_length};
}

Compiler::Bits Compiler::custom(Op& op, const FieldOptions& options, const CodecChoice& codec,
                                const std::string& path) {
    op.kind = OpKind::custom;
    op.extra = static_cast<std::uint32_t>(program_->field_codecs_.size());
    program_->field_codecs_.push_back(options_.field_codecs.at(codec.name));
    try {
        const FieldCodec::Bounds bounds =
            program_->field_codecs_.back()->bounds(*op.field, options);
        op.element_min_bits = bounds.min;
        return {bounds.min, bounds.max};
    } catch (const ConfigError& e) {
        refuse(path, fmt::format("codec {}: {}", codec.name, e.what()));
    }
}

}  // namespace seautils::dccl
