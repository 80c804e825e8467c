#ifndef SEAUTILS_RECORD_DUPLICATES_HPP
#define SEAUTILS_RECORD_DUPLICATES_HPP

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace seautils::record {

/// Knows messages that came again: an acknowledgement that is lost makes its sender send the same
/// bytes once more.
class Duplicates {
public:
    /// @param window_ns  how long a message is remembered, above 0
    /// @param most       how many messages at most; the oldest is forgotten first
    explicit Duplicates(std::int64_t window_ns, std::size_t most = 65536);

    /// Whether the same bytes came from the same sender within the window before; from now on they
    /// count as having come at this time.
    bool is_again(std::uint32_t src, std::string_view bytes, std::int64_t time_ns);

private:
    void forget(std::int64_t before_ns);

    std::int64_t window_ns_;
    std::size_t most_;
    std::unordered_map<std::string, std::int64_t> last_;         ///< never iterated
    std::deque<std::pair<std::int64_t, std::string>> in_order_;  ///< of coming
};

}  // namespace seautils::record

#endif  // SEAUTILS_RECORD_DUPLICATES_HPP
