#include "seautils/position/receiver.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <set>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 1;
constexpr unsigned patience = 8;            ///< packets that cannot be decoded, in a row
constexpr std::size_t most_ended = 16;      ///< sessions remembered
constexpr std::size_t most_meant = 4;       ///< references that a packet is tried with
constexpr std::size_t most_nodes = 65'536;  ///< positions after the reference, by any way

/// A position that was learnt in one way, after another or after the base.
struct Node {
    Step step;
    std::int64_t parent = -1;  ///< place in the list; -1: the base
    std::uint64_t number = 0, mark = 0;
    bool is_acked = false;
};

/// What a packet said.
struct Decoded {
    std::vector<Step> run;     ///< one after another from the reference
    std::optional<Step> peek;  ///< from the reference, and not built on
};

}  // namespace

struct Receiver::Impl {
    LinkOptions options;
    std::unique_ptr<Codec> codec;      ///< as made
    std::unique_ptr<Horizon> horizon;  ///< as made

    std::optional<TrackState> base;  ///< what the sender builds on; nothing: no session
    std::vector<Node> nodes;         ///< parents before children
    std::set<std::uint64_t> told;    ///< numbers after the base's that were passed on
    std::deque<std::int64_t> ended;  ///< sessions, by their start
    unsigned failures = 0;           ///< in a row

    Impl(const LinkOptions& o, const Codec& c, const Horizon& h)
        : options(o), codec(c.clone()), horizon(h.clone()) {}

    Arrival packet(std::string_view bytes);
    Arrival start(std::string_view bytes);
    Arrival follow(const Reference& reference, std::string_view bytes);
    Arrival build(std::int64_t reference, const TrackState& state, const PacketHeader& header,
                  entropy::BitReader in);
    Arrival stale(bool is_same_session);
    Arrival refuse(std::string_view bytes, std::string why);

    Decoded decode(TrackState state, const PacketHeader& header, entropy::BitReader& in) const;
    std::int64_t newest_acked() const;
    std::uint64_t tip() const;
    std::vector<std::int64_t> meant(const Reference& reference) const;
    std::vector<std::int64_t> numbered(const Reference& reference) const;
    std::uint64_t mark_of(std::int64_t node) const;
    TrackState state_at(std::int64_t node) const;
    void rebase(std::int64_t node, const TrackState& state);
    std::int64_t add(std::int64_t parent, const Step& step);
    void tell(std::uint64_t number, const Fix& fix, Arrival& arrival);
    void acknowledge(std::int64_t node, Arrival& arrival);
    void begin_session(const TrackState& fresh);

    std::string save() const;
    void load(std::string_view state);
};

/// -1: the base.
std::int64_t Receiver::Impl::newest_acked() const {
    std::int64_t newest = -1;
    std::uint64_t number = base->number();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (!nodes[k].is_acked || nodes[k].number <= number) continue;
        newest = static_cast<std::int64_t>(k);
        number = nodes[k].number;
    }
    return newest;
}

std::uint64_t Receiver::Impl::tip() const {
    const std::int64_t node = newest_acked();
    return node < 0 ? base->number() : nodes[static_cast<std::size_t>(node)].number;
}

std::uint64_t Receiver::Impl::mark_of(std::int64_t node) const {
    return node < 0 ? base->mark() : nodes[static_cast<std::size_t>(node)].mark;
}

/// The one that can be meant: the number nearest before the newest acknowledged one, or that.
std::vector<std::int64_t> Receiver::Impl::numbered(const Reference& reference) const {
    const std::uint64_t newest = tip();
    const std::uint64_t low = (std::uint64_t{1} << reference.bits) - 1;
    const std::uint64_t back = (newest - reference.low) & low;
    if (back > newest || newest - back < base->number()) return {};
    if (newest - back == base->number()) return {-1};
    for (std::size_t k = nodes.size(); k > 0; --k)
        if (nodes[k - 1].is_acked && nodes[k - 1].number == newest - back)
            return {static_cast<std::int64_t>(k - 1)};
    return {};
}

/// Those that may be meant, the likely ones first: what the sender built on last, and the newest that
/// were acknowledged. The check tells which, or that it is none.
std::vector<std::int64_t> Receiver::Impl::meant(const Reference& reference) const {
    if (options.check_bits < 16) return numbered(reference);
    const std::uint64_t low = (std::uint64_t{1} << reference.bits) - 1;
    std::vector<std::int64_t> places;
    for (std::size_t k = nodes.size(); k > 0; --k)
        if (nodes[k - 1].is_acked && (nodes[k - 1].number & low) == reference.low)
            places.push_back(static_cast<std::int64_t>(k - 1));
    std::stable_sort(places.begin(), places.end(), [this](std::int64_t a, std::int64_t b) {
        return nodes[static_cast<std::size_t>(a)].number >
               nodes[static_cast<std::size_t>(b)].number;
    });
    if (places.size() >= most_meant) places.resize(most_meant - 1);
    if ((base->number() & low) == reference.low) places.push_back(-1);
    return places;
}

