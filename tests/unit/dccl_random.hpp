// Random schemas, and random messages of them, for the reference model and the library alike.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_RANDOM_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_RANDOM_HPP

#include "dccl_reference_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace reference {

/// Small whole numbers from a seed, the same on every machine.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    std::uint64_t bits() { return engine_(); }
    int below(int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); }
    std::int64_t between(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool one_in(int n) { return below(n) == 0; }
    template <class T>
    T of(std::initializer_list<T> list) {
        return *(list.begin() + below(static_cast<int>(list.size())));
    }

private:
    std::mt19937_64 engine_;
};

class SchemaMaker {
public:
    SchemaMaker(std::uint64_t seed, int version, bool proto3)
        : dice_(seed), version_(version), proto3_(proto3) {}

    Message root() {
        Message m = message(0);
        m.version = version_;
        m.id = dice_.of({0, 1, 5, 127, 128, 300, 32767});
        m.omit_id = dice_.one_in(20);
        if (dice_.one_in(8)) m.codec_group = codec_name(false);
        if (dice_.one_in(20))
            m.codec = dice_.of<const char*>(
                {"dccl.default", "dccl.default2", "dccl.default3", "dccl.default4"});
        return m;
    }

private:
    Message message(int depth) {
        Message m;
        m.name = fmt::format("M{}", count_++);
        const int fields = dice_.below(depth == 0 ? 7 : 4);
        for (int k = 0; k <= fields; ++k) m.fields.push_back(field(depth, k));
        if (version_ == 4 && dice_.one_in(2)) oneofs(m);
        return m;
    }

    Field field(int depth, int index) {
        Field f;
        f.name = fmt::format("f{}", index);
        f.number = (index * 37 + 11) % 97 + 1;
        f.type = static_cast<Type>(dice_.below(depth < 3 ? 19 : 16));
        if (f.type > Type::message) f.type = Type::message;
        const int label = dice_.below(6);
        f.label = label == 0              ? Label::repeated
                  : label < 3 && !proto3_ ? Label::required
                                          : Label::optional;
        if (dice_.one_in(4)) f.codec = codec_name(true);
        if (f.type == Type::enumeration) enumeration(f);
        if (f.type == Type::message) sub_message(f, depth);
        if (is_text(f.type)) f.max_length = static_cast<unsigned>(dice_.of({0, 1, 2, 3, 7, 8, 20}));
        if (f.type <= Type::sfixed64) bounds(f);
        if (f.label == Label::repeated) {
            f.max_repeat = static_cast<unsigned>(dice_.between(1, 6));
            f.min_repeat = static_cast<unsigned>(dice_.between(0, f.max_repeat));
            if (dice_.one_in(2)) f.min_repeat = 0;
        }
        if (dice_.one_in(4)) f.in_head = dice_.below(3) > 0;
        f.omit = dice_.one_in(20);
        f.implicit = proto3_ && f.label == Label::optional && f.type != Type::message;
        if (!f.codec.empty()) special(f);
        return f;
    }

    const char* codec_name(bool for_field) {
        if (for_field && dice_.one_in(3))
            return dice_.of<const char*>({"dccl.time", "_time", "dccl.time2", "dccl.time3",
                                          "dccl.static", "_static", "dccl.var_bytes",
                                          "dccl.var_bytes3", "dccl.var_bytes4"});
        if (dice_.one_in(10)) return "dccl.native_protobuf";
        return dice_.of<const char*>({"dccl.default", "dccl.default2", "dccl.default3",
                                      "dccl.default4", "dccl.presence", "dccl.presence3",
                                      "dccl.presence4"});
    }

    /// A codec that the type has, and what it asks for.
    void special(Field& f) {
        const auto names = [&](const char* part) { return f.codec.find(part) != f.codec.npos; };
        const bool wide = f.type == Type::float64 || f.type == Type::int64 ||
                          f.type == Type::uint64 || f.type == Type::sint64 ||
                          f.type == Type::fixed64 || f.type == Type::sfixed64;
        if (names("time")) {
            if (!wide) {
                f.codec.clear();
                return;
            }
            f.min.reset();
            f.max.reset();
            f.precision.reset();
            f.resolution.reset();
            f.num_days = static_cast<unsigned>(dice_.of({1, 1, 2, 7, 10}));
            const bool seconds = f.type == Type::float64;
            if (dice_.one_in(2))
                f.precision = seconds ? dice_.below(5) - 1 : dice_.below(9) - 7;
            else if (seconds && dice_.one_in(3))
                f.resolution = dice_.of({0.5, 0.1, 2.0, 60.0});
        }
        if (names("static")) {
            if (f.type >= Type::boolean && !is_text(f.type))
                f.codec.clear();
            else
                f.static_value = is_text(f.type)          ? dice_.of({"auv7", "two words", " x"})
                                 : f.type > Type::float32 ? dice_.of({"12", "7 and more", "+3"})
                                                          : dice_.of({"-2.75e1", "0.1", "3"});
        }
        if (names("var_bytes") && !is_text(f.type)) f.codec.clear();
        if (names("native") && is_text(f.type)) f.codec.clear();
    }

