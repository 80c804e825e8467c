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
    same(header_ccl_id, legacy_ccl_id);
    same(header_id, message_.id());
    const Slot& time = values_[header_time];
    const double time_s = time.present ? std::nearbyint(time.d) : static_cast<double>(now_s_);
    if (!(time_s >= 0 && time_s < 1e12)) {
        throw FieldError{message_.layout().fields[header_time].name,
                         fmt::format("{} is no time since 1970", time.d)};
    }
    MsbWriter out;
    out.put(legacy_ccl_id, 8);
    out.put(message_.id(), 9);
    out.put(static_cast<std::uint64_t>(static_cast<std::int64_t>(time_s) % legacy_day_s), 17);
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

}  // namespace

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

}  // namespace seautils::dccl
