// The inside of a LayoutSet. What makes layouts of descriptors is a source of its own: a program that makes its
// layouts by hand does without libprotobuf, and starts sooner.
#ifndef SEAUTILS_SCHEMA_LAYOUT_SET_HPP
#define SEAUTILS_SCHEMA_LAYOUT_SET_HPP

#include "seautils/schema/layout.hpp"

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

namespace seautils::schema {

struct LayoutSet::Impl {
    std::deque<Layout> layouts;
    std::deque<EnumLayout> enums;
    std::unordered_map<const google::protobuf::Descriptor*, Layout*> of;
    std::unordered_map<const google::protobuf::EnumDescriptor*, EnumLayout*> of_enum;
    std::size_t fields = 0;

    /// @throws ConfigError  more than 100,000 fields in all
    void count_fields(std::size_t more);
    const EnumLayout& enumeration(const google::protobuf::EnumDescriptor& descriptor);
    Layout& begin(const google::protobuf::Descriptor& descriptor, std::vector<Layout*>& open);
    Field field(const google::protobuf::FieldDescriptor& f, std::vector<Layout*>& open);
};

/// What is found by name and by number, and the other things that follow from the fields.
void fill_indices(Layout& layout);
void fill_indices(EnumLayout& enumeration);

}  // namespace seautils::schema

#endif  // SEAUTILS_SCHEMA_LAYOUT_SET_HPP
