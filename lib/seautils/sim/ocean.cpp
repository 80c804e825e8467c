#include "seautils/sim/ocean.hpp"

#include "seautils/sim/modem.hpp"
#include "seautils/sim/water.hpp"
#include "seautils/stream/nmea.hpp"

#include <algorithm>
#include <map>

namespace seautils::sim {

namespace {

/// A packet on its way.
struct Emission {
    std::size_t source = 0;    ///< node
    std::uint64_t number = 0;  ///< of the source's packets
    unsigned address = 0;      ///< of the source
    Packet packet;
    Time sent = 0;
    bool cut = false;  ///< the source fell silent before its end
};

/// It, at one receiver.
struct Arrival {
    std::shared_ptr<Emission> emission;
    std::size_t receiver = 0;
    Path path;
    Time end = 0;
    bool lost = false;      ///< by chance
    bool detected = false;  ///< the modem noticed its beginning
    std::optional<Outcome> spoilt;
};

/// Numbers of transponders, as sources and receivers of chance: behind those of nodes.
constexpr std::uint64_t first_transponder = 1000;

}  // namespace

struct Ocean::Impl {
    struct Station;

    Impl(const Scenario& s, Sink& to, Time start)
        : scenario(s), sink(to), water(s.water, s.seed), now(start) {}

    Scenario scenario;
    Sink& sink;
    Water water;
    Time now;
    std::uint64_t scheduled = 0;
    std::map<std::pair<Time, std::uint64_t>, std::function<void()>> events;
    std::vector<std::unique_ptr<Station>> stations;

    void at(Time time, std::function<void()> event) {
        events.emplace(std::pair(std::max(time, now), scheduled++), std::move(event));
    }
    void run_until(Time time);
    void send(const std::shared_ptr<Emission>& emission);
    void begin(const std::shared_ptr<Arrival>& arrival);
    void end(const std::shared_ptr<Arrival>& arrival);
    Outcome hear(const Arrival& arrival, std::vector<unsigned>& bad_frames);
    void tell(const Emission& emission, unsigned receiver, const Path& path, Outcome outcome,
              std::vector<unsigned> bad_frames = {});
};

/// A modem with its place in the water and its serial line.
struct Ocean::Impl::Station : Board {
    Station(Impl& in, std::size_t k)
        : ocean(in), number(k), spec(in.scenario.nodes[k]), modem(spec, in.scenario.rates, *this) {}

    Impl& ocean;
    std::size_t number;
    NodeSpec& spec;
    Modem modem;
    std::uint64_t sent = 0;              ///< packets so far
    std::shared_ptr<Emission> speaking;  ///< what it sends now
    std::vector<std::shared_ptr<Arrival>> arriving;
    Time line_is_free = 0;  ///< when the serial line has sent all there is

    Time now() const override { return ocean.now; }
    void say(const std::string& body) override;
    void transmit(Packet packet) override;
    Answers interrogate(const Interrogation& question) override;
    void after(Time delay, std::function<void()> then) override {
        ocean.at(ocean.now + delay, std::move(then));
    }
    void fell_silent() override;

