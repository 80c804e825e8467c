#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/binary_wire.hpp"
#include "seautils/schema/message.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace seautils::schema {

namespace {

constexpr int max_depth = 32;

/// Takes numbers from bytes; knows its place in the whole record.
class Bytes {
public:
    Bytes(std::string_view all, std::size_t begin, std::size_t end)
        : all_(all), at_(begin), end_(end) {}

    bool done() const { return at_ == end_; }
    std::size_t at() const { return at_; }

    [[noreturn]] void refuse(const char* what) const {
        throw DataError(fmt::format("byte {}: {}", at_, what));
    }

    std::uint64_t get_varint() {
        // nearly all: tags of low fields, lengths, small numbers
        if (at_ < end_ && static_cast<unsigned char>(all_[at_]) < 0x80) {
            return static_cast<unsigned char>(all_[at_++]);
        }
        return get_long_varint();
    }

    std::uint64_t get_long_varint() {
        std::uint64_t x = 0;
        for (unsigned shift = 0; shift < 70; shift += 7) {
            if (at_ == end_) refuse("the message is cut short");
            const auto byte = static_cast<unsigned char>(all_[at_++]);
            if (shift < 64) x |= std::uint64_t{byte & 0x7fU} << shift;
            if (byte < 0x80) return x;
        }
        refuse("a varint of more than ten bytes");
    }

    template <unsigned count>
    std::uint64_t get_fixed() {
        if (end_ - at_ < count) refuse("the message is cut short");
        std::uint64_t x = 0;
        std::memcpy(&x, all_.data() + at_, count);
        at_ += count;
        return std::endian::native == std::endian::big ? __builtin_bswap64(x) : x;
    }

    std::string_view get_bytes(std::uint64_t count) {
        if (count > end_ - at_) refuse("the message is cut short");
        at_ += count;
        return all_.substr(at_ - count, count);
    }

    /// The next `count` bytes as a range of their own.
    Bytes get_range(std::uint64_t count) {
        get_bytes(count);
        return {all_, at_ - count, at_};
    }

private:
    std::string_view all_;
    std::size_t at_, end_;
};

class Reader {
public:
    explicit Reader(Values& values) : values_(values) {}

    bool all_known() const { return all_known_; }

    /// @param group  the number of the group that the message is, or 0
    void message(Bytes& in, const Layout& layout, std::uint32_t block, int depth,
                 std::uint32_t group) {
        if (depth > max_depth) in.refuse("nested deeper than 32 messages");
        std::uint32_t hint = 0;
        while (!in.done()) {
            const std::uint64_t tag = in.get_varint();
            const auto number = static_cast<std::uint32_t>(tag >> 3);
            const auto type = static_cast<unsigned>(tag & 7);
            if (tag >> 32 != 0 || number == 0) in.refuse("not a field's tag");
            if (type == end_group) {
                if (number != group || group == 0)
                    in.refuse("the end of a group that was not begun");
                return;
            }
            const std::int32_t index = layout.find_number(static_cast<std::int32_t>(number), hint);
            if (index < 0 ||
                !known(in, layout, static_cast<std::uint32_t>(index), block, type, depth)) {
                all_known_ = false;
                skip(in, type, number, depth);
                continue;
            }
            hint = static_cast<std::uint32_t>(index) +
                   (layout.fields[static_cast<std::size_t>(index)].repeated ? 0U : 1U);
        }
        if (group != 0) in.refuse("the message is cut short");
    }

private:
    /// False: the wire type does not fit, so it counts as unknown.
    bool known(Bytes& in, const Layout& layout, std::uint32_t index, std::uint32_t block,
               unsigned type, int depth) {
        const Field& f = layout.fields[index];
        const std::uint32_t slot = block + index;
        const unsigned wanted = wire_type_of(f.wire_form);
        if (f.repeated && type == length && wanted != length && wanted != begin_group) {
            Bytes packed = in.get_range(in.get_varint());
            while (!packed.done()) element(packed, f, slot);
            return true;
        }
        if (type != wanted) return false;
        if (f.repeated && f.kind != Kind::message) {
            element(in, f, slot);
            return true;
        }
        if (f.kind == Kind::message) {
            sub_message(in, f, slot, depth);
        } else {
            scalar(in, f, slot);
            if (!f.has_presence && is_default(f, values_[slot])) values_[slot].present = false;
        }
        if (f.oneof >= 0) clear_others(layout, f, block, index);
        return true;
    }

