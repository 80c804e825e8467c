#ifndef SEAUTILS_POSITION_ARCHIVE_HPP
#define SEAUTILS_POSITION_ARCHIVE_HPP

#include "seautils/position/state_bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

/// What a model keeps, named once for both ways: its archive(Archive&) hands each number to one of
/// these.
namespace seautils::position {

class Save {
public:
    explicit Save(StateWriter& out) : out_(out) {}

    template <class T>
    void number(T value, std::int64_t /*least*/ = 0, std::int64_t /*most*/ = 0) {
        out_.number(static_cast<std::int64_t>(value));
    }
    void count(std::size_t n, std::size_t /*most*/) { out_.number(static_cast<std::int64_t>(n)); }
    template <class... Model>
    void all(Model&... model) {
        (model.archive(*this), ...);
    }

private:
    StateWriter& out_;
};

class Load {
public:
    explicit Load(StateReader& in) : in_(in) {}

    /// @throws DataError  outside of the range
    template <class T>
    void number(T& value, std::int64_t least = std::numeric_limits<T>::min(),
                std::int64_t most = std::numeric_limits<T>::max()) {
        value = static_cast<T>(in_.number(least, most));
    }
    void count(std::size_t& n, std::size_t most) {
        n = static_cast<std::size_t>(in_.number(0, static_cast<std::int64_t>(most)));
    }
    template <class... Model>
    void all(Model&... model) {
        (model.archive(*this), ...);
    }

private:
    StateReader& in_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_ARCHIVE_HPP
