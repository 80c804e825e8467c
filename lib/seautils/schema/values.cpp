#include "seautils/schema/values.hpp"

#include "seautils/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace seautils::schema {

void Values::reset(const Layout& layout) {
    layout_ = &layout;
    slots_.clear();
    text_.clear();
    add_slots(static_cast<std::uint32_t>(layout.fields.size()));
}

std::uint32_t Values::add_slots(std::uint32_t count) {
    const std::size_t first = slots_.size();
    if (count > max_slots || first + count > max_slots) {
        throw DataError("the record has more than " + std::to_string(max_slots) + " values");
    }
    slots_.resize(first + count);
    return static_cast<std::uint32_t>(first);
}

std::uint32_t Values::add_block(std::uint32_t index, const Layout& layout) {
    const std::uint32_t block = add_slots(static_cast<std::uint32_t>(layout.fields.size()));
    slots_[index].u = block;
    slots_[index].present = true;
    return block;
}

std::uint32_t Values::add_elements(std::uint32_t index, std::uint32_t count) {
    const std::uint32_t first = add_slots(count);
    slots_[index].u = first;
    slots_[index].aux = count;
    slots_[index].present = count > 0;
    return first;
}

std::uint32_t Values::append_element(std::uint32_t index) {
    // The room is the next power of two, at least 4: it is full when the count is one.
    const std::uint32_t count = slots_[index].aux;
    const bool full = count == 0 || (count >= 4 && (count & (count - 1)) == 0);
    if (full) {
        const std::uint32_t first = add_slots(count == 0 ? 4 : 2 * count);
        const auto from = static_cast<std::uint32_t>(slots_[index].u);
        std::copy_n(slots_.begin() + from, count, slots_.begin() + first);
        slots_[index].u = first;
    }
    Slot& list = slots_[index];
    list.aux = count + 1;
    list.present = true;
    return static_cast<std::uint32_t>(list.u) + count;
}

char* Values::add_text(std::uint32_t index, std::uint32_t count) {
    const std::size_t at = text_.size();
    if (count > max_text_bytes || at + count > max_text_bytes) {
        throw DataError("the record has more than " + std::to_string(max_text_bytes) +
                        " bytes of text");
    }
    text_.resize(at + count);
    slots_[index].u = at;
    slots_[index].aux = count;
    slots_[index].present = true;
    return text_.data() + at;
}

void Values::set_text(std::uint32_t index, std::string_view bytes) {
    char* to = add_text(index, static_cast<std::uint32_t>(
                                   std::min<std::size_t>(bytes.size(), max_text_bytes + 1U)));
    if (!bytes.empty()) std::memcpy(to, bytes.data(), bytes.size());
}

namespace {

bool equal_blocks(const Values& a, std::uint32_t in_a, const Values& b, std::uint32_t in_b,
                  const Layout& layout);

bool equal_one(const Field& f, const Values& a, const Slot& x, const Values& b, const Slot& y) {
    if (x.present != y.present) return false;
    if (!x.present) return true;
    switch (f.kind) {
        case Kind::message:
            return equal_blocks(a, static_cast<std::uint32_t>(x.u), b,
                                static_cast<std::uint32_t>(y.u), *f.message);
        case Kind::string:
        case Kind::bytes:
            return a.text(x) == b.text(y);
        case Kind::float32:
        case Kind::float64:
            return x.u == y.u || (std::isnan(x.d) && std::isnan(y.d));
        default:
            return x.u == y.u;
    }
}

bool equal_blocks(const Values& a, std::uint32_t in_a, const Values& b, std::uint32_t in_b,
                  const Layout& layout) {
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        const Field& f = layout.fields[k];
        const Slot& x = a[in_a + k];
        const Slot& y = b[in_b + k];
        if (!f.repeated) {
            if (!equal_one(f, a, x, b, y)) return false;
            continue;
        }
        const std::uint32_t count = x.present ? x.aux : 0;
        if (count != (y.present ? y.aux : 0)) return false;
        for (std::uint32_t e = 0; e < count; ++e) {
            if (!equal_one(f, a, a[static_cast<std::uint32_t>(x.u) + e], b,
                           b[static_cast<std::uint32_t>(y.u) + e]))
                return false;
        }
    }
    return true;
}

}  // namespace

bool equal(const Values& a, const Values& b) {
    return &a.layout() == &b.layout() && equal_blocks(a, 0, b, 0, a.layout());
}

}  // namespace seautils::schema
