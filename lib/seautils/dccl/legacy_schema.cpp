#include "seautils/dccl/legacy_schema.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace seautils::dccl {

namespace {

constexpr std::size_t max_file_bytes = 1U << 20;
constexpr std::uint32_t max_message_bytes = 65536;
constexpr std::size_t max_fields = 10'000;
constexpr std::uint64_t header_bytes = 6;

constexpr std::array<double, 13> tens = {1,   1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                         1e7, 1e8, 1e9, 1e10, 1e11, 1e12};

/// What every decimal number of a schema is after scaling: whole, but for what rounding it twice,
/// to a double and in scaling, can make.
double snapped(double x) {
    const double whole = std::nearbyint(x);
    const double rounding = std::numeric_limits<double>::epsilon() * std::fabs(x);
    return std::fabs(x - whole) <= std::max(1e-6, rounding) ? whole : x;
}

double times_ten(double x, int power) {
    return power >= 0 ? x * tens[static_cast<std::size_t>(power)]
                      : x / tens[static_cast<std::size_t>(-power)];
}

/// ⌈log2(codes)⌉, for codes in [2, 2^53].
unsigned bits_for(double codes) {
    return static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(std::ceil(codes)) - 1));
}

}  // namespace

std::uint64_t LegacyField::bits() const {
    return width + std::uint64_t{array_length - 1} * delta_width;
}
double LegacyField::scaled(double x) const { return std::nearbyint(times_ten(x, precision)); }
double LegacyField::unscaled(double steps) const {
    return times_ten(std::nearbyint(steps) + 0.0, -precision);  // + 0.0: no -0
}
double LegacyField::bound_scaled(double x) const { return snapped(times_ten(x, precision)); }

std::uint32_t LegacyMessage::array_length(std::string_view name) const {
    for (const LegacyField& f : fields_) {
        if (f.name == name) return f.array_length;
    }
    return 1;
}

/// Reads one file after another into a LegacySchema.
class LegacyLoader {
public:
    LegacyLoader(LegacySchema& schema, schema::LayoutSet& layouts)
        : schema_(schema), layouts_(layouts) {}

    void file(const std::string& name, std::string_view xml);

private:
    using Node = pugi::xml_node;

    void message(const Node& node);
    void header(const Node& node, schema::Layout& layout);
    LegacyField field(const Node& node);
    void number(const Node& node, LegacyField& field);
    void widths(const Node& node, LegacyField& field);
    void repeat(const Node& node, LegacyMessage& message);
    void finish(const Node& node, LegacyMessage& message, schema::Layout layout);
    void unique(const Node& node, const LegacyMessage& message);
    void ignore(const Node& node);

    std::string required(const Node& node, const char* tag) const;
    double real(const Node& node, const char* tag) const;
    std::uint32_t whole(const Node& node, const char* tag, std::uint32_t least,
                        std::uint32_t most) const;
    std::size_t line(std::ptrdiff_t offset) const;
    void check_text(const Node& node, const std::string& text) const;
    [[noreturn]] void refuse(const Node& node, const std::string& what) const;

    LegacySchema& schema_;
    schema::LayoutSet& layouts_;
    std::string name_;
    std::string_view xml_;
};

std::size_t LegacyLoader::line(std::ptrdiff_t offset) const {
    const auto end = std::min<std::size_t>(
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), xml_.size());
    return 1 + static_cast<std::size_t>(
                   std::count(xml_.begin(), xml_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
}

void LegacyLoader::refuse(const Node& node, const std::string& what) const {
    throw ConfigError(fmt::format("{}:{}: {}", name_, line(node.offset_debug()), what));
}

std::string LegacyLoader::required(const Node& node, const char* tag) const {
    const Node child = node.child(tag);
    if (!child) refuse(node, fmt::format("<{}> has no <{}>", node.name(), tag));
    std::string text = child.text().get();
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
    while (!text.empty() && blank(text.back())) text.pop_back();
    text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), blank));
    if (text.empty()) refuse(child, fmt::format("<{}> is empty", tag));
    check_text(child, text);
    return text;
}

