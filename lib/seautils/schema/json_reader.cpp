#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/core/time.hpp"
#include "seautils/schema/json.hpp"

#include <fmt/format.h>
#include <simdjson.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace seautils::schema {

namespace {

namespace sj = simdjson::ondemand;

constexpr int max_depth = 32;

/// Reads one object into slots; knows where it is, for messages.
class Reader {
public:
    Reader(Values& values, Unknown unknown) : values_(values), unknown_(unknown) {}

    bool all_known() const { return all_known_; }

    void object(sj::object from, const Layout& layout, std::uint32_t block, int depth) {
        if (depth > max_depth) refuse("is nested deeper than 32 levels");
        std::uint32_t hint = 0;
        for (auto member : from) {
            const std::string_view key = member.unescaped_key();
            const std::int32_t index = layout.find(key, hint);
            if (index < 0) {
                if (depth == 1 && key.starts_with('@')) {
                    ignore(member.value());
                    continue;
                }
                if (unknown_ == Unknown::refuse) unknown(key, layout);
                all_known_ = false;
                continue;
            }
            hint = static_cast<std::uint32_t>(index) + 1;
            const Field& f = layout.fields[static_cast<std::size_t>(index)];
            steps_[depth_++] = {&f, -1};
            field(member.value(), layout, f, block, static_cast<std::uint32_t>(index), depth);
            --depth_;
        }
    }

    /// `leg[2].seq`, of the field that is being read.
    std::string path() const {
        std::string text;
        for (int k = 0; k < depth_; ++k) {
            if (k > 0) text += '.';
            text += steps_[k].field->name;
            if (steps_[k].element >= 0) text += fmt::format("[{}]", steps_[k].element);
        }
        return text;
    }

private:
    struct Step {
        const Field* field;
        std::int64_t element;
    };

    [[noreturn]] void refuse(const std::string& what) const {
        const std::string where = path();
        throw DataError(where.empty() ? "the object " + what : where + " " + what);
    }

    [[noreturn]] void unknown(std::string_view key, const Layout& layout) const {
        std::vector<std::string> names;
        for (const Field& f : layout.fields) names.push_back(f.name);
        const std::string near = nearest(key, names);
        const std::string where = path();
        throw DataError(
            fmt::format("field {} is not in message {}{}{}", quote(key), layout.full_name,
                        where.empty() ? "" : " (at " + where + ")",
                        near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
    }

    static void ignore(sj::value value) { value.raw_json_token(); }

    void field(sj::value value, const Layout& layout, const Field& f, std::uint32_t block,
               std::uint32_t index, int depth) {
        const std::uint32_t slot = block + index;
        if (value.is_null()) return;
        if (values_[slot].present) refuse("is given twice");
        if (f.oneof >= 0) {
            for (const std::uint32_t other :
                 layout.oneofs[static_cast<std::size_t>(f.oneof)].fields) {
                if (values_[block + other].present) {
                    refuse(fmt::format("and '{}' exclude each other (oneof)",
                                       layout.fields[other].name));
                }
            }
        }
        if (f.repeated) return list(value, f, slot, depth);
        scalar(value, f, slot, depth);
        if (!f.has_presence && is_default(f, values_[slot])) values_[slot].present = false;
    }

    void list(sj::value value, const Field& f, std::uint32_t slot, int depth) {
        if (value.type() != sj::json_type::array) refuse("is not an array");
        std::int64_t k = 0;
        for (auto element : value.get_array()) {
            steps_[depth_ - 1].element = k++;
            sj::value one = element.value();
            const std::uint32_t at = values_.append_element(slot);
            if (one.is_null()) {
                if (!f.nullable_elements) refuse("is null");
                continue;
            }
            scalar(one, f, at, depth);
            if (!values_[at].present) --values_[slot].aux;  // an enumerator that was skipped
        }
        if (values_[slot].aux == 0) values_[slot].present = false;
    }

    void scalar(sj::value value, const Field& f, std::uint32_t slot, int depth) {
        switch (f.kind) {
            case Kind::boolean:
                set_i(slot, boolean(value));
                return;
            case Kind::int32:
                set_i(slot, integer(value, std::numeric_limits<std::int32_t>::min(),
                                    std::numeric_limits<std::int32_t>::max()));
                return;
            case Kind::int64:
                set_i(slot, integer(value, std::numeric_limits<std::int64_t>::min(),
                                    std::numeric_limits<std::int64_t>::max()));
                return;
            case Kind::uint32:
                set_u(slot, natural(value, std::numeric_limits<std::uint32_t>::max()));
                return;
            case Kind::uint64:
                set_u(slot, natural(value, std::numeric_limits<std::uint64_t>::max()));
                return;
            case Kind::float32:
                set_d(slot, float32(floating(value)));
                return;
            case Kind::float64:
                set_d(slot, floating(value));
                return;
            case Kind::string:
                values_.set_text(slot, string(value));
                return;
            case Kind::bytes:
                return bytes(value, slot);
            case Kind::enumeration:
                if (const auto number = enumerator(value, f)) set_i(slot, *number);
                return;
            case Kind::message: {
                if (f.message->timestamp && value.type() == sj::json_type::string)
                    return timestamp(value, f, slot);
                if (value.type() != sj::json_type::object) refuse("is not an object");
                const std::uint32_t block = values_.add_block(slot, *f.message);
                return object(value.get_object(), *f.message, block, depth + 1);
            }
        }
    }

    void set_i(std::uint32_t slot, std::int64_t x) {
        values_[slot].i = x;
        values_[slot].present = true;
    }
    void set_u(std::uint32_t slot, std::uint64_t x) {
        values_[slot].u = x;
        values_[slot].present = true;
    }
    void set_d(std::uint32_t slot, double x) {
        values_[slot].d = x;
        values_[slot].present = true;
    }

    /// The token as it stands, for messages and for what simdjson's numbers do not hold.
    static std::string_view token(sj::value& value) {
        std::string_view text = value.raw_json_token();
        while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r' ||
                                 text.back() == '\n'))
            text.remove_suffix(1);
        return text;
    }

