// The arithmetic of bounded numbers, as the format's text has it.
#ifndef SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_NUMBER_HPP
#define SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_NUMBER_HPP

#include "dccl_reference.hpp"

#include <cmath>
#include <limits>

namespace reference {

struct Number {
    Type type = Type::int32;
    double min = 0, max = 0, res = 1;
    bool required = true;

    unsigned bits() const {
        const double n = std::ceil((max - min) / res + 1 + (required ? 0 : 1));
        return n <= 1 ? 0 : static_cast<unsigned>(std::ceil(std::log2(n)));
    }
};

/// Refuses what the field's own type cannot hold.
template <class T>
Int checked(Int x) {
    if (x < Int{std::numeric_limits<T>::min()} || x > Int{std::numeric_limits<T>::max()}) {
        throw Undefined{};
    }
    return x;
}

template <class T>
Int whole_of(double x) {
    if (!(std::fabs(x) < 1e30)) throw Undefined{};
    return checked<T>(static_cast<Int>(x));
}

template <class T>
Int quantized(Int v, double res) {
    if (res - std::trunc(res) >= 2.2e-16) return v;
    const Int step = whole_of<T>(std::trunc(res));
    const Int r = v % step;
    v -= r;
    if (static_cast<double>(r) >= res / 2) v += step;
    return checked<T>(v);
}

template <class T>
std::optional<Int> code_of_whole(const Number& n, Int value) {
    Int w = quantized<T>(value, n.res);
    if (static_cast<double>(w) < n.min || static_cast<double>(w) > n.max) return std::nullopt;
    w -= quantized<T>(whole_of<T>(n.min), n.res);
    const double d = static_cast<double>(w);
    return static_cast<Int>(n.res >= 1 ? d / n.res : d * (1.0 / n.res));
}

template <class T>
Int whole_of_code(const Number& n, std::uint64_t code) {
    const double d = static_cast<double>(code);
    const Int w = static_cast<Int>(n.res >= 1 ? d * n.res : d / (1.0 / n.res));
    return quantized<T>(checked<T>(w + quantized<T>(whole_of<T>(n.min), n.res)), n.res);
}

template <class T>
T quantized_real(T v, double res) {
    if (res >= 1) return static_cast<T>(std::floor(v / res + 0.5) * res);
    const double inv = 1.0 / res;
    return static_cast<T>(std::floor(v * inv + 0.5) / inv);
}

template <class T>
std::optional<Int> code_of_real(const Number& n, double value) {
    T w = quantized_real(static_cast<T>(value), n.res);
    if (!(w >= n.min && w <= n.max)) return std::nullopt;
    w = static_cast<T>(w - quantized_real(static_cast<T>(n.min), n.res));
    w = static_cast<T>(n.res >= 1 ? w / n.res : w * (1.0 / n.res));
    return static_cast<Int>(std::floor(w + 0.5));
}

template <class T>
double real_of_code(const Number& n, std::uint64_t code) {
    T w = static_cast<T>(code);
    w = static_cast<T>(n.res >= 1 ? w * n.res : w / (1.0 / n.res));
    return static_cast<double>(
        quantized_real(static_cast<T>(w + quantized_real(static_cast<T>(n.min), n.res)), n.res));
}

inline bool is_real(Type type) { return type == Type::float64 || type == Type::float32; }
inline bool is_text(Type type) { return type == Type::string || type == Type::bytes; }

inline std::optional<Int> code_of(const Number& n, const Value& v) {
    switch (n.type) {
        case Type::float64:
            return code_of_real<double>(n, v.real);
        case Type::float32:
            return code_of_real<float>(n, v.real);
        case Type::int64:
        case Type::sint64:
        case Type::sfixed64:
            return code_of_whole<std::int64_t>(n, v.whole);
        case Type::uint32:
        case Type::fixed32:
            return code_of_whole<std::uint32_t>(n, v.whole);
        case Type::uint64:
        case Type::fixed64:
            return code_of_whole<std::uint64_t>(n, v.whole);
        default:
            return code_of_whole<std::int32_t>(n, v.whole);
    }
}

inline void set_from_code(const Number& n, std::uint64_t code, Value& v) {
    v.set = true;
    switch (n.type) {
        case Type::float64:
            v.real = real_of_code<double>(n, code);
            return;
        case Type::float32:
            v.real = real_of_code<float>(n, code);
            return;
        case Type::int64:
        case Type::sint64:
        case Type::sfixed64:
            v.whole = whole_of_code<std::int64_t>(n, code);
            return;
        case Type::uint32:
        case Type::fixed32:
            v.whole = whole_of_code<std::uint32_t>(n, code);
            return;
        case Type::uint64:
        case Type::fixed64:
            v.whole = whole_of_code<std::uint64_t>(n, code);
            return;
        default:
            v.whole = whole_of_code<std::int32_t>(n, code);
            return;
    }
}

}  // namespace reference

#endif  // SEAUTILS_TESTS_UNIT_DCCL_REFERENCE_NUMBER_HPP
