#include "seautils/dccl/legacy_codec.hpp"

#include "seautils/core/text.hpp"
#include "seautils/dccl/field_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace seautils::dccl {

namespace {

using schema::Slot;
using schema::Values;

constexpr std::size_t header_bytes = 6;
constexpr std::uint32_t ccl_id = 0x20;
constexpr std::int64_t day_s = 86400;

/// Puts numbers behind each other, most significant bit first.
class MsbWriter {
public:
    void put(std::uint64_t value, unsigned bits) {
        for (unsigned k = bits; k > 0; --k) {
            if (bits_ % 8 == 0) bytes_ += '\0';
            const auto bit = static_cast<unsigned>(value >> (k - 1)) & 1U;
            bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) |
                                              bit << (7 - bits_ % 8));
            ++bits_;
        }
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::size_t bits_ = 0;
};

/// Takes them out again. Bytes behind the end are zeros: the sender leaves them out.
class MsbReader {
public:
    explicit MsbReader(std::string_view bytes) : bytes_(bytes) {}
    std::uint64_t get(unsigned bits) {
        std::uint64_t value = 0;
        for (unsigned k = 0; k < bits; ++k, ++at_) {
            const unsigned byte =
                at_ / 8 < bytes_.size() ? static_cast<unsigned char>(bytes_[at_ / 8]) : 0U;
            value = value << 1 | (byte >> (7 - at_ % 8) & 1U);
        }
        return value;
    }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

// ----- to the wire

/// Puts the body's fields into bits. A code of 0 is "not given".
class LegacyEncoder {
public:
    LegacyEncoder(const LegacyMessage& message, const Values& values, const LegacyOptions& options)
        : message_(message), values_(values), lenient_(options.lenient), now_s_(options.now_s) {}

    std::string head();
    std::string body();

private:
    std::uint32_t header_number(LegacyHeader part, std::uint32_t most) const;
    void field(const LegacyField& f, const Slot& slot);
    void element(const LegacyField& f, const Slot* slot, bool is_key);
    std::uint64_t number(const LegacyField& f, const Slot& slot, bool is_key);
    std::uint64_t enumeration(const LegacyField& f, const Slot& slot) const;
    void text(const LegacyField& f, const Slot* slot);
    void hex(const LegacyField& f, const Slot* slot);
    void check_fixed(const LegacyField& f, const Slot& slot) const;
    std::uint64_t refused(const std::string& what) const {
        if (!lenient_) throw FieldError{{}, what};
        return 0;
    }

