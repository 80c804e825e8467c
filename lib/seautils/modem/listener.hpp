#ifndef SEAUTILS_MODEM_LISTENER_HPP
#define SEAUTILS_MODEM_LISTENER_HPP

#include "seautils/modem/moment.hpp"
#include "seautils/modem/sentences.hpp"

#include <optional>
#include <vector>

namespace seautils::modem {

/// Puts what a modem says about what it hears together into records: receptions with their frames,
/// ranges, who was heard, what went wrong. Serves the dialogue with a modem and the reading of logs.
///
/// A reception begins with CACYC, CARXD, CARDP, CAMUA …, and ends with CACST; where a modem does not
/// say that, with the next thing heard, or two seconds after the last frame. At rate 0 there is a CACST
/// for the minipacket of the cycle too, which does not end it.
class Listener {
public:
    explicit Listener(double sound_speed_mps) : sound_speed_mps_(sound_speed_mps) {}

    /// @return  whether the sentence is one of these
    /// @throws DataError  it is, and says something impossible
    bool take(const Sentence& s, std::uint64_t address, Moment now,
              std::vector<record::Record>& out);

    /// A cycle of somebody else's was announced.
    void cycle(const Cycle& cycle, Moment now, std::vector<record::Record>& out);

    /// When tick() is due, on the steady clock.
    std::optional<std::int64_t> wake() const { return wake_; }
    void tick(Moment now, std::vector<record::Record>& out);
    /// Gives out what has been heard of a reception that is not at its end.
    void finish(std::vector<record::Record>& out);
    /// Forgets what was announced and not heard yet, and finishes the rest.
    void reset(std::vector<record::Record>& out);

private:
    void frame(const ReceivedFrame& frame, Moment now, std::vector<record::Record>& out);
    void lost_frame(const Complaint& complaint, Moment now, std::vector<record::Record>& out);
    void statistics(const Sentence& s, Moment now, std::vector<record::Record>& out);
    void minipacket(const Mini& mini, Moment now, std::vector<record::Record>& out);
    void flexible(const FlexiblePacket& packet, Moment now, std::vector<record::Record>& out);
    void ping_reply(const Ping& ping, Moment now, std::vector<record::Record>& out);
    void travel_times(const TravelTimes& times, Moment now, std::vector<record::Record>& out);
    void begin(std::uint32_t src, std::uint32_t dest, Moment now, std::vector<record::Record>& out);
    void occupy(std::uint32_t index, std::string bytes);
    void mark_bad(std::uint32_t index);
    void mark_missing(std::uint32_t frames);
    bool is_seen(std::uint32_t index) const { return index < 8 && (seen_ >> index & 1) != 0; }
    std::optional<std::uint32_t> first_unseen() const;
    void leg(record::Range& range, std::uint32_t transponder, std::optional<double> time_s) const;

    double sound_speed_mps_;
    std::optional<Cycle> cycle_;  ///< announced, and not ended
    bool begun_ = false;          ///< reception_ has something to tell
    record::UtcTime time_;
    record::Reception reception_;
    bool rate_known_ = false;
    unsigned seen_ = 0;  ///< bit k: frame k came, good, bad or unused
    std::optional<std::int64_t> wake_;
    record::Range::Method lbl_ = record::Range::Method::lbl_remus;
};

/// HEARD, with who speaks to whom.
void add_heard(std::vector<record::Record>& out, record::UtcTime time, std::uint32_t src,
               std::uint32_t dest);

}  // namespace seautils::modem

#endif  // SEAUTILS_MODEM_LISTENER_HPP