    /// One value of a repeated scalar. What an enumeration does not know is left out.
    void element(Bytes& in, const Field& f, std::uint32_t list) {
        const std::uint32_t at = values_.append_element(list);
        scalar(in, f, at);
        if (!values_[at].present) --values_[list].aux;
        if (values_[list].aux == 0) values_[list].present = false;
    }

    void sub_message(Bytes& in, const Field& f, std::uint32_t slot, int depth) {
        std::uint32_t at = slot;
        if (f.repeated) at = values_.append_element(slot);
        const std::uint32_t block = values_[at].present ? static_cast<std::uint32_t>(values_[at].u)
                                                        : values_.add_block(at, *f.message);
        if (f.wire_form == WireForm::group) {
            return message(in, *f.message, block, depth + 1, static_cast<std::uint32_t>(f.number));
        }
        Bytes inner = in.get_range(in.get_varint());
        message(inner, *f.message, block, depth + 1, 0);
    }

    void clear_others(const Layout& layout, const Field& f, std::uint32_t block,
                      std::uint32_t index) {
        for (const std::uint32_t other : layout.oneofs[static_cast<std::size_t>(f.oneof)].fields) {
            if (other != index) values_[block + other] = Slot();
        }
    }

    void scalar(Bytes& in, const Field& f, std::uint32_t slot) {
        if (f.wire_form == WireForm::length) {
            const std::string_view text = in.get_bytes(in.get_varint());
            if (f.kind == Kind::string && !is_valid_utf8(text))
                in.refuse("a string that is not UTF-8");
            return values_.set_text(slot, text);
        }
        if (f.kind == Kind::enumeration) return enumerator(in, f, values_[slot]);
        Slot& s = values_[slot];
        if (f.wire_form == WireForm::fixed64)
            s.u = in.get_fixed<8>();
        else if (f.wire_form == WireForm::fixed32)
            from_32(f, static_cast<std::uint32_t>(in.get_fixed<4>()), s);
        else
            from_varint(f, in.get_varint(), s);
        s.present = true;
    }

    /// A number that a closed enumeration does not declare is an unknown field: what was there stays.
    void enumerator(Bytes& in, const Field& f, Slot& s) {
        const auto number = static_cast<std::int32_t>(in.get_varint());
        if (!f.enumeration->open && f.enumeration->find(number) == nullptr) {
            all_known_ = false;
            return;
        }
        s.i = number;
        s.present = true;
    }

    static void from_32(const Field& f, std::uint32_t bits, Slot& s) {
        if (f.kind == Kind::float32)
            s.d = static_cast<double>(std::bit_cast<float>(bits));
        else if (f.kind == Kind::uint32)
            s.u = bits;
        else
            s.i = static_cast<std::int32_t>(bits);
    }

    static void from_varint(const Field& f, std::uint64_t x, Slot& s) {
        if (f.wire_form == WireForm::zigzag) {
            if (f.kind == Kind::int32) x &= 0xffffffff;
            x = (x >> 1) ^ (~(x & 1) + 1);
        }
        switch (f.kind) {
            case Kind::boolean:
                s.i = x != 0 ? 1 : 0;
                return;
            case Kind::int32:
            case Kind::enumeration:
                s.i = static_cast<std::int32_t>(x);
                return;
            case Kind::uint32:
                s.u = static_cast<std::uint32_t>(x);
                return;
            default:
                s.u = x;
                return;
        }
    }

    void skip(Bytes& in, unsigned type, std::uint32_t number, int depth) {
        switch (type) {
            case varint:
                in.get_varint();
                return;
            case fixed64:
                in.get_fixed<8>();
                return;
            case fixed32:
                in.get_fixed<4>();
                return;
            case length:
                in.get_bytes(in.get_varint());
                return;
            case begin_group:
                break;
            default:
                in.refuse("not a wire type");
        }
        if (depth > max_depth) in.refuse("nested deeper than 32 messages");
        for (;;) {
            const std::uint64_t tag = in.get_varint();
            if ((tag & 7) == end_group) {
                if (tag >> 3 != number) in.refuse("the end of a group that was not begun");
                return;
            }
            skip(in, static_cast<unsigned>(tag & 7), static_cast<std::uint32_t>(tag >> 3),
                 depth + 1);
        }
    }

    Values& values_;
    bool all_known_ = true;
};

}  // namespace

bool read_binary(std::string_view bytes, const Layout& layout, Values& values) {
    values.reset(layout);
    Bytes in(bytes, 0, bytes.size());
    Reader reader(values);
    reader.message(in, layout, 0, 1, 0);
    return reader.all_known();
}

}  // namespace seautils::schema