    const LegacyMessage& message_;
    const Values& values_;
    bool lenient_;
    std::int64_t now_s_;
    std::optional<double> key_;  ///< element 0 of the current array, in steps
    MsbWriter out_;
};

std::uint32_t LegacyEncoder::header_number(LegacyHeader part, std::uint32_t most) const {
    const Slot& slot = values_[part];
    if (!slot.present || slot.u <= most)
        return slot.present ? static_cast<std::uint32_t>(slot.u) : 0;
    throw FieldError{message_.layout().fields[part].name,
                     fmt::format("{} is outside 0 to {}", slot.u, most)};
}

std::string LegacyEncoder::head() {
    const auto same = [&](LegacyHeader part, std::uint32_t value) {
        if (!values_[part].present || values_[part].u == value) return;
        throw FieldError{message_.layout().fields[part].name,
                         fmt::format("{} is not {}", values_[part].u, value)};
    };
    same(header_ccl_id, ccl_id);
    same(header_id, message_.id());
    const Slot& time = values_[header_time];
    const double time_s = time.present ? std::nearbyint(time.d) : static_cast<double>(now_s_);
    if (!(time_s >= 0 && time_s < 1e12)) {
        throw FieldError{message_.layout().fields[header_time].name,
                         fmt::format("{} is no time since 1970", time.d)};
    }
    MsbWriter out;
    out.put(ccl_id, 8);
    out.put(message_.id(), 9);
    out.put(static_cast<std::uint64_t>(static_cast<std::int64_t>(time_s) % day_s), 17);
    out.put(header_number(header_src, 31), 5);
    out.put(header_number(header_dest, 31), 5);
    out.put(values_[header_multimessage].present ? values_[header_multimessage].u : 0, 1);
    out.put(values_[header_broadcast].present ? values_[header_broadcast].u : 0, 1);
    out.put(header_number(header_unused, 3), 2);
    return out.bytes();
}

std::string LegacyEncoder::body() {
    out_.put(0, static_cast<unsigned>((8 - message_.body_bits() % 8) % 8));
    std::uint32_t slot = header_parts;
    for (const LegacyField& f : message_.fields()) {
        try {
            field(f, values_[slot++]);
        } catch (FieldError& e) {
            e.enter(f.name);
            throw;
        }
    }
    std::string bytes = out_.bytes();
    bytes.erase(bytes.find_last_not_of('\0') + 1);
    return bytes;
}

void LegacyEncoder::field(const LegacyField& f, const Slot& slot) {
    key_.reset();
    if (f.kind == LegacyKind::fixed) return check_fixed(f, slot);
    if (f.array_length == 1) return element(f, slot.present ? &slot : nullptr, true);
    const std::uint32_t given = slot.present ? slot.aux : 0;
    if (given > f.array_length)
        refused(fmt::format("has {}, more than {}", counted(given, "element"), f.array_length));
    const auto at = [&](std::uint32_t k) -> const Slot* {
        const Slot* one = k < given ? &values_[static_cast<std::uint32_t>(slot.u) + k] : nullptr;
        return one != nullptr && one->present ? one : nullptr;
    };
    // The deltas lean on element 0, which goes last.
    if (f.max_delta > 0 && at(0) != nullptr && number(f, *at(0), true) != 0)
        key_ = f.scaled(at(0)->d);
    for (std::uint32_t k = 1; k <= f.array_length; ++k) {
        const std::uint32_t index = k % f.array_length;
        try {
            element(f, at(index), index == 0);
        } catch (FieldError& e) {
            e.enter(fmt::format("[{}]", index));
            throw;
        }
    }
}

void LegacyEncoder::element(const LegacyField& f, const Slot* slot, bool is_key) {
    if (f.kind == LegacyKind::string) return text(f, slot);
    if (f.kind == LegacyKind::hex) return hex(f, slot);
    std::uint64_t code = 0;
    if (slot != nullptr && f.kind == LegacyKind::boolean) code = slot->u + 1;
    if (slot != nullptr && f.kind == LegacyKind::number) code = number(f, *slot, is_key);
    if (slot != nullptr && f.kind == LegacyKind::enumeration) code = enumeration(f, *slot);
    out_.put(code, is_key ? f.width : f.delta_width);
}

std::uint64_t LegacyEncoder::number(const LegacyField& f, const Slot& slot, bool is_key) {
    const double x = f.scaled(slot.d);
    if (std::isnan(slot.d)) throw FieldError{{}, "nan is not a number"};
    if (f.max_delta > 0 && !is_key) {
        if (!key_) return 0;
        const double most = f.bound_scaled(f.max_delta);
        const double delta = x - *key_;
        if (std::fabs(delta) <= most)
            return static_cast<std::uint64_t>(std::nearbyint(delta + most)) + 1;
        return refused(fmt::format("{} is more than {} from element 0, which is {}", slot.d,
                                   f.max_delta, f.unscaled(*key_)));
    }
    const double min = f.bound_scaled(f.min);
    if (x >= min && x <= f.bound_scaled(f.max))
        return static_cast<std::uint64_t>(std::nearbyint(x - min)) + 1;
    return refused(fmt::format("{} is outside {} to {}", slot.d, f.min, f.max));
}

std::uint64_t LegacyEncoder::enumeration(const LegacyField& f, const Slot& slot) const {
    const std::string_view name = values_.text(slot);
    const auto found = std::find(f.values.begin(), f.values.end(), name);
    if (found != f.values.end()) return static_cast<std::uint64_t>(found - f.values.begin()) + 1;
    const std::string near = nearest(name, f.values);
    return refused(
        fmt::format("{} is not one of its values{}", quote(name),
                    near.empty() ? "" : fmt::format(" (did you mean {}?)", quote(near))));
}

void LegacyEncoder::text(const LegacyField& f, const Slot* slot) {
    std::string_view text = slot != nullptr ? values_.text(*slot) : std::string_view();
    if (text.size() > f.max_length) {
        refused(
            fmt::format("{} is {} bytes, more than {}", quote(text), text.size(), f.max_length));
        text = text.substr(0, f.max_length);
    }
    // Zeros are what fills a text up.
    if (text.find('\0') != text.npos) refused(fmt::format("{} has a NUL in it", quote(text)));
    for (std::size_t k = 0; k < f.max_length; ++k) {
        out_.put(k < text.size() ? static_cast<unsigned char>(text[k]) : 0U, 8);
    }
}

std::optional<unsigned> digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
    if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
    return std::nullopt;
}