/// References to characters (&#1;) can say what is no text.
void LegacyLoader::check_text(const Node& node, const std::string& text) const {
    if (printable(text) == text) return;
    refuse(node, fmt::format("<{}> {} has characters that are none", node.name(), quote(text)));
}

double LegacyLoader::real(const Node& node, const char* tag) const {
    const std::string text = required(node, tag);
    const char* first = text.data() + (text.front() == '+' ? 1 : 0);
    const char* last = text.data() + text.size();
    double x = 0;
    const auto [end, fault] = std::from_chars(first, last, x);
    if (fault != std::errc() || end != last || !std::isfinite(x)) {
        refuse(node.child(tag), fmt::format("<{}> {} is not a number", tag, quote(text)));
    }
    return x;
}

std::uint32_t LegacyLoader::whole(const Node& node, const char* tag, std::uint32_t least,
                                  std::uint32_t most) const {
    const double x = real(node, tag);
    if (x != std::floor(x) || x < least || x > most) {
        refuse(node.child(tag),
               fmt::format("<{}> {} is not a whole number from {} to {}", tag, x, least, most));
    }
    return static_cast<std::uint32_t>(x);
}

void LegacyLoader::ignore(const Node& node) {
    if (node.type() != pugi::node_element) return;
    auto& tags = schema_.ignored_tags;
    if (std::find(tags.begin(), tags.end(), node.name()) == tags.end())
        tags.emplace_back(node.name());
}

void LegacyLoader::file(const std::string& name, std::string_view xml) {
    name_ = name;
    xml_ = xml;
    if (xml.size() > max_file_bytes) throw ConfigError(name + ": longer than 1 MiB");
    pugi::xml_document document;
    const auto result = document.load_buffer(xml.data(), xml.size());
    if (!result) {
        throw ConfigError(fmt::format("{}:{}: not well-formed XML", name, line(result.offset)));
    }
    if (result.encoding == pugi::encoding_utf8 && !is_valid_utf8(xml)) {
        throw ConfigError(name + ": not UTF-8 (say encoding=\"ISO-8859-1\" in its first line?)");
    }
    const Node root = document.child("message_set");
    if (!root) throw ConfigError(name + ":1: the root is not <message_set>");
    for (const Node& node : root.children()) {
        if (std::string_view(node.name()) == "message")
            message(node);
        else
            ignore(node);
    }
}

/// A part of the header as a field of the layout.
schema::Field part(const char* name, schema::Kind kind) {
    schema::Field f;
    f.name = f.json_name = name;
    f.kind = kind;
    return f;
}

void LegacyLoader::header(const Node& node, schema::Layout& layout) {
    using schema::Kind;
    layout.fields = {
        part("_time", Kind::float64),           part("_src_id", Kind::uint32),
        part("_dest_id", Kind::uint32),         part("_multimessage_flag", Kind::boolean),
        part("_broadcast_flag", Kind::boolean), part("_unused", Kind::uint32),
        part("_ccl_id", Kind::uint32),          part("_id", Kind::uint32)};
    for (const Node& child : node.child("header").children()) {
        const std::string tag = child.name();
        const auto found =
            std::find_if(layout.fields.begin(), layout.fields.end(),
                         [&](const schema::Field& f) { return f.json_name == "_" + tag; });
        if (found == layout.fields.end()) {
            ignore(child);
            continue;
        }
        if (child.child("name")) found->name = required(child, "name");
        for (const Node& below : child.children()) {
            if (std::string_view(below.name()) != "name") ignore(below);
        }
    }
    for (schema::Field& f : layout.fields) f.json_name = f.name;
}

constexpr std::array<const char*, 7> field_tags = {"bool", "int", "float", "string",
                                                   "enum", "hex", "static"};
constexpr std::array<const char*, 9> meant_tags = {"name",       "max",       "min",
                                                   "precision",  "max_delta", "array_length",
                                                   "max_length", "num_bytes", "value"};