TrackState Receiver::Impl::state_at(std::int64_t node) const {
    std::vector<std::int64_t> way;
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent) way.push_back(node);
    TrackState state(*base);
    for (auto k = way.rbegin(); k != way.rend(); ++k)
        state.learn(nodes[static_cast<std::size_t>(*k)].step);
    return state;
}

/// The sender builds on this node, and so will never again on what does not come from it.
void Receiver::Impl::rebase(std::int64_t node, const TrackState& state) {
    if (node < 0) return;
    std::vector<std::int64_t> place(nodes.size(), -2);  // -2: goes
    std::vector<Node> kept;
    place[static_cast<std::size_t>(node)] = -1;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::int64_t parent = nodes[k].parent;
        if (parent < 0 || place[static_cast<std::size_t>(parent)] == -2) continue;
        place[k] = static_cast<std::int64_t>(kept.size());
        kept.push_back(nodes[k]);
        kept.back().parent = place[static_cast<std::size_t>(parent)];
    }
    base = state;
    nodes = std::move(kept);
    told.erase(told.begin(), told.upper_bound(base->number()));
}

std::int64_t Receiver::Impl::add(std::int64_t parent, const Step& step) {
    const std::uint64_t before =
        parent < 0 ? base->mark() : nodes[static_cast<std::size_t>(parent)].mark;
    const std::uint64_t number =
        parent < 0 ? base->number() : nodes[static_cast<std::size_t>(parent)].number;
    const std::uint64_t mark = mark_after(before, step);
    for (std::size_t k = nodes.size(); k > 0; --k)
        if (nodes[k - 1].mark == mark && nodes[k - 1].parent == parent)
            return static_cast<std::int64_t>(k - 1);
    nodes.push_back({step, parent, number + step.ahead, mark, false});
    return static_cast<std::int64_t>(nodes.size() - 1);
}

void Receiver::Impl::tell(std::uint64_t number, const Fix& fix, Arrival& arrival) {
    if (number > base->number() && told.insert(number).second) arrival.fixes.push_back(fix);
}

/// So that a number means one node: another that was acknowledged under it first stands for it.
void Receiver::Impl::acknowledge(std::int64_t node, Arrival& arrival) {
    std::uint64_t number = base->number(), mark = base->mark();
    if (node >= 0) {
        Node* said = &nodes[static_cast<std::size_t>(node)];
        for (Node& other : nodes)
            if (other.is_acked && other.number == said->number) said = &other;
        said->is_acked = true;
        number = said->number;
        mark = said->mark;
    }
    const Ack ack{false, static_cast<std::uint32_t>(number & most_ahead)};
    arrival.ack = encode_ack(ack, mark, options.check_bits);
}

Decoded Receiver::Impl::decode(TrackState state, const PacketHeader& header,
                               entropy::BitReader& in) const {
    Decoded all;
    if (header.is_alone()) {
        all.run.push_back(state.decode_alone(header.ahead, header.is_newest_full, in));
    } else {
        const std::size_t all_bits = in.position() + in.left(), front_bits = in.position();
        entropy::Decoder coder(in);
        if (header.kind == PacketKind::peek)
            all.peek = state.decode_peek(header.ahead, header.is_newest_full, coder);
        else
            all.run.push_back(state.decode(coder));
        for (std::uint32_t before = 0;;) {
            if (front_bits + coder.ended_bits() + 8 > all_bits && before++ == header.end.before)
                break;
            if (all.run.size() == most_count) throw DataError("packet: too many positions");
            all.run.push_back(state.decode(coder));
        }
    }
    if (in.left() >= 8 || in.get(static_cast<unsigned>(in.left())) != 0)
        throw DataError("packet: something stands behind its positions");
    return all;
}

Arrival Receiver::Impl::build(std::int64_t reference, const TrackState& state,
                              const PacketHeader& header, entropy::BitReader in) {
    const Decoded all = decode(state, header, in);
    rebase(reference, state);
    failures = 0;
    Arrival arrival;
    arrival.outcome = Arrival::Outcome::decoded;
    if (nodes.size() + all.run.size() > most_nodes) {
        arrival.why = "too many positions after what the sender builds on";
        return arrival;
    }
    std::int64_t node = -1;
    for (const Step& step : all.run) {
        node = add(node, step);
        tell(nodes[static_cast<std::size_t>(node)].number, step.fix, arrival);
    }
    if (all.peek) tell(base->number() + all.peek->ahead, all.peek->fix, arrival);
    acknowledge(node, arrival);
    return arrival;
}

/// Its sender may have forgotten what was acknowledged: it is told again.
Arrival Receiver::Impl::stale(bool is_same_session) {
    Arrival arrival;
    arrival.outcome = Arrival::Outcome::stale;
    ++failures;
    if (is_same_session) acknowledge(newest_acked(), arrival);
    return arrival;
}

void Receiver::Impl::begin_session(const TrackState& fresh) {
    if (base && base->start_ms() != fresh.start_ms()) ended.push_back(base->start_ms());
    std::erase(ended, fresh.start_ms());
    if (ended.size() > most_ended) ended.pop_front();
    base = fresh;
    nodes.clear();
    told.clear();
}

