// A message within a request, whose fields are asked for one by one.
#ifndef SEAUTILS_TOOLS_TL_PART_HPP
#define SEAUTILS_TOOLS_TL_PART_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace seautils::tools {

/// A message in the values, and the path to it.
struct TlPart {
    const schema::Values& values;
    std::uint32_t block;
    std::string path;

    const schema::Slot& operator[](std::uint32_t f) const { return values[block + f]; }
    bool has(std::uint32_t f) const { return (*this)[f].present; }
    std::optional<double> number(std::uint32_t f) const {
        return has(f) ? std::optional((*this)[f].d) : std::nullopt;
    }
    void number(std::uint32_t f, double& x) const {
        if (has(f)) x = (*this)[f].d;
    }
    std::optional<std::uint32_t> whole(std::uint32_t f) const {
        return has(f) ? std::optional(static_cast<std::uint32_t>((*this)[f].u)) : std::nullopt;
    }
    std::optional<bool> flag(std::uint32_t f) const {
        return has(f) ? std::optional((*this)[f].i != 0) : std::nullopt;
    }
    template <class T>
    void choice(std::uint32_t f, T& x) const {
        if (has(f)) x = static_cast<T>((*this)[f].i);
    }
    std::optional<TlPart> part(std::uint32_t f, const std::string& name) const {
        if (!has(f)) return std::nullopt;
        return TlPart{values, static_cast<std::uint32_t>((*this)[f].u), path + name + "."};
    }
    std::vector<double> list(std::uint32_t f) const {
        std::vector<double> out(has(f) ? (*this)[f].aux : 0);
        for (std::uint32_t k = 0; k < out.size(); ++k)
            out[k] = values[static_cast<std::uint32_t>((*this)[f].u) + k].d;
        return out;
    }
    /// @throws DataError  lists that belong together differ in length
    void same(std::size_t n, const char* one, std::size_t m, const char* other) const {
        if (n == m) return;
        throw DataError(
            fmt::format("{}{} has {}, {}{} {}", path, one, counted(n, "value"), path, other, m));
    }
    /// A number within bounds. @throws DataError  it is not
    void bounded(std::uint32_t f, const char* name, double least, double most, double& x) const {
        number(f, x);
        if (!(x >= least && x <= most))
            throw DataError(fmt::format("{}{} {} is outside {} to {}", path, name, x, least, most));
    }
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_PART_HPP