void LegacyEncoder::hex(const LegacyField& f, const Slot* slot) {
    const std::string_view text = slot != nullptr ? values_.text(*slot) : std::string_view();
    const bool digits =
        std::all_of(text.begin(), text.end(), [](char c) { return digit(c).has_value(); });
    const bool good = digits && text.size() == 2 * std::size_t{f.max_length};
    if (slot != nullptr && !good) {
        throw FieldError{
            {}, fmt::format("{} is not {} hexadecimal digits", quote(text), 2 * f.max_length)};
    }
    if (slot != nullptr && text.find_first_not_of('0') == text.npos)
        refused("of zeros alone comes back as not given");
    for (std::size_t k = 0; k < 2 * std::size_t{f.max_length}; ++k)
        out_.put(slot != nullptr ? *digit(text[k]) : 0U, 4);
}

void LegacyEncoder::check_fixed(const LegacyField& f, const Slot& slot) const {
    if (!slot.present || values_.text(slot) == f.values.front()) return;
    refused(fmt::format("{} is not the fixed value {}", quote(values_.text(slot)),
                        quote(f.values.front())));
}

// ----- from the wire

class LegacyDecoder {
public:
    LegacyDecoder(const LegacyMessage& message, const LegacyOptions& options, Values& values)
        : message_(message), options_(options), values_(values) {}

    void head(std::string_view bytes);
    void body(std::string_view bytes);

private:
    void time(std::uint64_t second_of_day);
    void field(const LegacyField& f, std::uint32_t slot, MsbReader& in);
    void element(const LegacyField& f, std::uint32_t slot, MsbReader& in, bool is_key);
    void code(const LegacyField& f, std::uint32_t slot, std::uint64_t code, bool is_key);
    void text(const LegacyField& f, std::uint32_t slot, MsbReader& in);
    void resolve(const LegacyField& f, std::uint32_t first);
    void refused(const std::string& what) const {
        if (!options_.lenient) throw FieldError{{}, what};
    }

    const LegacyMessage& message_;
    const LegacyOptions& options_;
    Values& values_;
};

void LegacyDecoder::time(std::uint64_t second_of_day) {
    if (second_of_day >= day_s) {
        refused(fmt::format("{} is no second of a day", second_of_day));
        return;
    }
    const std::int64_t now = options_.now_s;
    const std::int64_t day = now - ((now % day_s) + day_s) % day_s;
    std::int64_t t = day + static_cast<std::int64_t>(second_of_day);
    if (t - now > day_s / 2) t -= day_s;
    if (now - t > day_s / 2) t += day_s;
    values_[header_time].d = static_cast<double>(t);
    values_[header_time].present = true;
}

void LegacyDecoder::head(std::string_view bytes) {
    MsbReader in(bytes.substr(0, header_bytes));
    in.get(8 + 9);
    try {
        time(in.get(17));
    } catch (FieldError& e) {
        e.enter(message_.layout().fields[header_time].name);
        throw;
    }
    const auto number = [&](LegacyHeader part, unsigned bits, bool always) {
        values_[part].u = in.get(bits);
        values_[part].present = always || values_[part].u != 0;
    };
    number(header_src, 5, true);
    number(header_dest, 5, true);
    number(header_multimessage, 1, false);
    number(header_broadcast, 1, false);
    number(header_unused, 2, false);
}

void LegacyDecoder::body(std::string_view bytes) {
    const std::uint64_t most = (message_.body_bits() + 7) / 8;
    if (bytes.size() > most)
        refused(fmt::format("has a body of {}, more than {}", counted(bytes.size(), "byte"), most));
    MsbReader in(bytes);
    if (in.get(static_cast<unsigned>((8 - message_.body_bits() % 8) % 8)) != 0) {
        refused("has bits where its body is filled up with zeros");
    }
    std::uint32_t slot = header_parts;
    for (const LegacyField& f : message_.fields()) {
        try {
            field(f, slot++, in);
        } catch (FieldError& e) {
            e.enter(f.name);
            throw;
        }
    }
}

void LegacyDecoder::field(const LegacyField& f, std::uint32_t slot, MsbReader& in) {
    if (f.kind == LegacyKind::fixed) return values_.set_text(slot, f.values.front());
    if (f.array_length == 1) return element(f, slot, in, true);
    const std::uint32_t first = values_.add_elements(slot, f.array_length);
    for (std::uint32_t k = 1; k <= f.array_length; ++k) {
        const std::uint32_t index = k % f.array_length;
        try {
            element(f, first + index, in, index == 0);
        } catch (FieldError& e) {
            e.enter(fmt::format("[{}]", index));
            throw;
        }
    }
    if (f.max_delta > 0) resolve(f, first);
}

