// Text that tdma-slot is given: slots, origins, seconds, addresses, and the state that it keeps. What
// is taken is within its bounds, and gives turns that follow each other.
#include "common.hpp"

#include "seautils/tdma/discovery.hpp"
#include "seautils/tdma/report.hpp"

using namespace seautils;

namespace {

void slots(std::string_view text) {
    const tdma::Slot slot = tdma::parse_slot(text);
    fuzz::require(slot.length_ns >= tdma::min_slot_ns && slot.length_ns <= tdma::max_slot_ns,
                  "length");
    const tdma::Cycle cycle({slot});
    const tdma::Turn turn = cycle.next(tdma::day_ns);
    fuzz::require(turn.start_ns >= tdma::day_ns, "a turn in the past");
    fuzz::require(cycle.next(turn.start_ns + 1).start_ns == turn.start_ns + slot.length_ns,
                  "a gap");
}

void origins(std::string_view text) {
    const tdma::Origin origin = tdma::parse_origin(text);
    fuzz::require(tdma::boundary_after(origin, tdma::second_ns, 0) > 0, "a boundary in the past");
}

void states(std::string_view text) {
    const tdma::Memory memory = tdma::parse_memory(text);
    fuzz::require(tdma::parse_memory(tdma::to_text(memory)) == memory, "a memory that fades");
}

/// What stands behind a check, which a fuzzer cannot guess.
void discoveries(std::string_view bytes) {
    tdma::Memory memory;
    for (std::size_t k = 0; k + 3 < bytes.size() && k < 64; k += 3) {
        const auto byte = [&](std::size_t at) {
            return std::int64_t{static_cast<unsigned char>(bytes[at])};
        };
        memory.others.push_back({1 + static_cast<int>(byte(k) % 127),
                                 (byte(k + 1) << (byte(k + 2) % 24)) * tdma::second_ns / 1024});
        memory.resume_ns = memory.others.back().until_ns;
    }
    fuzz::require(tdma::parse_memory(tdma::to_text(memory)).others.size() == memory.others.size(),
                  "lost");
    const std::int64_t now = 1'000'000 * tdma::second_ns;
    const tdma::Turn turn = tdma::Discovery({}, memory, now).next(now);
    fuzz::require(turn.start_ns >= now && turn.start_ns < now + 30'000 * tdma::second_ns,
                  "no turn");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    fuzz::context = text;
    fuzz::accepted([&] { slots(text); });
    fuzz::accepted([&] { origins(text); });
    fuzz::accepted([&] { states(text); });
    fuzz::accepted([&] { discoveries(text); });
    fuzz::accepted([&] { tdma::parse_seconds_ns(text); });
    fuzz::accepted([&] { tdma::parse_addresses(text); });
    fuzz::accepted([&] { tdma::parse_pool(text); });
    return 0;
}