void LegacyLoader::number(const Node& node, LegacyField& f) {
    f.kind = LegacyKind::number;
    f.max = real(node, "max");
    f.min = node.child("min") ? real(node, "min") : 0;
    if (f.max < f.min) std::swap(f.min, f.max);
    if (std::string_view(node.name()) == "float" && node.child("precision")) {
        const double p = real(node, "precision");
        if (p != std::floor(p) || std::fabs(p) > 12) {
            refuse(node.child("precision"),
                   fmt::format("<precision> {} is not a whole number from -12 to 12", p));
        }
        f.precision = static_cast<int>(p);
    }
    if (node.child("max_delta")) f.max_delta = std::fabs(real(node, "max_delta"));
    // Scaling rounds twice: by less than half a step so far.
    const int most = f.precision == 0 ? 53 : 51;
    const double farthest = std::max(std::fabs(f.min), std::fabs(f.max)) + f.max_delta;
    if (!(times_ten(farthest, f.precision) <= std::ldexp(1.0, most))) {
        refuse(node, fmt::format("field {} goes beyond 2^{} steps of 10^{}", quote(f.name), most,
                                 -f.precision));
    }
}

void LegacyLoader::widths(const Node& node, LegacyField& f) {
    const auto width = [&](double range) {
        // Beyond 2^53 a double cannot tell a field's values apart.
        if (range > 0x1p53 - 2)
            refuse(node, fmt::format("field {} has more than 2^53 values", quote(f.name)));
        return bits_for(range + 2);
    };
    switch (f.kind) {
        case LegacyKind::boolean:
            f.width = 2;
            break;
        case LegacyKind::number:
            f.width = width(f.key_span());
            break;
        case LegacyKind::enumeration:
            f.width = bits_for(static_cast<double>(f.values.size()) + 1);
            break;
        case LegacyKind::string:
        case LegacyKind::hex:
            f.width = 8 * f.max_length;
            break;
        case LegacyKind::fixed:
            f.width = 0;
            break;
    }
    f.delta_width = f.max_delta > 0 ? width(f.delta_span()) : f.width;
}

LegacyField LegacyLoader::field(const Node& node) {
    const std::string_view tag = node.name();
    LegacyField f;
    f.name = required(node, "name");
    if (tag == "bool") f.kind = LegacyKind::boolean;
    if (tag == "int" || tag == "float") number(node, f);
    if (tag == "string") {
        f.kind = LegacyKind::string;
        f.max_length = whole(node, "max_length", 1, max_message_bytes);
    }
    if (tag == "hex") {
        f.kind = LegacyKind::hex;
        f.max_length = whole(node, "num_bytes", 1, max_message_bytes);
    }
    if (tag == "enum" || tag == "static") {
        f.kind = tag == "enum" ? LegacyKind::enumeration : LegacyKind::fixed;
        required(node, "value");
        for (const Node& value : node.children("value")) {
            check_text(value, f.values.emplace_back(value.text().get()));
        }
        const std::set<std::string> different(f.values.begin(), f.values.end());
        if (different.size() != f.values.size())
            refuse(node, fmt::format("field {} has a <value> twice", quote(f.name)));
        if (tag == "static" && f.values.size() > 1)
            refuse(node, fmt::format("field {} has more than one <value>", quote(f.name)));
    }
    if (node.child("array_length") && f.kind != LegacyKind::fixed) {
        f.array_length = whole(node, "array_length", 1, max_message_bytes);
    }
    for (const Node& child : node.children()) {
        const auto known = [&](const char* meant) { return std::strcmp(meant, child.name()) == 0; };
        if (std::none_of(meant_tags.begin(), meant_tags.end(), known)) ignore(child);
    }
    widths(node, f);
    return f;
}

void LegacyLoader::repeat(const Node& node, LegacyMessage& m) {
    std::uint64_t first = 0;
    std::uint64_t more = 0;
    for (const LegacyField& f : m.fields_) {
        if (f.array_length > 1)
            refuse(node,
                   fmt::format("field {} is an array in a message that repeats", quote(f.name)));
        first += f.width;
        more += f.delta_width;
    }
    const std::uint64_t room = m.max_bytes_ > header_bytes ? (m.max_bytes_ - header_bytes) * 8 : 0;
    if (more == 0 || first > room) return;
    const std::uint64_t length = 1 + (room - first) / more;
    for (LegacyField& f : m.fields_) {
        if (f.kind != LegacyKind::fixed) f.array_length = static_cast<std::uint32_t>(length);
    }
}