/// Turns the differences of an array, read before their key, into values.
void LegacyDecoder::resolve(const LegacyField& f, std::uint32_t first) {
    const Slot key = values_[first];
    for (std::uint32_t k = 1; k < f.array_length; ++k) {
        Slot& s = values_[first + k];
        if (!s.present) continue;
        if (!key.present) {
            refused(fmt::format("[{}] is a difference from element 0, which is not given", k));
            s.present = false;
            continue;
        }
        s.d = f.unscaled(std::nearbyint(f.scaled(key.d) + s.d));
    }
}

void LegacyDecoder::element(const LegacyField& f, std::uint32_t slot, MsbReader& in, bool is_key) {
    if (f.kind == LegacyKind::string || f.kind == LegacyKind::hex) return text(f, slot, in);
    const std::uint64_t read = in.get(is_key ? f.width : f.delta_width);
    if (read != 0) code(f, slot, read, is_key);
}

void LegacyDecoder::code(const LegacyField& f, std::uint32_t slot, std::uint64_t code,
                         bool is_key) {
    const bool is_delta = f.max_delta > 0 && !is_key;
    double codes = static_cast<double>(f.values.size());
    if (f.kind == LegacyKind::boolean) codes = 2;
    if (f.kind == LegacyKind::number) {
        codes = std::nearbyint(is_delta ? 2 * f.bound_scaled(f.max_delta)
                                        : f.bound_scaled(f.max) - f.bound_scaled(f.min)) +
                1;
    }
    const std::uint64_t position = code - 1;
    if (static_cast<double>(position) >= codes)
        return refused(fmt::format("code {} stands for nothing", code));
    if (f.kind == LegacyKind::enumeration) return values_.set_text(slot, f.values[position]);
    Slot& s = values_[slot];
    s.present = true;
    if (f.kind == LegacyKind::boolean)
        s.u = position;
    else if (is_delta)
        s.d = static_cast<double>(position) - f.bound_scaled(f.max_delta);
    else
        s.d = f.unscaled(std::nearbyint(static_cast<double>(position) + f.bound_scaled(f.min)));
}

void LegacyDecoder::text(const LegacyField& f, std::uint32_t slot, MsbReader& in) {
    std::string bytes;
    for (std::uint32_t k = 0; k < f.max_length; ++k) bytes += static_cast<char>(in.get(8));
    if (bytes.find_first_not_of('\0') == bytes.npos) return;
    if (f.kind == LegacyKind::string) {
        bytes.erase(bytes.find_last_not_of('\0') + 1);
        return values_.set_text(slot, bytes);
    }
    std::string digits;
    for (const char c : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(c));
    values_.set_text(slot, digits);
}

}  // namespace

std::int32_t legacy_id(std::string_view bytes) {
    if (bytes.size() < header_bytes) {
        throw Truncated("the header takes " + where_left(header_bytes, "byte", bytes.size()));
    }
    MsbReader in(bytes);
    const std::uint64_t ccl = in.get(8);
    if (ccl != ccl_id)
        throw DataError(fmt::format("the CCL identifier is 0x{:02x}, not 0x{:02x}", ccl, ccl_id));
    return static_cast<std::int32_t>(in.get(9));
}

void encode(const LegacyMessage& message, const Values& values, const LegacyOptions& options,
            std::string& out) {
    try {
        LegacyEncoder encoder(message, values, options);
        const std::string head = encoder.head();
        std::string body = encoder.body();
        if (options.cipher != nullptr) options.cipher->apply(head, body.data(), body.size());
        out += head;
        out += body;
    } catch (const FieldError& e) {
        e.raise(message.layout());
    }
}

std::size_t decode(const LegacyMessage& message, std::string_view bytes,
                   const LegacyOptions& options, Values& values) {
    if (legacy_id(bytes) != static_cast<std::int32_t>(message.id())) {
        throw DataError(fmt::format("identifier {} is not that of message {}, {}", legacy_id(bytes),
                                    message.name(), message.id()));
    }
    values.reset(message.layout());
    std::string body(bytes.substr(header_bytes));
    if (options.cipher != nullptr)
        options.cipher->apply(bytes.substr(0, header_bytes), body.data(), body.size());
    try {
        LegacyDecoder decoder(message, options, values);
        decoder.head(bytes);
        decoder.body(body);
    } catch (const FieldError& e) {
        e.raise(message.layout());
    }
    return bytes.size();
}

}  // namespace seautils::dccl
