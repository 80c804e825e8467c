#ifndef SEAUTILS_TDMA_REPORT_HPP
#define SEAUTILS_TDMA_REPORT_HPP

#include "seautils/tdma/survey.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace seautils::tdma {

// What a simulation comes to, as lines of text for people, and of JSON for programs. Times are
// those of slots of `slot_ns` nanoseconds since the origin.

/// The head of a time line: a column for each vehicle.
void append_head_text(const Network& network, std::string& out);

/// The slot that was played last: what each vehicle did (S sends, L listens, B blank, W waits), and
/// who heard of whom for the first time.
/// @param known  of each vehicle, how many it knew before the slot
void append_step_text(const Network& network, const std::vector<std::size_t>& known,
                      std::int64_t slot_ns, std::string& out);
/// `{"step":{"slot":…,"time_s":…,"vehicles":[{"id":…,"cycle":…,"does":…,"heard":…,"knows":…}]}}`
void append_step_json(const Network& network, std::int64_t slot_ns, std::string& out);

/// How one run ended, in a sentence.
void append_outcome_text(const Network& network, const Outcome& outcome, std::int64_t slot_ns,
                         std::string& out);

/// What the runs of one set of vehicles came to.
void append_set_text(const std::vector<int>& addresses, const Summary& summary, std::string& out);
/// `{"network":{"vehicles":[…],"runs":…,…}}`
void append_set_json(const std::vector<int>& addresses, const Summary& summary, std::string& out);

/// What all runs came to. Percentages in text, counts in JSON:
/// `{"summary":{"runs":…,"failed":…,"proven":…,"quiet":…,"mean_slots":…,"mean_settled_slots":…,
/// "longest_slots":…}}`; the means are null where all runs failed.
void append_summary_text(const Summary& summary, std::string& out);
void append_summary_json(const Summary& summary, std::string& out);

/// `1`, `1,3,7`: addresses from 1 to max_address, each once.
/// @throws DataError  anything else
std::vector<int> parse_addresses(std::string_view text);

/// A range of addresses, `1-10`.
struct Pool {
    int first = 1, last = 10;
};
/// @throws DataError  not of this form, or none of 1 to max_address
Pool parse_pool(std::string_view text);

}  // namespace seautils::tdma

#endif  // SEAUTILS_TDMA_REPORT_HPP
