#include "seautils/schema/binary_wire.hpp"
#include "seautils/schema/message.hpp"

#include <bit>
#include <cstring>

namespace seautils::schema {

namespace {

/// Appends to a string by a pointer into it. Whoever puts first asks for the room.
class Appender {
public:
    explicit Appender(std::string& out) : out_(out), at_(out.size()) { room(256); }
    Appender(const Appender&) = delete;
    Appender& operator=(const Appender&) = delete;
    ~Appender() { out_.resize(at_); }

    /// Makes sure that `count` bytes more can be put.
    void room(std::size_t count) {
        if (out_.size() - at_ < count) out_.resize(2 * out_.size() + count);
    }
    std::size_t at() const { return at_; }

    void varint(std::uint64_t x) {
        for (; x >= 0x80; x >>= 7) out_[at_++] = static_cast<char>((x & 0x7f) | 0x80);
        out_[at_++] = static_cast<char>(x);
    }
    void fixed(std::uint64_t x, unsigned count) {
        for (unsigned k = 0; k < count; ++k, x >>= 8) out_[at_ + k] = static_cast<char>(x & 0xff);
        at_ += count;
    }
    void bytes(std::string_view text) {
        room(text.size());
        std::memcpy(out_.data() + at_, text.data(), text.size());
        at_ += text.size();
    }

    /// Leaves a byte for the length of what comes; settle() fills it in.
    std::size_t begin_length() { return at_++; }
    void settle(std::size_t begin) {
        const std::size_t length = at_ - begin - 1;
        std::size_t more = 0;
        for (std::size_t rest = length; rest >= 0x80; rest >>= 7) ++more;
        if (more > 0) {
            room(more);
            std::memmove(out_.data() + begin + 1 + more, out_.data() + begin + 1, length);
        }
        at_ = begin;
        varint(length);
        at_ += length;
    }

private:
    std::string& out_;
    std::size_t at_;
};

class Writer {
public:
    Writer(const Values& values, std::string& out) : values_(values), out_(out) {}

    void message(const Layout& layout, std::uint32_t block) {
        for (const std::uint32_t k : layout.by_number) {
            const Field& f = layout.fields[k];
            const Slot& slot = values_[block + k];
            if (!slot.present) continue;
            if (f.repeated && f.packed) {
                packed(f, slot);
                continue;
            }
            const std::uint32_t count = f.repeated ? slot.aux : 1;
            for (std::uint32_t e = 0; e < count; ++e) {
                const Slot& one =
                    f.repeated ? values_[static_cast<std::uint32_t>(slot.u) + e] : slot;
                tag(f, wire_type_of(f.wire_form));
                f.kind == Kind::message ? sub_message(f, one) : scalar(f, one);
            }
        }
    }

private:
    void tag(const Field& f, unsigned type) {
        out_.room(32);  // a tag of 5 bytes, a length, and a number of at most 10
        out_.varint(static_cast<std::uint64_t>(f.number) << 3 | type);
    }

    void packed(const Field& f, const Slot& slot) {
        tag(f, length);
        const std::size_t begin = out_.begin_length();
        for (std::uint32_t e = 0; e < slot.aux; ++e) {
            out_.room(16);
            scalar(f, values_[static_cast<std::uint32_t>(slot.u) + e]);
        }
        out_.settle(begin);
    }

    void sub_message(const Field& f, const Slot& s) {
        const auto block = static_cast<std::uint32_t>(s.u);
        if (f.wire_form == WireForm::group) {
            message(*f.message, block);
            tag(f, end_group);
        } else {
            const std::size_t begin = out_.begin_length();
            message(*f.message, block);
            out_.settle(begin);
        }
    }

    void scalar(const Field& f, const Slot& s) {
        switch (f.wire_form) {
            case WireForm::length:
                out_.varint(s.aux);
                out_.bytes(values_.text(s));
                return;
            case WireForm::fixed64:
                out_.fixed(s.u, 8);
                return;
            case WireForm::fixed32:
                out_.fixed(f.kind == Kind::float32
                               ? std::bit_cast<std::uint32_t>(static_cast<float>(s.d))
                               : s.u,
                           4);
                return;
            case WireForm::zigzag:
                out_.varint(static_cast<std::uint64_t>(s.i) << 1 ^
                            static_cast<std::uint64_t>(s.i >> 63));
                return;
            default:
                out_.varint(s.u);
                return;
        }
    }

    const Values& values_;
    Appender out_;
};

}  // namespace

void write_binary(const Values& values, std::string& out) {
    Writer(values, out).message(values.layout(), 0);
}

}  // namespace seautils::schema