/// A packet that needs nothing to be known. If its session has ended, or its sender has built on
/// what is known already, it is late: unless its like comes again and again, and nothing else.
Arrival Receiver::Impl::start(std::string_view bytes) {
    entropy::BitReader in = unsealed(bytes, options.check_bits);
    const PacketHeader header = get_packet_header(in, get_reference(in, options.check_bits), {});
    if (!unseal(bytes, agreed(options), options.check_bits))
        return refuse(bytes, "the check is wrong");
    const bool is_same = base && base->start_ms() == header.start_ms;
    if (is_same && base->number() == 0) return build(-1, TrackState(*base), header, in);
    const bool has_ended = std::find(ended.begin(), ended.end(), header.start_ms) != ended.end();
    if ((is_same || has_ended) && failures < patience) return stale(is_same);
    const TrackState fresh(options, *codec, *horizon, header.start_ms);
    entropy::BitReader positions = in;
    decode(fresh, header, positions);  // throws before anything is changed
    begin_session(fresh);
    return build(-1, fresh, header, in);
}

Arrival Receiver::Impl::follow(const Reference& reference, std::string_view bytes) {
    if (!base) return refuse(bytes, "nothing is known of what it follows");
    const std::vector<std::int64_t> places = meant(reference);
    for (const std::int64_t node : places) {
        auto in = unseal(bytes, mark_of(node), options.check_bits);
        if (!in) continue;
        get_reference(*in, options.check_bits);
        const TrackState state = state_at(node);
        const PacketHeader header = get_packet_header(*in, reference, state.habit());
        return build(node, state, header, *in);
    }
    return refuse(bytes, places.empty() ? "it follows what is not known" : "the check is wrong");
}

Arrival Receiver::Impl::refuse(std::string_view bytes, std::string why) {
    Arrival arrival;
    arrival.why = std::move(why);
    if (failures < patience) ++failures;
    if (!base || failures >= patience) {
        arrival.ack = encode_ack({true, digest(bytes)}, agreed(options), options.check_bits);
    }
    return arrival;
}

Arrival Receiver::Impl::packet(std::string_view bytes) {
    try {
        entropy::BitReader in = unsealed(bytes, options.check_bits);
        const std::optional<Reference> reference = get_reference(in, options.check_bits);
        return reference ? follow(*reference, bytes) : start(bytes);
    } catch (const DataError& e) {
        return refuse(bytes, e.what());
    }
}

std::string Receiver::Impl::save() const {
    StateWriter out(state_version);
    put_word(out, agreed(options));
    out.number(failures);
    out.number(static_cast<std::int64_t>(ended.size()));
    for (const std::int64_t session : ended) out.number(session);
    out.number(base ? 1 : 0);
    if (base) out.text(base->save());
    out.number(static_cast<std::int64_t>(nodes.size()));
    for (const Node& node : nodes) {
        put(out, node.step);
        out.number(node.parent + 1);
        out.number(node.is_acked ? 1 : 0);
    }
    out.number(static_cast<std::int64_t>(told.size()));
    for (const std::uint64_t number : told) put_word(out, number);
    return out.finish();
}

void Receiver::Impl::load(std::string_view state) {
    StateReader in(state, state_version);
    if (get_word(in) != agreed(options)) throw DataError("state is of other options");
    failures = static_cast<unsigned>(in.number(0, patience));
    for (std::int64_t n = in.number(0, std::int64_t{most_ended}); n > 0; --n)
        ended.push_back(in.number(0, most_time_ms));
    if (in.number(0, 1) == 1) {
        base.emplace(options, *codec, *horizon, 0);
        base->load(in.text());
    }
    const std::int64_t count = in.number(0, base ? std::int64_t{most_nodes} : 0);
    for (std::int64_t n = 0; n < count; ++n) {
        Node node{get_step(in)};
        node.parent = in.number(0, n) - 1;
        node.is_acked = in.number(0, 1) == 1;
        const bool is_first = node.parent < 0;
        const Node* parent = is_first ? nullptr : &nodes[static_cast<std::size_t>(node.parent)];
        node.number = (is_first ? base->number() : parent->number) + node.step.ahead;
        node.mark = mark_after(is_first ? base->mark() : parent->mark, node.step);
        nodes.push_back(node);
    }
    for (std::int64_t n = in.number(0, std::int64_t{2} * most_nodes); n > 0; --n)
        told.insert(get_number(in));
    in.finish();
}

Receiver::Receiver(const LinkOptions& options, const Codec& codec, const Horizon& horizon) {
    check(options);
    impl_ = std::make_unique<Impl>(options, codec, horizon);
}
Receiver::~Receiver() = default;
Receiver::Receiver(Receiver&&) noexcept = default;
Receiver& Receiver::operator=(Receiver&&) noexcept = default;

Arrival Receiver::packet(std::string_view bytes) { return impl_->packet(bytes); }
std::string Receiver::save() const { return impl_->save(); }
void Receiver::load(std::string_view state) {
    auto next = std::make_unique<Impl>(impl_->options, *impl_->codec, *impl_->horizon);
    next->load(state);
    impl_ = std::move(next);
}

}  // namespace seautils::position
