#ifndef SEAUTILS_SCHEMA_VALUES_HPP
#define SEAUTILS_SCHEMA_VALUES_HPP

#include "seautils/schema/layout.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::schema {

/// One value, or the place of several. Which member counts follows from the field:
///
/// | field                  | value |
/// |---|---|
/// | boolean, int32, int64, enumeration | `i` (bool 0/1; enum its number) |
/// | uint32, uint64         | `u` |
/// | float32, float64       | `d` (a float32 is exactly representable) |
/// | string, bytes          | `u` offset and `aux` length in the Values' text |
/// | message                | `u` index of the block's first slot |
/// | repeated (any kind)    | `u` index of the first element's slot, `aux` count; elements are slots as above |
struct Slot {
    union {
        std::int64_t i;
        std::uint64_t u;
        double d;
    };
    std::uint32_t aux = 0;
    bool present = false;  ///< repeated: true when aux > 0; element: false only for a legacy null

    Slot() : i(0) {}
};

/// A message's values as one flat array of slots: what JSON, binary protobuf, DCCL and CSV are
/// read into and written from, without allocation once it has grown to the size of the work.
///
/// The root message's block of slots starts at 0: field f of a block that starts at b is slot
/// b + f (f = its index in Layout::fields). References to slots are lost by each call that adds
/// slots; indices are not.
class Values {
public:
    /// A record may hold this many slots and this many bytes of text.
    static constexpr std::uint32_t max_slots = 1U << 18;
    static constexpr std::uint32_t max_text_bytes = 1U << 24;

    /// Forgets everything and makes the root's block, all absent.
    void reset(const Layout& layout);

    const Layout& layout() const { return *layout_; }

    Slot& operator[](std::uint32_t index) { return slots_[index]; }
    const Slot& operator[](std::uint32_t index) const { return slots_[index]; }

    /// Adds `count` absent slots and returns the index of the first.
    /// @throws DataError  more than max_slots in all
    std::uint32_t add_slots(std::uint32_t count);

    /// Makes slot `index` a message: a new block, all absent. Returns the block's index.
    std::uint32_t add_block(std::uint32_t index, const Layout& layout);

    /// Makes slot `index` a repeated field of `count` absent elements; returns the first's index.
    std::uint32_t add_elements(std::uint32_t index, std::uint32_t count);

    /// Adds one absent element to the repeated field at slot `index`; returns the element's index.
    /// Amortized constant time. Not to be mixed with add_elements on one field.
    std::uint32_t append_element(std::uint32_t index);

    /// Makes slot `index` a text of these bytes, which must not lie in this Values.
    /// @throws DataError  more than max_text_bytes in all
    void set_text(std::uint32_t index, std::string_view bytes);
    /// Room for `count` zero bytes at slot `index`, to be filled by the caller.
    char* add_text(std::uint32_t index, std::uint32_t count);
    std::string_view text(const Slot& slot) const {
        return std::string_view(text_).substr(slot.u, slot.aux);
    }

private:
    const Layout* layout_ = nullptr;
    std::vector<Slot> slots_;
    std::string text_;
};

/// Whether a scalar holds its type's default. Where the field has no presence (proto3), that means
/// unset.
inline bool is_default(const Field& field, const Slot& slot) {
    const bool is_text = field.kind == Kind::string || field.kind == Kind::bytes;
    return is_text ? slot.aux == 0 : slot.u == 0;
}

/// Whether the same fields are present with the same bits; any NaN equals any other.
bool equal(const Values& a, const Values& b);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_VALUES_HPP