    bool is_quiet() const;
    std::optional<Time> ask(const TransponderSpec& transponder, std::uint64_t k,
                            Emission& emission);
    void spoil_arriving(Outcome why);
};

void Ocean::Impl::Station::say(const std::string& body) {
    std::string line = stream::sentence(body);
    const Time length = static_cast<Time>(line.size()) * 10 * second_ns / spec.baud;
    line_is_free = std::max(line_is_free, ocean.now) + length;
    ocean.at(line_is_free,
             [this, line = std::move(line)] { ocean.sink.to_host(number, ocean.now, line); });
}

void Ocean::Impl::Station::spoil_arriving(Outcome why) {
    for (const auto& arrival : arriving)
        if (!arrival->spoilt) arrival->spoilt = why;
}

void Ocean::Impl::Station::transmit(Packet packet) {
    const auto emission = std::make_shared<Emission>(
        Emission{number, sent++, modem.address(), std::move(packet), ocean.now, false});
    spoil_arriving(Outcome::half_duplex);
    speaking = emission;
    ocean.send(emission);
    after(emission->packet.air, [this, emission] {
        if (speaking != emission) return;
        speaking.reset();
        modem.on_sent(emission->packet);
    });
}

void Ocean::Impl::Station::fell_silent() {
    spoil_arriving(Outcome::deaf);
    if (speaking) speaking->cut = true;
    speaking.reset();
}

bool Ocean::Impl::Station::is_quiet() const {
    const bool hears = std::any_of(arriving.begin(), arriving.end(),
                                   [this](const auto& a) { return a->end > ocean.now; });
    return !hears && !speaking && modem.state() != Modem::State::off;
}

Answers Ocean::Impl::Station::interrogate(const Interrogation& question) {
    Packet packet{.kind = PacketKind::lbl, .src = modem.address()};
    packet.air = question.length;
    Emission emission{number, sent++, modem.address(), std::move(packet), ocean.now, false};
    Answers answers;
    for (std::size_t k = 0; k < ocean.scenario.transponders.size(); ++k) {
        const TransponderSpec& t = ocean.scenario.transponders[k];
        for (std::size_t slot = 0; slot < answers.size(); ++slot) {
            const bool remus = question.query_hz == 0 && question.letters.at(slot) &&
                               t.letter == static_cast<char>('A' + slot);
            const bool narrow = question.query_hz != 0 && question.query_hz == t.query_hz &&
                                question.reply_hz.at(slot) == t.reply_hz;
            if (remus || narrow) answers.at(slot) = ask(t, first_transponder + k, emission);
        }
    }
    return answers;
}

/// When a transponder's answer comes back, since it was asked; none: one of the two was lost.
std::optional<Time> Ocean::Impl::Station::ask(const TransponderSpec& transponder, std::uint64_t k,
                                              Emission& emission) {
    const auto fate = [&](const Path& path, std::uint64_t from, std::uint64_t to) {
        if (!path.audible) return Outcome::out_of_range;
        const bool lost = ocean.water.is_lost(path.range_m, from, emission.number, to);
        return lost ? Outcome::lost : Outcome::received;
    };
    const Path there = ocean.water.path(spec.track, transponder.track, emission.sent, 0);
    const Outcome asked = fate(there, number, k);
    ocean.tell(emission, 0, there, asked);
    if (asked != Outcome::received) return std::nullopt;
    Emission reply = emission;
    reply.packet.kind = PacketKind::lbl_reply;
    reply.packet.src = reply.address = 0;
    reply.packet.dest = modem.address();
    reply.sent = there.arrives + nanoseconds(transponder.turn_around_ms / 1000);
    const Path back = ocean.water.path(transponder.track, spec.track, reply.sent, 0);
    const Outcome answered = fate(back, k, number);
    ocean.tell(reply, modem.address(), back, answered);
    if (answered != Outcome::received) return std::nullopt;
    return back.arrives - emission.sent;
}

void Ocean::Impl::run_until(Time time) {
    while (!events.empty() && events.begin()->first.first <= time) {
        now = events.begin()->first.first;
        const auto event = std::move(events.begin()->second);
        events.erase(events.begin());
        event();
    }
    now = std::max(now, time);
}

void Ocean::Impl::send(const std::shared_ptr<Emission>& emission) {
    const Track& from = scenario.nodes[emission->source].track;
    for (std::size_t k = 0; k < stations.size(); ++k) {
        if (k == emission->source) continue;
        const Path path =
            water.path(from, scenario.nodes[k].track, emission->sent, emission->packet.rate);
        if (!path.audible) {
            tell(*emission, stations[k]->modem.address(), path, Outcome::out_of_range);
            continue;
        }
        const auto arrival = std::make_shared<Arrival>();
        arrival->emission = emission;
        arrival->receiver = k;
        arrival->path = path;
        arrival->end = path.arrives + emission->packet.air;
        arrival->lost = water.is_lost(path.range_m, emission->source, emission->number, k);
        at(path.arrives, [this, arrival] { begin(arrival); });
        at(arrival->end, [this, arrival] { end(arrival); });
    }
}

void Ocean::Impl::begin(const std::shared_ptr<Arrival>& arrival) {
    Station& station = *stations[arrival->receiver];
    if (station.modem.state() == Modem::State::off)
        arrival->spoilt = Outcome::deaf;
    else if (station.speaking)
        arrival->spoilt = Outcome::half_duplex;
    arrival->detected = station.is_quiet() && !arrival->lost && !arrival->emission->cut;
    for (const auto& other : station.arriving) {
        if (other->end <= now) continue;
        if (!other->spoilt) other->spoilt = Outcome::collision;
        if (!arrival->spoilt) arrival->spoilt = Outcome::collision;
    }
    station.arriving.push_back(arrival);
    if (arrival->detected) station.modem.on_probe(arrival->emission->packet);
}

void Ocean::Impl::end(const std::shared_ptr<Arrival>& arrival) {
    Station& station = *stations[arrival->receiver];
    std::erase(station.arriving, arrival);
    std::vector<unsigned> bad_frames;
    const Outcome outcome = hear(*arrival, bad_frames);
    tell(*arrival->emission, station.modem.address(), arrival->path, outcome,
         std::move(bad_frames));
    const bool noticed = arrival->detected && station.modem.state() != Modem::State::off;
    const bool cut = outcome == Outcome::lost && arrival->emission->cut;
    if (noticed && !station.speaking && (outcome == Outcome::collision || cut))
        station.modem.on_spoilt(arrival->emission->packet);
}

/// What becomes of a packet whose last sound has come; tells the modem where it is understood.
Outcome Ocean::Impl::hear(const Arrival& arrival, std::vector<unsigned>& bad_frames) {
    if (arrival.spoilt) return *arrival.spoilt;
    const Emission& emission = *arrival.emission;
    if (arrival.lost || emission.cut) return Outcome::lost;
    Heard heard{.packet = &emission.packet, .start = arrival.path.arrives};
    heard.range_m = arrival.path.range_m;
    heard.closing_mps = arrival.path.closing_mps;
    heard.level_db = scenario.water.source_level_db - arrival.path.tl_db;
    heard.snr_db = arrival.path.snr_db;
    for (unsigned k = 0; k < emission.packet.frames.size(); ++k) {
        const bool bad = water.is_spoilt(emission.source, emission.number, arrival.receiver, k);
        heard.bad_frame.push_back(bad);
        if (bad) bad_frames.push_back(k);
    }
    if (!stations[arrival.receiver]->modem.on_packet(heard)) return Outcome::lost;
    return bad_frames.empty() ? Outcome::received : Outcome::bad_crc;
}

void Ocean::Impl::tell(const Emission& emission, unsigned receiver, const Path& path,
                       Outcome outcome, std::vector<unsigned> bad_frames) {
    const Packet& p = emission.packet;
    Truth truth{.src = emission.address, .receiver = receiver, .dest = p.dest, .rate = p.rate};
    truth.kind = p.kind;
    truth.sent = emission.sent;
    if (outcome != Outcome::out_of_range) truth.heard = path.arrives;
    truth.air = p.air;
    truth.range_m = path.range_m;
    if (!scenario.water.tl_db.empty()) truth.tl_db = path.tl_db;
    truth.outcome = outcome;
    truth.bytes = p.bytes();
    truth.bad_frames = std::move(bad_frames);
    sink.truth(now, truth);
}

Ocean::Ocean(const Scenario& scenario, Sink& sink, Time start)
    : impl_(std::make_unique<Impl>(scenario, sink, start)) {
    for (std::size_t k = 0; k < scenario.nodes.size(); ++k)
        impl_->stations.push_back(std::make_unique<Impl::Station>(*impl_, k));
    for (const auto& station : impl_->stations) {
        Modem& modem = station->modem;
        modem.boot();
        for (const double since_s : station->spec.reboot_s) {
            const Time time = scenario.epoch + nanoseconds(since_s);
            if (time >= start) impl_->at(time, [&modem] { modem.boot(); });
        }
    }
}

Ocean::~Ocean() = default;

void Ocean::from_host(std::size_t node, std::string_view line, Time now) {
    advance(now);
    impl_->stations.at(node)->modem.command(line);
}

void Ocean::advance(Time now) { impl_->run_until(now); }

Time Ocean::next() const {
    return impl_->events.empty() ? never : impl_->events.begin()->first.first;
}

}  // namespace seautils::sim
