#ifndef SEAUTILS_POSITION_SENDER_HPP
#define SEAUTILS_POSITION_SENDER_HPP

#include "seautils/position/packing.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::position {

/// The sending end. No clock, no input or output: fixes, packets and acknowledgements pass through.
///
/// What is sent next depends only on what is known to have arrived. Nothing waits for anything that
/// was lost: each packet can be decoded from what was acknowledged, and holds the newest position
/// (unless it is too small for that: packet()).
///
/// To go on after a restart, keep save() in a file before each packet leaves: a sender that forgot
/// what it sent would use the same numbers for other positions. (The receiver then decodes nothing, and
/// says so after a while; nothing wrong is decoded.) Without a state a new session begins.
class Sender {
public:
    /// @param codec, horizon  as made; the receiver has the same
    /// @throws ConfigError    options out of range
    Sender(const LinkOptions& options, const Codec& codec, const Horizon& horizon);
    ~Sender();
    Sender(Sender&&) noexcept;
    Sender& operator=(Sender&&) noexcept;

    /// The next position. If it is not one interval after the last one, there is a gap, and it will
    /// be a full fix; the time may also go back.
    /// @throws DataError  outside of the area or of the time's range; nothing is changed
    void sample(const Fix& fix);

    /// The next packet; nothing: all is acknowledged, or not even the newest position, nor an older
    /// one, fits. (An older one alone, where a packet is too small for the newest: in turn with it.)
    /// It may be asked for at any time, and so be the same again; it is not kept.
    /// @param max_bytes  with the check
    std::optional<Packet> packet(std::size_t max_bytes);

    enum class Heard {
        nothing,    ///< damaged, old, of another session, or about what is known already
        advanced,   ///< more is acknowledged
        restarted,  ///< the receiver lost what it knew: a new session has begun
    };
    Heard acknowledge(std::string_view ack);

    /// Whether there is something that was in no packet yet.
    bool has_new() const;
    std::size_t pending() const;    ///< positions not acknowledged (newest: that may still be sent)
    std::uint64_t dropped() const;  ///< positions that will never arrive: more than most_pending
    bool sends_newest() const;      ///< in the mode of that name, or by automatic

    /// All of it: versioned, the same on any machine; load() takes it, with the same options.
    std::string save() const;
    /// @throws DataError  of another version or other options, cut or damaged; nothing is changed
    void load(std::string_view state);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::position

#endif  // SEAUTILS_POSITION_SENDER_HPP
