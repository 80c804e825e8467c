// DCCL 1 against a model of it: fields counted in whole steps, the body one long row of bits.
#include "dccl_bench.hpp"
#include "dccl_random.hpp"
#include "seautils/dccl/legacy_codec.hpp"
#include "seautils/schema/json.hpp"

#include <nlohmann/json.hpp>

namespace seautils::dccl {
namespace {

using nlohmann::json;
using reference::Dice;

enum class Kind { boolean, integer, real, string, enumeration, hex };

struct Field {
    Kind kind = Kind::boolean;
    std::string name;
    std::int64_t min = 0, max = 0, delta = 0;  ///< in steps of 10^-precision
    int precision = 0;
    unsigned length = 1;  ///< of the array
    unsigned most = 1;    ///< characters, bytes, enumerators
};

/// k steps of 10^-precision, written out in digits.
std::string decimal(std::int64_t k, int precision) {
    if (precision <= 0)
        return std::to_string(k) +
               (k == 0 ? "" : std::string(static_cast<std::size_t>(-precision), '0'));
    std::string digits = std::to_string(k < 0 ? -k : k);
    const auto p = static_cast<std::size_t>(precision);
    if (digits.size() <= p) digits.insert(0, p + 1 - digits.size(), '0');
    digits.insert(digits.size() - p, ".");
    return (k < 0 ? "-" : "") + digits;
}

/// The fewest bits that have so many codes.
unsigned bits_of(std::int64_t codes) {
    unsigned bits = 0;
    while ((std::int64_t{1} << bits) < codes) ++bits;
    return bits;
}

class LegacyPair {
public:
    explicit LegacyPair(std::uint64_t seed) : dice_(seed) {
        const int count = 1 + dice_.below(6);
        repeat_ = dice_.one_in(4);
        for (int k = 0; k < count; ++k) fields_.push_back(field(k));
        size_ = 6 + dice_.below(200);
        if (repeat_) stretch();
        xml_ = xml();
    }

    void check() {
        schema::LayoutSet layouts;
        LegacySchema schema;
        try {
            schema = parse_legacy("m.xml", xml_, layouts);
        } catch (const ConfigError& e) {
            EXPECT_GT(6 + (bits() + 7) / 8, static_cast<std::uint64_t>(size_)) << e.what() << xml_;
            return;
        }
        const LegacyMessage& m = schema.messages.front();
        ASSERT_LE(6 + (bits() + 7) / 8, static_cast<std::uint64_t>(size_)) << xml_;
        ASSERT_EQ(m.body_bits(), bits()) << xml_;
        for (int k = 0; k < 5; ++k) one(m);
    }

    int messages = 0;

private:
    Field field(int index) {
        Field f;
        f.kind = static_cast<Kind>(dice_.below(6));
        f.name = "f" + std::to_string(index);
        f.most = static_cast<unsigned>(1 + dice_.below(6));
        if (f.kind == Kind::real) f.precision = dice_.below(6) - 2;
        if (f.kind == Kind::integer || f.kind == Kind::real) {
            f.min = dice_.between(-3000, 3000);
            f.max = f.min + dice_.between(0, std::int64_t{1} << dice_.below(20));
            if (dice_.one_in(3)) f.delta = dice_.between(1, 70);
        }
        if (!repeat_ && dice_.one_in(3)) f.length = static_cast<unsigned>(1 + dice_.below(5));
        return f;
    }

    static unsigned width(const Field& f) {
        switch (f.kind) {
            case Kind::boolean:
                return 2;
            case Kind::string:
            case Kind::hex:
                return 8 * f.most;
            case Kind::enumeration:
                return bits_of(f.most + 1);
            default:
                return bits_of(f.max - f.min + 2);
        }
    }
    static unsigned other_width(const Field& f) {
        return f.delta > 0 ? bits_of(2 * f.delta + 2) : width(f);
    }

