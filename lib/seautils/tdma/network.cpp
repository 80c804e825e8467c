#include "seautils/tdma/network.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace seautils::tdma {

namespace {

constexpr std::uint64_t unbounded = std::numeric_limits<std::uint64_t>::max();

/// The least common multiple; `unbounded` where it is too large to be waited for.
std::uint64_t common_multiple(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t part = a / std::gcd(a, b);
    return a == unbounded || part > (std::uint64_t{1} << 48) / b ? unbounded : part * b;
}

std::uint64_t common_period(const Excitation& excitation, const std::vector<Vehicle>& vehicles) {
    std::uint64_t period = 1;
    for (const Vehicle& vehicle : vehicles) {
        const std::uint64_t own = period_slots(excitation, vehicle.world.slots());
        if (own == 0) return unbounded;
        period = common_multiple(period, own);
    }
    return period;
}

}  // namespace

Network::Network(const std::vector<int>& addresses, std::uint64_t start,
                 const NetworkOptions& options)
    : options_(options), random_(options.seed), start_(start), slot_(start) {
    for (const int address : addresses) join(address);
}

void Network::join(int address) {
    const auto at =
        std::lower_bound(vehicles_.begin(), vehicles_.end(), address,
                         [](const Vehicle& vehicle, int a) { return vehicle.address < a; });
    vehicles_.insert(at, Vehicle(address))->resume = (slot_ + 1) / 2 * 2;
    changed();
}

void Network::changed() {
    period_ = options_.p_collide < 1 ? unbounded : common_period(options_.excitation, vehicles_);
    stuck_from_ = period_ == unbounded ? unbounded : std::max(slot_, settled()) + 2 * period_;
}

void Network::step() {
    act();
    const bool lost = senders_.empty() || is_lost();
    got_through_ = !lost;
    bool any_learned = false;
    for (Vehicle& vehicle : vehicles_) {
        vehicle.heard.clear();
        if (lost || vehicle.does == Does::send) continue;
        const std::size_t before = vehicle.world.size();
        hear(vehicle);
        any_learned = any_learned || vehicle.world.size() > before;
    }
    ++slot_;
    if (any_learned) changed();
}

void Network::act() {
    senders_.clear();
    for (Vehicle& vehicle : vehicles_) {
        const std::uint64_t slots = vehicle.world.slots();
        vehicle.cycle = slot_ / slots;
        const int whose = speaker(options_.excitation, vehicle.cycle, slot_ % slots, vehicle.world);
        if (slot_ < vehicle.resume)
            vehicle.does = Does::wait;
        else if (whose == vehicle.address)
            vehicle.does = Does::send;
        else
            vehicle.does = whose == 0 ? Does::blank : Does::listen;
        if (vehicle.does == Does::send) senders_.push_back(vehicle.address);
    }
}

bool Network::is_lost() {
    return senders_.size() > 1 &&
           (options_.p_collide >= 1 || random_.uniform() < options_.p_collide);
}

void Network::hear(Vehicle& vehicle) {
    bool is_new = false;
    for (const int address : senders_) is_new = vehicle.world.add(address) || is_new;
    vehicle.heard = senders_;
    if (!is_new) return;
    const std::uint64_t slots = vehicle.world.slots();
    vehicle.resume = ((slot_ + 1) / slots + 1) * slots;
}

bool Network::all_known() const {
    return std::all_of(vehicles_.begin(), vehicles_.end(), [this](const Vehicle& vehicle) {
        return vehicle.world.size() == vehicles_.size();
    });
}

std::uint64_t Network::settled() const {
    std::uint64_t last = slot_;
    for (const Vehicle& vehicle : vehicles_) last = std::max(last, vehicle.resume);
    return last;
}

bool Network::is_stuck() const { return slot_ >= stuck_from_ && !all_known(); }

Outcome run(Network& network, std::uint64_t limit) {
    Outcome outcome;
    outcome.was_quiet = true;
    while (!network.all_known() && !network.is_stuck() &&
           network.slot() - network.start() < limit) {
        const bool is_first_cycle = network.slot() - network.start() < 2;
        network.step();
        if (is_first_cycle && network.got_through()) outcome.was_quiet = false;
    }
    outcome.succeeded = network.all_known();
    outcome.is_proven = network.is_stuck();
    if (!outcome.succeeded) return outcome;
    outcome.known_slots = network.slot() - network.start();
    outcome.settled_slots = network.settled() - network.start();
    return outcome;
}

}  // namespace seautils::tdma
