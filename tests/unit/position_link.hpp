// A track, and both ends of a link with what goes wrong between them.
#ifndef SEAUTILS_TESTS_POSITION_LINK_HPP
#define SEAUTILS_TESTS_POSITION_LINK_HPP

#include "position_linear.hpp"

#include "seautils/core/random.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/position/sender.hpp"

#include <map>
#include <vector>

namespace seautils::position {

/// A vehicle that goes straight and turns now and then; positions in cells of 1 m.
class Walk {
public:
    explicit Walk(std::uint64_t seed) : random_(seed) {}

    Cell next() {
        if (random_.below(12) == 0) turn();
        x_ += vx_ + noise();
        y_ += vy_ + noise();
        z_ = std::clamp<std::int64_t>(z_ + noise(), -500, 0);
        return {static_cast<std::int32_t>(x_), static_cast<std::int32_t>(y_),
                static_cast<std::int32_t>(z_)};
    }
    SplitMix64& random() { return random_; }

private:
    std::int64_t noise() { return static_cast<std::int64_t>(random_.below(3)) - 1; }
    void turn() {
        vx_ = static_cast<std::int64_t>(random_.below(41)) - 20;
        vy_ = static_cast<std::int64_t>(random_.below(41)) - 20;
    }

    SplitMix64 random_;
    std::int64_t x_ = 0, y_ = 0, z_ = -20, vx_ = 15, vy_ = 3;
};

/// Everything that was sampled, and what came of it.
class Link {
public:
    explicit Link(LinkOptions options)
        : options_(options),
          sender(options, LinearCodec(), LinearHorizon()),
          receiver(options, LinearCodec(), LinearHorizon()) {}

    void sample(const Fix& fix) {
        sender.sample(fix);
        sampled[fix.time_ms] = fix.cell;
    }
    /// @return  what is to be said back
    std::string deliver(std::string_view bytes) {
        Arrival arrival = receiver.packet(bytes);
        for (const Fix& fix : arrival.fixes) {
            const auto at = sampled.find(fix.time_ms);
            if (at == sampled.end() || at->second != fix.cell) ++wrong;
            ++arrived[fix.time_ms];
        }
        last = arrival;
        return arrival.ack;
    }
    void forget_sender() { sender = Sender(options_, LinearCodec(), LinearHorizon()); }
    void forget_receiver() { receiver = Receiver(options_, LinearCodec(), LinearHorizon()); }

private:
    LinkOptions options_;

public:
    Sender sender;
    Receiver receiver;
    std::map<std::int64_t, Cell> sampled;
    std::map<std::int64_t, unsigned> arrived;  ///< how often
    std::size_t wrong = 0;
    Arrival last;
};

}  // namespace seautils::position

#endif  // SEAUTILS_TESTS_POSITION_LINK_HPP