    std::uint64_t bits() const {
        std::uint64_t sum = 0;
        for (const Field& f : fields_)
            sum += width(f) + (f.length - 1) * std::uint64_t{other_width(f)};
        return sum;
    }

    /// <repeat/>: as long as all arrays fit.
    void stretch() {
        const std::uint64_t room = static_cast<std::uint64_t>(size_ - 6) * 8;
        while (bits() <= room) {
            for (Field& f : fields_) ++f.length;
        }
        if (fields_.front().length > 1) {
            for (Field& f : fields_) --f.length;
        }
    }

    std::string xml() const {
        static const char* const tags[] = {"bool", "int", "float", "string", "enum", "hex"};
        std::string out = "<message_set><message><name>M</name><id>300</id><size>" +
                          std::to_string(size_) + "</size>" + (repeat_ ? "<repeat/>" : "") +
                          "<layout>";
        for (const Field& f : fields_) {
            const auto tag = [&](const char* name, const std::string& value) {
                out += std::string("<") + name + ">" + value + "</" + name + ">";
            };
            out += std::string("<") + tags[static_cast<int>(f.kind)] + ">";
            tag("name", f.name);
            if (f.kind == Kind::integer || f.kind == Kind::real) {
                tag("max", decimal(f.max, f.precision));
                tag("min", decimal(f.min, f.precision));
                if (f.precision != 0) tag("precision", std::to_string(f.precision));
                if (f.delta > 0) tag("max_delta", decimal(f.delta, f.precision));
            }
            if (f.kind == Kind::string) tag("max_length", std::to_string(f.most));
            if (f.kind == Kind::hex) tag("num_bytes", std::to_string(f.most));
            for (unsigned k = 0; f.kind == Kind::enumeration && k < f.most; ++k)
                tag("value", "E" + std::to_string(k));
            if (!repeat_ && f.length > 1) tag("array_length", std::to_string(f.length));
            out += std::string("</") + tags[static_cast<int>(f.kind)] + ">";
        }
        return out + "</layout></message></message_set>";
    }

    /// Appends to the row of bits, the most significant first.
    void put(std::uint64_t x, unsigned count) {
        for (unsigned k = count; k-- > 0;) row_.push_back((x >> k & 1) != 0);
    }

    /// Puts an element's code into bits; its value as JSON, null where it is not given.
    std::string element(const Field& f, bool given, bool is_key) {
        const unsigned count = is_key ? width(f) : other_width(f);
        if (!given) {
            put(0, count % 64);
            for (unsigned k = count % 64; k < count; ++k) row_.push_back(false);
            return "null";
        }
        if (f.kind == Kind::boolean) {
            const bool on = dice_.one_in(2);
            put(on ? 2 : 1, 2);
            return on ? "true" : "false";
        }
        if (f.kind == Kind::enumeration) {
            const auto k = static_cast<unsigned>(dice_.below(static_cast<int>(f.most)));
            put(k + 1, count);
            return "\"E" + std::to_string(k) + "\"";
        }
        if (f.kind == Kind::string || f.kind == Kind::hex) return text(f);
        const bool delta = f.delta > 0 && !is_key;
        const std::int64_t low = delta ? key_ - f.delta : f.min;
        const std::int64_t k =
            is_key && f.delta > 0 ? key_ : dice_.between(low, delta ? key_ + f.delta : f.max);
        put(static_cast<std::uint64_t>(k - low + 1), count);
        return decimal(k, f.precision);
    }

    std::string text(const Field& f) {
        std::string digits;
        for (unsigned k = 0; k < f.most; ++k) {
            const auto c = static_cast<unsigned>(
                f.kind == Kind::hex ? dice_.between(k == 0 ? 1 : 0, 255) : dice_.between('A', 'Z'));
            put(c, 8);
            digits += f.kind == Kind::hex ? fmt::format("{:02x}", c)
                                          : std::string(1, static_cast<char>(c));
        }
        return '"' + digits + '"';
    }