/// A field of the body as a field of the layout.
schema::Field shown(const LegacyField& f) {
    using schema::Kind;
    schema::Field field;
    field.name = field.json_name = f.name;
    field.kind = f.kind == LegacyKind::boolean  ? Kind::boolean
                 : f.kind == LegacyKind::number ? Kind::float64
                                                : Kind::string;
    field.repeated = field.nullable_elements = f.array_length > 1;
    return field;
}

void LegacyLoader::finish(const Node& node, LegacyMessage& m, schema::Layout layout) {
    for (const LegacyField& f : m.fields_) {
        m.body_bits_ += f.bits();
        layout.fields.push_back(shown(f));
    }
    if (m.largest_bytes() > m.max_bytes_) {
        refuse(node, fmt::format("message {} takes up to {} bytes, more than its <size> of {}",
                                 quote(m.name_), m.largest_bytes(), m.max_bytes_));
    }
    std::set<std::string> names;
    for (schema::Field& f : layout.fields) {
        if (!names.insert(f.name).second) {
            refuse(node, fmt::format("message {} has two fields named {}", quote(m.name_),
                                     quote(f.name)));
        }
        f.number = static_cast<std::int32_t>(names.size());
    }
    layout.full_name = m.name_;
    m.layout_ = &layouts_.add(std::move(layout));
}

void LegacyLoader::unique(const Node& node, const LegacyMessage& m) {
    for (const LegacyMessage& other : schema_.messages) {
        if (other.name_ == m.name_)
            refuse(node, fmt::format("message {} is defined twice", quote(m.name_)));
        if (other.id_ == m.id_) {
            refuse(node, fmt::format("id {} is both message {} and message {}", m.id_, other.name_,
                                     m.name_));
        }
    }
}

void LegacyLoader::message(const Node& node) {
    LegacyMessage m;
    m.name_ = required(node, "name");
    m.id_ = whole(node, "id", 0, 511);
    m.max_bytes_ = whole(node, "size", 1, max_message_bytes);
    unique(node, m);
    schema::Layout layout;
    header(node, layout);
    const Node body = node.child("layout");
    if (!body) refuse(node, fmt::format("message {} has no <layout>", quote(m.name_)));
    for (const Node& child : body.children()) {
        if (child.type() != pugi::node_element) continue;
        const auto is_tag = [&](const char* tag) { return std::strcmp(tag, child.name()) == 0; };
        if (std::none_of(field_tags.begin(), field_tags.end(), is_tag)) {
            refuse(child,
                   fmt::format(
                       "field type <{}> is none of bool, int, float, string, enum, hex, static",
                       child.name()));
        }
        m.fields_.push_back(field(child));
        if (m.fields_.size() > max_fields)
            refuse(child, fmt::format("more than {} fields", max_fields));
    }
    if (node.child("repeat")) repeat(node, m);
    for (const Node& child : node.children()) {
        const std::string_view tag = child.name();
        const bool meant = tag == "name" || tag == "id" || tag == "size" || tag == "repeat" ||
                           tag == "header" || tag == "layout";
        if (!meant) ignore(child);
    }
    finish(node, m, std::move(layout));
    schema_.messages.push_back(std::move(m));
}

namespace {

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(ExitCode::no_input, file + ": " + std::strerror(errno));
    std::string text;
    text.resize(max_file_bytes + 1);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

}  // namespace

LegacySchema load_legacy(const std::vector<std::string>& files, schema::LayoutSet& layouts) {
    LegacySchema schema;
    LegacyLoader loader(schema, layouts);
    for (const std::string& file : files) loader.file(file, text_of(file));
    if (schema.messages.empty()) throw ConfigError(files.front() + ": no <message> in it");
    return schema;
}

LegacySchema parse_legacy(const std::string& file, std::string_view xml,
                          schema::LayoutSet& layouts) {
    LegacySchema schema;
    LegacyLoader(schema, layouts).file(file, xml);
    return schema;
}

}  // namespace seautils::dccl
