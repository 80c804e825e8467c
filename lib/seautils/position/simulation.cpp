#include "seautils/position/simulation.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/random.hpp"
#include "seautils/position/receiver.hpp"
#include "seautils/position/sender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace seautils::position {

namespace {

/// Chance, in the order in which it is asked.
class Water {
public:
    explicit Water(const Losses& losses) : losses_(losses), random_(losses.seed) {
        for (const double loss : {losses.packet, losses.ack})
            if (!(loss >= 0 && loss < 1))
                throw ConfigError(fmt::format("loss {} is outside 0 to below 1", loss));
    }
    bool loses_packet() { return random_.uniform() < losses_.packet; }
    bool loses_ack() { return random_.uniform() < losses_.ack; }

private:
    Losses losses_;
    SplitMix64 random_;
};

/// The mean age of the newest position that has arrived.
class Age {
public:
    void newest(std::size_t number) { known_ = std::max(known_, number); }
    void slot(std::size_t number) {
        if (known_ == 0) return;
        sum_ += static_cast<double>(number - known_);
        ++slots_;
    }
    double mean() const { return slots_ == 0 ? 0 : sum_ / static_cast<double>(slots_); }

private:
    std::size_t known_ = 0, slots_ = 0;
    double sum_ = 0;
};

}  // namespace

LinkCost simulate_full(double full_bits, const Losses& losses, std::size_t slots) {
    Water water(losses);
    Age age;
    for (std::size_t n = 1; n <= slots; ++n) {
        if (!water.loses_packet()) age.newest(n);
        age.slot(n);
    }
    return {full_bits, age.mean(), true};
}

LinkCost simulate_arq(double delta_bits, double packet_bits, const Losses& losses,
                      std::size_t slots) {
    const auto most = static_cast<std::size_t>(packet_bits / delta_bits);
    if (most == 0) {
        throw ConfigError(
            fmt::format("a packet of {} bits holds no difference of {}", packet_bits, delta_bits));
    }
    Water water(losses);
    Age age;
    std::size_t done = 0, rounds = 0;
    for (std::size_t n = 1; n <= slots; ++n) {
        const std::size_t end = std::min(n, done + most);
        if (!water.loses_packet()) {
            age.newest(end);
            if (!water.loses_ack()) {
                done = end;
                ++rounds;
            }
        }
        age.slot(n);
    }
    LinkCost cost{0, age.mean(), true};
    cost.bits = packet_bits / static_cast<double>(most) * static_cast<double>(slots) /
                static_cast<double>(std::max<std::size_t>(rounds, 1));
    cost.is_stable = static_cast<double>(rounds * most) > static_cast<double>(slots);
    return cost;
}

namespace {

/// What is counted while links run.
struct Sums {
    LinkReport report;
    double bits = 0, header_bits = 0, bytes = 0, ages = 0;

    void sent(const Packet& packet) {
        const auto size = static_cast<double>(packet.bits);
        ++(packet.is_start ? report.starts : report.packets);
        (packet.is_start ? report.start_bits : bits) += size;
        if (!packet.is_start) header_bits += static_cast<double>(packet.header_bits);
        bytes += static_cast<double>(packet.bytes.size());
    }
    LinkReport mean(std::size_t runs) const {
        const auto each = [](double sum, std::size_t of) {
            return of == 0 ? 0 : sum / static_cast<double>(of);
        };
        LinkReport all = report;
        all.cost = {each(bits, report.packets), each(ages, runs), true};
        all.header_bits = each(header_bits, report.packets);
        all.start_bits = each(report.start_bits, runs);
        all.air_bytes = each(bytes, report.packets + report.starts);
        return all;
    }
};

void run_link(std::span<const Fix> track, Sender sender, Receiver receiver, std::size_t max_bytes,
              const Losses& losses, Sums& sums) {
    Water water(losses);
    Age age;
    std::map<std::int64_t, std::size_t> number_of;  // by time
    std::size_t sampled = 0;
    for (const Fix& fix : track) {
        sender.sample(fix);
        number_of[fix.time_ms] = ++sampled;
        if (const auto packet = sender.packet(max_bytes)) {
            sums.sent(*packet);
            if (!water.loses_packet()) {
                const Arrival arrival = receiver.packet(packet->bytes);
                for (const Fix& known : arrival.fixes) {
                    const auto at = number_of.find(known.time_ms);
                    const bool is_right =
                        at != number_of.end() && track[at->second - 1].cell == known.cell;
                    if (is_right) age.newest(at->second);
                    ++(is_right ? sums.report.arrived : sums.report.wrong);
                }
                if (!water.loses_ack()) sender.acknowledge(arrival.ack);
            }
        }
        age.slot(sampled);
    }
    sums.ages += age.mean();
    sums.report.sampled += sampled;
}

}  // namespace

LinkReport simulate_link(std::span<const Fix> track, const LinkOptions& options, const Codec& codec,
                         const Horizon& horizon, std::size_t max_bytes, const Losses& losses,
                         std::size_t runs) {
    Sums sums;
    for (std::size_t run = 0; run < runs; ++run) {
        Losses these = losses;
        these.seed += run;
        run_link(track, Sender(options, codec, horizon), Receiver(options, codec, horizon),
                 max_bytes, these, sums);
    }
    return sums.mean(runs);
}

}  // namespace seautils::position