    void enumeration(Field& f) {
        f.type_name = fmt::format("E{}", count_++);
        const int values = dice_.below(9);
        const bool dense = dice_.one_in(2);
        for (int k = 0; k <= values; ++k) {
            auto number = dense ? k : static_cast<std::int32_t>(dice_.between(-40, 90));
            if (dice_.one_in(40)) number = dice_.of({-2147483647 - 1, 2147483647});
            if (k == 0 && proto3_) number = 0;
            f.enumerators.emplace_back(fmt::format("{}V{}", f.type_name, k), number);
        }
        f.packed = dice_.below(3) > 0;
    }

    void sub_message(Field& f, int depth) {
        f.sub = std::make_shared<Message>(message(depth + 1));
        if (dice_.one_in(10))
            f.sub->codec =
                dice_.of<const char*>({"dccl.default2", "dccl.default3", "dccl.default4"});
    }

    void oneofs(Message& m) {
        for (std::size_t k = 0; k < m.fields.size();) {
            std::size_t size = static_cast<std::size_t>(dice_.below(4));
            Oneof o;
            o.name = fmt::format("o{}", m.oneofs.size());
            for (; size > 0 && k < m.fields.size(); --size, ++k) {
                if (m.fields[k].label != Label::optional || m.fields[k].omit) break;
                o.members.push_back(k);
            }
            // Several in a row would be one: a field lies between them, or the next is no member.
            if (!o.members.empty()) add(m, std::move(o));
            ++k;
        }
        if (!proto3_) return;
        for (std::size_t k = 0; k < m.fields.size(); ++k) {
            Field& f = m.fields[k];
            if (f.oneof >= 0 || f.label != Label::optional || f.omit || !dice_.one_in(3)) continue;
            Oneof o;
            o.synthetic = true;
            o.members = {k};
            add(m, std::move(o));
        }
    }

    static void add(Message& m, Oneof o) {
        for (const std::size_t k : o.members) {
            m.fields[k].oneof = static_cast<int>(m.oneofs.size());
            m.fields[k].implicit = false;
            if (m.fields[k].in_head != false) m.fields[k].in_head.reset();
        }
        m.oneofs.push_back(std::move(o));
    }

    static double written(double x) { return std::stod(fmt::format("{:.12g}", x)); }

    void bounds(Field& f) {
        if (dice_.one_in(12)) return extreme(f);
        double res = 1;
        if (is_real(f.type)) {
            res = dice_.of({1.0, 0.1, 0.01, 0.001, 0.25, 0.5, 0.05, 0.3, 0.7, 2.0, 2.5, 10.0, 100.0,
                            1e-5, 1000.0, 0.125});
        } else {
            res = dice_.of({1.0, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 100.0, 1000.0, 2.5, 0.5});
        }
        const std::int64_t most = std::int64_t{1} << dice_.below(is_real(f.type) ? 22 : 20);
        const bool is_unsigned = f.type == Type::uint32 || f.type == Type::uint64 ||
                                 f.type == Type::fixed32 || f.type == Type::fixed64;
        const std::int64_t first = dice_.between(is_unsigned ? 0 : -most, most);
        const std::int64_t codes = dice_.between(0, std::int64_t{1} << dice_.below(20));
        double low = static_cast<double>(first) * res;
        double high = static_cast<double>(first + codes) * res;
        if (dice_.one_in(3)) {
            f.precision = dice_.between(-3, is_real(f.type) ? 6 : 0);
            low = written(low);
            high = written(high);
        } else {
            if (res != 1 || dice_.one_in(3)) f.resolution = res;
            low = written(low);
            high = written(high);
        }
        f.min = low;
        f.max = high;
    }

    /// What the types hold at most.
    void extreme(Field& f) {
        const auto set = [&](double low, double high, double res) {
            f.min = low;
            f.max = high;
            if (res != 1) f.resolution = res;
        };
        switch (f.type) {
            case Type::float64:
                return dice_.one_in(2) ? set(-1e300, 1e300, 1e290)
                                       : set(-4503599627370496.0, 4503599627370495.0, 1);
            case Type::float32:
                return dice_.one_in(2) ? set(-1e38, 1e38, 1e33) : set(0, 16777216, 1);
            case Type::int64:
            case Type::sint64:
            case Type::sfixed64:
                return dice_.one_in(2) ? set(-9223372036854775808.0, 9223372036854775808.0, 8192)
                                       : set(-4503599627370496.0, 4503599627370495.0, 1);
            case Type::uint64:
            case Type::fixed64:
                return dice_.one_in(2) ? set(0, 18446744073709551616.0, 4096)
                                       : set(0, 9007199254740991.0, 1);
            case Type::uint32:
            case Type::fixed32:
                return set(0, 4294967295.0, 1);
            default:
                return set(-2147483648.0, 2147483647.0, 1);
        }
    }

    Dice dice_;
    int version_;
    bool proto3_;
    int count_ = 0;
};

