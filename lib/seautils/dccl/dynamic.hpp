#ifndef SEAUTILS_DCCL_DYNAMIC_HPP
#define SEAUTILS_DCCL_DYNAMIC_HPP

#include "seautils/dccl/conditions.hpp"
#include "seautils/dccl/program.hpp"
#include "seautils/schema/values.hpp"

namespace seautils::dccl {

/// Where in the message the encoder or decoder is.
struct Frame {
    std::uint32_t block = 0;
    const schema::Layout* layout = nullptr;
    std::uint32_t index = 1;  ///< 1-based, of the element of a repeated field that this is in
};

/// Answers the dynamic conditions of fields, over the values known so far.
class Dynamic {
public:
    Dynamic(ConditionEngine& engine, const Program& program, const schema::Values& values)
        : engine_(engine), program_(program), values_(values) {}

    /// Whether the field (or the element) takes no bits. `self` is what `this` means.
    bool omitted(const Op& op, const Frame& self);
    /// The step as the conditions make it: R, and the bounds of numbers.
    /// @throws DataError  the bounds enclose nothing
    Op effective(const Op& op, const Frame& self);

private:
    bool test(const std::string& script, const Frame& self);
    BlockRef root() const { return {&program_.layout(), 0}; }

    ConditionEngine& engine_;
    const Program& program_;
    const schema::Values& values_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_DYNAMIC_HPP