    std::string_view string(sj::value& value) {
        if (value.type() != sj::json_type::string)
            refuse(fmt::format("{} is not a string", shown(value)));
        return value.get_string();
    }

    std::string shown(sj::value& value) {
        const sj::json_type type = value.type();
        if (type == sj::json_type::object) return "an object";
        if (type == sj::json_type::array) return "an array";
        return quote(token(value));
    }

    bool boolean(sj::value& value) {
        if (value.type() == sj::json_type::string) {
            const std::string_view text = value.get_string();
            if (text == "true" || text == "false") return text == "true";
            refuse(fmt::format("{} is neither true nor false", quote(text)));
        }
        if (value.type() != sj::json_type::boolean)
            refuse(fmt::format("{} is neither true nor false", shown(value)));
        return value.get_bool();
    }

    /// A whole number that the text states, in whatever notation.
    template <class T>
    T whole(std::string_view text, T min, T max, bool plain_only) {
        T x = 0;
        const char* end = text.data() + text.size();
        const auto [at, error] = std::from_chars(text.data(), end, x);
        if (error == std::errc() && at == end && x >= min && x <= max) return x;
        if (error == std::errc::result_out_of_range || (error == std::errc() && at == end)) {
            refuse(fmt::format("{} is outside {} to {}", quote(text), min, max));
        }
        double d = 0;
        const auto [d_at, d_error] = std::from_chars(text.data(), end, d);
        if (plain_only || d_error != std::errc() || d_at != end)
            refuse(fmt::format("{} is not a whole number", quote(text)));
        if (d != std::trunc(d)) refuse(fmt::format("{} is not a whole number", quote(text)));
        if (!(d >= static_cast<double>(min) && d <= static_cast<double>(max)) ||
            d >= 18446744073709551616.0 || (std::is_signed_v<T> && d >= 9223372036854775808.0)) {
            refuse(fmt::format("{} is outside {} to {}", quote(text), min, max));
        }
        return static_cast<T>(d);
    }

    std::int64_t integer(sj::value& value, std::int64_t min, std::int64_t max) {
        if (value.type() == sj::json_type::string)
            return whole<std::int64_t>(value.get_string(), min, max, true);
        if (value.type() != sj::json_type::number)
            refuse(fmt::format("{} is not a number", shown(value)));
        std::int64_t x = 0;
        if (value.get_int64().get(x) == simdjson::SUCCESS && x >= min && x <= max) return x;
        return whole<std::int64_t>(number_token(value), min, max, false);
    }