/// A message whose required fields are set.
/// @param wild  also values out of range, over-long texts, surplus and missing elements
class ValueMaker {
public:
    ValueMaker(std::uint64_t seed, bool wild) : dice_(seed), wild_(wild) {}

    Value message(const Message& m) {
        Value v;
        v.set = true;
        v.items.resize(m.fields.size());
        for (std::size_t k = 0; k < m.fields.size(); ++k) {
            const Field& f = m.fields[k];
            if (f.oneof >= 0 || (f.label != Label::required && dice_.one_in(4))) continue;
            v.items[k] = field(f);
        }
        for (const Oneof& o : m.oneofs) {
            const auto choice =
                static_cast<std::size_t>(dice_.below(static_cast<int>(o.members.size()) + 1));
            if (choice > 0) v.items[o.members[choice - 1]] = field(m.fields[o.members[choice - 1]]);
        }
        return v;
    }

private:
    bool wildly() { return wild_ && dice_.one_in(6); }

    Value field(const Field& f) {
        if (f.label != Label::repeated) {
            Value v = one(f);
            if (f.implicit)
                v.set = is_real(f.type)   ? v.real != 0
                        : is_text(f.type) ? !v.text.empty()
                                          : v.whole != 0;
            return v;
        }
        Value v;
        std::int64_t count = dice_.between(f.min_repeat, f.max_repeat);
        if (wildly()) count = dice_.between(0, f.max_repeat + 2);
        for (; count > 0; --count) v.items.push_back(one(f));
        v.set = !v.items.empty();
        return v;
    }

    Value one(const Field& f) {
        if (f.sub) return message(*f.sub);
        Value v;
        v.set = true;
        if (is_text(f.type)) {
            const auto most = f.max_length + (wildly() ? 3 : 0);
            for (auto length = dice_.between(0, most); length > 0; --length)
                v.text += static_cast<char>(f.type == Type::string ? dice_.between(32, 126)
                                                                   : dice_.between(0, 255));
        } else if (f.type == Type::boolean) {
            v.whole = dice_.below(2);
        } else if (f.type == Type::enumeration) {
            v.whole = f.enumerators[static_cast<std::size_t>(
                                        dice_.below(static_cast<int>(f.enumerators.size())))]
                          .second;
        } else {
            number(f, v);
        }
        return v;
    }

    void number(const Field& f, Value& v) {
        if (!f.min) return instant(f, v);
        const double res = f.precision ? std::pow(10.0, -*f.precision) : f.resolution.value_or(1);
        double x = *f.min + (*f.max - *f.min) * (static_cast<double>(dice_.bits() >> 11) * 0x1p-53);
        switch (dice_.below(6)) {
            case 0:
                x = std::floor(x / res) * res;
                break;
            case 1:
                x = (std::floor(x / res) + 0.5) * res;  // a tie
                break;
            case 2:
                x = dice_.of({*f.min, *f.max});
                break;
            default:
                break;
        }
        if (!wild_ || !dice_.one_in(5)) x = std::fmin(std::fmax(x, *f.min), *f.max);
        if (wildly())
            x = dice_.of({*f.min - res, *f.max + res, *f.max + 1000 * res, *f.max + res / 3});
        if (f.type == Type::float64) {
            v.real = x;
        } else if (f.type == Type::float32) {
            v.real = static_cast<double>(static_cast<float>(x));
        } else {
            v.whole = cut(f.type, x);
        }
        if (v.real == 0) v.real = 0;  // no -0
    }

    static Int cut(Type type, double x) {
        const Int whole = static_cast<Int>(std::fmin(std::fmax(x, -1e25), 1e25));
        const auto within = [&](Int low, Int high) { return std::clamp(whole, low, high); };
        switch (type) {
            case Type::uint32:
            case Type::fixed32:
                return within(0, 0xffffffffLL);
            case Type::uint64:
            case Type::fixed64:
                return within(0, Int{~std::uint64_t{0}});
            case Type::int64:
            case Type::sint64:
            case Type::sfixed64:
                return within(std::numeric_limits<std::int64_t>::min(),
                              std::numeric_limits<std::int64_t>::max());
            default:
                return within(-2147483648LL, 2147483647LL);
        }
    }

    /// A time near 1.7e9 s, on the day's edge, or (wild) before 1970.
    void instant(const Field& f, Value& v) {
        std::int64_t us = dice_.between(1'690'000'000'000'000, 1'710'000'000'000'000);
        if (dice_.one_in(3)) us = us / 86'400'000'000 * 86'400'000'000 + dice_.between(-3, 3);
        if (dice_.one_in(5)) us = us / 1'000'000 * 1'000'000 + 500'000;
        const bool is_unsigned = f.type == Type::uint64 || f.type == Type::fixed64;
        if (wildly()) us = is_unsigned ? dice_.between(0, 5) : -us;
        v.whole = us;
        if (f.type == Type::float64) v.real = static_cast<double>(us) / 1e6;
    }

    Dice dice_;
    bool wild_;
};

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_RANDOM_HPP
