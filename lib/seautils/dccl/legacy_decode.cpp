#include "seautils/dccl/legacy_codec.hpp"

#include "seautils/core/text.hpp"
#include "seautils/dccl/field_error.hpp"
#include "seautils/dccl/legacy_bits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace seautils::dccl {

namespace {

using schema::Slot;
using schema::Values;

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
    void refused(const std::string& what, const std::string& path = {}) const {
        if (!options_.lenient) throw FieldError{path, what};
    }

    const LegacyMessage& message_;
    const LegacyOptions& options_;
    Values& values_;
};

void LegacyDecoder::time(std::uint64_t second_of_day) {
    if (second_of_day >= legacy_day_s) {
        refused(fmt::format("{} is no second of a day", second_of_day));
        return;
    }
    const std::int64_t now = options_.now_s;
    const std::int64_t day = now - ((now % legacy_day_s) + legacy_day_s) % legacy_day_s;
    std::int64_t t = day + static_cast<std::int64_t>(second_of_day);
    if (t - now > legacy_day_s / 2) t -= legacy_day_s;
    if (now - t > legacy_day_s / 2) t += legacy_day_s;
    values_[header_time].d = static_cast<double>(t);
    values_[header_time].present = true;
}

void LegacyDecoder::head(std::string_view bytes) {
    MsbReader in(bytes.substr(0, legacy_header_bytes));
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
        refused(fmt::format("is {} long, more than {}", counted(bytes.size(), "byte"), most),
                "body");
    MsbReader in(bytes);
    if (in.get(static_cast<unsigned>((8 - message_.body_bits() % 8) % 8)) != 0) {
        refused("has bits where it is filled up with zeros", "body");
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
        s.d = f.unscaled(f.scaled(key.d) + s.d);
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
    if (f.kind == LegacyKind::number)
        codes = std::nearbyint(is_delta ? f.delta_span() : f.key_span()) + 1;
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
        s.d = f.unscaled(static_cast<double>(position) + f.bound_scaled(f.min));
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
    if (bytes.size() < legacy_header_bytes) {
        throw Truncated("the header takes " +
                        where_left(legacy_header_bytes, "byte", bytes.size()));
    }
    MsbReader in(bytes);
    const std::uint64_t ccl = in.get(8);
    if (ccl != legacy_ccl_id)
        throw DataError(
            fmt::format("the CCL identifier is 0x{:02x}, not 0x{:02x}", ccl, legacy_ccl_id));
    return static_cast<std::int32_t>(in.get(9));
}

std::size_t decode(const LegacyMessage& message, std::string_view bytes,
                   const LegacyOptions& options, Values& values) {
    if (legacy_id(bytes) != static_cast<std::int32_t>(message.id())) {
        throw DataError(fmt::format("identifier {} is not that of message {}, {}", legacy_id(bytes),
                                    message.name(), message.id()));
    }
    values.reset(message.layout());
    std::string body(bytes.substr(legacy_header_bytes));
    if (options.cipher != nullptr)
        options.cipher->apply(bytes.substr(0, legacy_header_bytes), body.data(), body.size());
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