    std::string array(const Field& f) {
        std::vector<std::string> items(f.length);
        const bool key_given = f.length == 1 || !dice_.one_in(5);
        key_ = dice_.between(f.min, f.max);
        for (unsigned k = 1; k <= f.length; ++k) {
            const unsigned index = k % f.length;
            bool given = index == 0 ? key_given : !dice_.one_in(5);
            if (f.delta > 0 && !key_given) given = false;
            items[index] = element(f, given, index == 0);
        }
        if (f.length == 1) return items[0];
        std::string out;
        for (const std::string& item : items) out += (out.empty() ? "[" : ",") + item;
        return out + "]";
    }

    void one(const LegacyMessage& m) {
        row_.clear();
        std::string values;
        for (const Field& f : fields_) {
            if (f.length > 1 || !dice_.one_in(6))
                values += ",\"" + f.name + "\":" + array(f);
            else
                element(f, false, true);
        }
        const auto src = static_cast<unsigned>(dice_.below(32)),
                   dest = static_cast<unsigned>(dice_.below(32));
        const std::int64_t now = 1'300'000'000 + dice_.below(200'000);
        const std::string record =
            fmt::format(R"({{"_time":{},"_src_id":{},"_dest_id":{}{}}})", now, src, dest, values);
        const std::string expected = frame(src, dest, now);
        LegacyOptions options;
        options.now_s = now;
        schema::JsonReader reader;
        schema::Values in, out;
        const std::string padded = record + std::string(64, '\0');
        reader.read(std::string_view(padded).substr(0, record.size()), m.layout(), in);
        std::string bytes, text;
        encode(m, in, options, bytes);
        ASSERT_EQ(to_hex(bytes), to_hex(expected)) << record << "\n" << xml_;
        decode(m, expected, options, out);
        schema::write_json(out, text);
        compare(json::parse(text), json::parse(record), text);
        ++messages;
    }

    std::string frame(unsigned src, unsigned dest, std::int64_t now) {
        std::vector<bool> body(static_cast<std::size_t>((8 - row_.size() % 8) % 8));
        body.insert(body.end(), row_.begin(), row_.end());
        row_.clear();
        put(0x20, 8);
        put(300, 9);
        put(static_cast<std::uint64_t>(now % 86400), 17);
        put(src, 5);
        put(dest, 5);
        put(0, 4);
        row_.insert(row_.end(), body.begin(), body.end());
        std::string out;
        for (std::size_t k = 0; k < row_.size(); ++k) {
            if (k % 8 == 0) out += '\0';
            if (row_[k]) out.back() = static_cast<char>(out.back() | 128 >> k % 8);
        }
        while (out.size() > 6 && out.back() == '\0') out.pop_back();
        return out;
    }

    /// The same, where absent, null and an array of nulls are one.
    void compare(const json& got, const json& sent, const std::string& text) const {
        for (const auto& [key, value] : sent.items()) {
            const json other = got.value(key, json());
            if (value.is_array()) {
                for (std::size_t k = 0; k < value.size(); ++k) {
                    EXPECT_EQ(other.is_array() ? other[k] : json(), value[k])
                        << key << text << xml_;
                }
            } else if (value.is_number()) {
                EXPECT_EQ(other.get<double>(), value.get<double>()) << key << text << xml_;
            } else {
                EXPECT_EQ(other, value) << key << text << xml_;
            }
        }
    }

    Dice dice_;
    bool repeat_ = false;
    std::vector<Field> fields_;
    int size_ = 0;
    std::string xml_;
    std::vector<bool> row_;
    std::int64_t key_ = 0;
};

TEST(DcclLegacyReference, BytesAndValues) {
    int messages = 0;
    for (std::uint64_t seed = 1; seed <= 2000 && !HasFailure(); ++seed) {
        LegacyPair pair(seed);
        pair.check();
        messages += pair.messages;
    }
    EXPECT_GT(messages, 4000);
}

}  // namespace
}  // namespace seautils::dccl