    std::uint64_t natural(sj::value& value, std::uint64_t max) {
        if (value.type() == sj::json_type::string)
            return whole<std::uint64_t>(value.get_string(), 0, max, true);
        if (value.type() != sj::json_type::number)
            refuse(fmt::format("{} is not a number", shown(value)));
        std::uint64_t x = 0;
        if (value.get_uint64().get(x) == simdjson::SUCCESS && x <= max) return x;
        const std::string_view text = number_token(value);
        const bool zero =
            text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == text.npos;
        if (text.starts_with('-') && !zero)
            refuse(fmt::format("{} is outside 0 to {}", quote(text), max));
        return zero ? 0 : whole<std::uint64_t>(text, 0, max, false);
    }

    /// The token of a number, which simdjson could not read as the integer wanted.
    std::string_view number_token(sj::value& value) {
        const std::string_view text = token(value);
        static const char* digits = "0123456789";
        std::string_view rest = text;
        if (rest.starts_with('-')) rest.remove_prefix(1);
        const std::size_t whole_digits = std::min(rest.find_first_not_of(digits), rest.size());
        bool good = whole_digits == 1 || (whole_digits > 1 && rest[0] != '0');
        rest.remove_prefix(whole_digits);
        if (rest.starts_with('.')) {
            const std::size_t n = std::min(rest.find_first_not_of(digits, 1), rest.size());
            good = good && n > 1;
            rest.remove_prefix(n);
        }
        if (rest.starts_with('e') || rest.starts_with('E')) {
            rest.remove_prefix(1);
            if (rest.starts_with('+') || rest.starts_with('-')) rest.remove_prefix(1);
            good =
                good && !rest.empty() && rest.find_first_not_of(digits) == std::string_view::npos;
            rest = {};
        }
        if (!good || !rest.empty()) refuse(fmt::format("{} is not a number", quote(text)));
        return text;
    }

    double floating(sj::value& value) {
        if (value.type() == sj::json_type::string) {
            const std::string_view text = value.get_string();
            if (text == "NaN") return std::numeric_limits<double>::quiet_NaN();
            if (text == "Infinity") return std::numeric_limits<double>::infinity();
            if (text == "-Infinity") return -std::numeric_limits<double>::infinity();
            double x = 0;
            const char* end = text.data() + text.size();
            const auto [at, error] = std::from_chars(text.data(), end, x);
            const bool word =
                text.find_first_of("nNiI") != text.npos;  // inf, nan in other spellings
            if (error == std::errc::result_out_of_range && at == end)
                refuse(fmt::format("{} is beyond the range of its type", quote(text)));
            if (error != std::errc() || at != end || word)
                refuse(fmt::format("{} is not a number", quote(text)));
            return x;
        }
        if (value.type() != sj::json_type::number)
            refuse(fmt::format("{} is not a number", shown(value)));
        double x = 0;
        // simdjson 3.0.1 takes 0.123… of more than 19 digits for another number.
        const bool is_short = value.raw_json_token().size() <= 20;
        if (is_short && value.get_double().get(x) == simdjson::SUCCESS) return x;
        const std::string_view text = number_token(value);
        const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), x);
        if (error != std::errc())
            refuse(fmt::format("{} is beyond the range of its type", quote(text)));
        return x;
    }

    double float32(double x) {
        // From half a step above the largest binary32 on, a number rounds to infinity.
        if (std::isfinite(x) && std::fabs(x) >= 0x1.ffffffp127)
            refuse(fmt::format("{} is beyond the range of a float", x));
        return static_cast<double>(static_cast<float>(x));
    }

    void bytes(sj::value& value, std::uint32_t slot) {
        const std::string_view text = string(value);
        try {
            values_.set_text(slot, from_base64(text));
        } catch (const DataError&) {
            refuse(fmt::format("{} is not base64", quote(text)));
        }
    }

    void timestamp(sj::value& value, const Field& f, std::uint32_t slot) {
        UtcInstant instant;
        try {
            instant = parse_instant(value.get_string());
        } catch (const DataError& e) {
            refuse(std::string("is no time: ") + e.what());
        }
        const std::uint32_t block = values_.add_block(slot, *f.message);
        if (instant.seconds != 0) set_i(block, instant.seconds);
        if (instant.nanoseconds != 0) set_i(block + 1, instant.nanoseconds);
    }

    /// Nothing: it is not declared, and that is no fault here.
    std::optional<std::int64_t> enumerator(sj::value& value, const Field& f) {
        if (value.type() == sj::json_type::number)
            return number_of(integer(value, std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max()),
                             f);
        const std::string_view text = string(value);
        if (const EnumLayout::Value* v = f.enumeration->find(text)) return v->number;
        std::int32_t number = 0;
        const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && at == text.data() + text.size()) return number_of(number, f);
        if (skip_unknown()) return std::nullopt;
        std::vector<std::string> names;
        for (const EnumLayout::Value& v : f.enumeration->values) names.push_back(v.name);
        const std::string near = nearest(text, names);
        refuse(fmt::format("{} is not in enum {}{}", quote(text), f.enumeration->full_name,
                           near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
    }

    bool skip_unknown() {
        if (unknown_ == Unknown::refuse) return false;
        all_known_ = false;
        return true;
    }

    std::optional<std::int64_t> number_of(std::int64_t number, const Field& f) {
        if (!f.enumeration->open &&
            f.enumeration->find(static_cast<std::int32_t>(number)) == nullptr) {
            if (skip_unknown()) return std::nullopt;
            refuse(fmt::format("{} is not in enum {}", number, f.enumeration->full_name));
        }
        return number;
    }

    Values& values_;
    Unknown unknown_;
    bool all_known_ = true;
    Step steps_[max_depth + 1] = {};
    int depth_ = 0;
};

/// What simdjson found, in words that speak of the record.
const char* fault(simdjson::error_code code) {
    switch (code) {
        case simdjson::EMPTY:
            return "there is nothing but white space";
        case simdjson::UTF8_ERROR:
            return "it is not UTF-8";
        case simdjson::UNCLOSED_STRING:
            return "a string does not end";
        case simdjson::STRING_ERROR:
            return "a string holds an escape that is none";
        case simdjson::UNESCAPED_CHARS:
            return "a string holds a control character";
        case simdjson::NUMBER_ERROR:
            return "a number is not well formed";
        case simdjson::INCOMPLETE_ARRAY_OR_OBJECT:
            return "the last bracket is missing, or something follows it";
        default:
            return "a bracket, colon, comma or value is missing, or stands where none may";
    }
}

}  // namespace

struct JsonReader::Impl {
    sj::parser parser;
    std::string padded;

    sj::document open(std::string_view json) {
        if (json.find('\0') != json.npos) throw DataError("a NUL byte is not JSON");
        if (json.starts_with("\xEF\xBB\xBF"))
            throw DataError("the record begins with a byte order mark");
        padded.assign(json);
        padded.append(simdjson::SIMDJSON_PADDING, '\0');
        const simdjson::padded_string_view view(padded.data(), json.size(), padded.size());
        return parser.iterate(view);
    }

    [[noreturn]] void refuse(const simdjson::simdjson_error& error, const std::string& path) const {
        throw DataError("not valid JSON" + (path.empty() ? "" : " at " + path) + ": " +
                        fault(error.error()));
    }
};

JsonReader::JsonReader() : impl_(std::make_unique<Impl>()) {}
JsonReader::~JsonReader() = default;
JsonReader::JsonReader(JsonReader&&) noexcept = default;
JsonReader& JsonReader::operator=(JsonReader&&) noexcept = default;

std::string JsonReader::type_of(std::string_view json) {
    try {
        sj::document document = impl_->open(json);
        std::string_view type;
        sj::value value;
        if (document.type() != sj::json_type::object)
            throw DataError("the record is not a JSON object");
        const auto error = document.get_object().find_field_unordered("@type").get(value);
        if (error == simdjson::NO_SUCH_FIELD) return {};
        if (error != simdjson::SUCCESS) throw simdjson::simdjson_error(error);
        if (value.get(type) != simdjson::SUCCESS) throw DataError("@type is not a string");
        return std::string(type.substr(type.rfind('/') + 1));
    } catch (const simdjson::simdjson_error& error) {
        impl_->refuse(error, {});
    }
}

bool JsonReader::read(std::string_view json, const Layout& layout, Values& values,
                      Unknown unknown) {
    values.reset(layout);
    Reader reader(values, unknown);
    try {
        sj::document document = impl_->open(json);
        if (document.type() != sj::json_type::object)
            throw DataError("the record is not a JSON object");
        reader.object(document.get_object(), layout, 0, 1);
        const char* rest = nullptr;
        if (document.current_location().get(rest) == simdjson::SUCCESS) {
            throw DataError("something follows the JSON object");
        }
        return reader.all_known();
    } catch (const simdjson::simdjson_error& error) {
        impl_->refuse(error, reader.path());
    }
}

}  // namespace seautils::schema
