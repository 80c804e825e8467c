#include "seautils/position/sender.hpp"

#include "seautils/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 1;
constexpr std::size_t most_digests = 256;
/// Of acknowledgements per packet, in 1/65536; each packet moves it by a sixteenth.
constexpr std::uint32_t all_arrives = 65'536, few_arrive = all_arrives / 3,
                        many_arrive = all_arrives / 2;

/// A step that went out from the reference, and the mark of who learnt up to it.
struct Sent {
    Step step;
    std::uint64_t mark = 0;
};

/// @param count  of the positions one after another
void set_count(PacketHeader& header, std::uint32_t count) {
    header.count = count;
    if (header.kind == PacketKind::window) header.ahead = count;
}

}  // namespace

struct Sender::Impl {
    LinkOptions options;
    std::unique_ptr<Codec> codec;      ///< as made
    std::unique_ptr<Horizon> horizon;  ///< as made

    std::optional<TrackState> known;     ///< the reference; nothing: there is no session
    std::deque<Fix> pending;             ///< not acknowledged, and still to be sent
    std::uint64_t first = 1;             ///< number of the first of them
    std::deque<Sent> steps;              ///< one by one after the reference, as sent
    std::vector<Sent> jumps;             ///< over the horizon from the reference, as sent
    std::vector<std::uint32_t> digests;  ///< of packets since the reference is the one that it is
    std::uint64_t newest_sent = 0;       ///< number
    std::uint64_t dropped = 0;
    std::uint32_t arriving = all_arrives;
    bool is_newest = false;  ///< only the newest position is sent
    bool is_part_due = false;
    std::optional<TrackState> next;  ///< the reference, if all of the last packet is acknowledged

    Impl(const LinkOptions& o, const Codec& c, const Horizon& h)
        : options(o), codec(c.clone()), horizon(h.clone()), is_newest(o.mode == LinkMode::newest) {}

    std::uint64_t newest() const { return first + pending.size() - 1; }
    std::uint32_t ahead() const { return static_cast<std::uint32_t>(newest() - known->number()); }
    /// Whether positions between the reference and what is pending will never be sent.
    bool has_hole() const { return first != known->number() + 1; }

    void sample(const Fix& fix);
    void begin();
    void make_room();
    void choose_mode();

    std::optional<Packet> packet(std::size_t max_bytes);
    std::optional<Packet> window(std::size_t most_bits);
    std::optional<Packet> jump(std::size_t most_bits);
    std::optional<Packet> peek(std::size_t most_bits, std::uint32_t least);
    std::optional<Packet> part(std::size_t most_bits);
    std::optional<Packet> backlog(std::size_t most_bits);
    PacketHeader header(PacketKind kind, std::uint32_t count) const;
    std::optional<Packet> run(PacketHeader header, const Step* newest, std::uint32_t least,
                              std::size_t most_bits);
    std::optional<Packet> alone(const PacketHeader& header, const Step& step,
                                std::size_t most_bits);
    void note_step(std::size_t place, const Sent& sent);

    Heard acknowledge(std::string_view ack);
    Heard lost(const Ack& ack, std::string_view bytes);
    bool advance(const Ack& ack, std::string_view bytes);
    bool adopt(std::uint64_t mark);
    void moved(std::uint64_t number);

    std::string save() const;
    void load(std::string_view state);
};

void Sender::Impl::begin() {
    known.reset();
    next.reset();
    steps.clear();
    jumps.clear();
    digests.clear();
    first = 1;
    newest_sent = 0;
    is_part_due = false;
    if (!pending.empty()) known.emplace(options, *codec, *horizon, pending.front().time_ms);
}

void Sender::Impl::sample(const Fix& fix) {
    check(fix, options);
    pending.push_back(fix);
    if (!known) return begin();
    make_room();
}

void Sender::Impl::make_room() {
    if (is_newest) {
        first = newest();
        pending.erase(pending.begin(), pending.end() - 1);
    }
    if (pending.size() <= options.most_pending && ahead() <= most_ahead) return;
    // Numbers would become ambiguous: a new session, with what is worth most.
    const std::size_t given_up = is_newest ? 0 : std::max<std::size_t>(pending.size() / 4, 1);
    pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(given_up));
    dropped += given_up;
    begin();
}

void Sender::Impl::choose_mode() {
    if (options.mode != LinkMode::automatic) return;
    if (arriving < few_arrive && !is_newest) {
        is_newest = true;
        make_room();
    } else if (arriving > many_arrive) {
        is_newest = false;
    }
    arriving -= arriving / 16;
}

PacketHeader Sender::Impl::header(PacketKind kind, std::uint32_t count) const {
    PacketHeader header;
    header.kind = kind;
    header.count = count;
    header.ahead = kind == PacketKind::window ? count : kind == PacketKind::part ? 0 : ahead();
    // Of a part: so many that nothing that was sent is meant.
    const std::uint64_t most = kind == PacketKind::part ? newest() - known->number() : header.ahead;
    set_reference(header, *known, most, options);
    return header;
}

void Sender::Impl::note_step(std::size_t place, const Sent& sent) {
    if (place < steps.size())
        steps[place] = sent;
    else
        steps.push_back(sent);
}

/// One position as all that the packet holds.
std::optional<Packet> Sender::Impl::alone(const PacketHeader& head, const Step& step,
                                          std::size_t most_bits) {
    entropy::BitString bits;
    put(head, bits);
    TrackState state(*known);
    state.encode_alone(step, bits);
    if (bits.size() > most_bits) return {};
    const Sent sent{step, state.mark()};
    if (step.ahead == 1)
        note_step(0, sent);
    else if (std::none_of(jumps.begin(), jumps.end(),
                          [&](const Sent& other) { return other.mark == sent.mark; }))
        jumps.push_back(sent);
    next = std::move(state);
    return packed(head, bits, *known, step.fix, options);
}

/// The pending positions, one after another, as many as fit up to the header's count; behind the
/// newest, if one is given. Nothing: fewer than `least` fit.
std::optional<Packet> Sender::Impl::run(PacketHeader head, const Step* newest_step,
                                        std::uint32_t least, std::size_t most_bits) {
    const std::uint32_t most = head.count;
    RunCoder coder(*known);
    const auto fits = [&] { return coder.say_end(head) <= most_bits; };
    if (newest_step != nullptr) coder.put_newest(*newest_step);
    if (newest_step != nullptr && !fits()) return {};
    std::vector<Sent> sent;
    bool is_whole = true;
    while (is_whole && sent.size() < most) {
        const Step step = coder.put(pending[sent.size()]);
        is_whole = fits();
        if (is_whole) sent.push_back({step, coder.state().mark()});
    }
    if (sent.size() < least) return {};
    if (!is_whole) coder.take_back();
    set_count(head, static_cast<std::uint32_t>(sent.size()));
    if (head.is_start && head.kind == PacketKind::window && sent.size() == 1) {
        head.is_newest_full = true;
        return alone(head, sent.front().step, most_bits);
    }
    coder.say_end(head);
    entropy::BitString bits;
    put(head, bits);
    coder.finish(bits);
    for (std::size_t k = 0; k < sent.size(); ++k) note_step(k, sent[k]);
    if (is_whole) next = std::move(coder.state());
    const Fix& newest_fix = newest_step != nullptr ? newest_step->fix : sent.back().step.fix;
    return packed(head, bits, *known, newest_fix, options);
}

/// One position alone, which is the newest: the next one, or over the horizon.
std::optional<Packet> Sender::Impl::jump(std::size_t most_bits) {
    const std::uint32_t k = ahead();
    const Step step = known->step_to(pending.back(), k);
    PacketHeader head = header(k == 1 ? PacketKind::window : PacketKind::jump, 1);
    head.is_newest_full = step.is_full;
    return alone(head, step, most_bits);
}

/// All of them; nothing: they do not fit.
std::optional<Packet> Sender::Impl::window(std::size_t most_bits) {
    if (pending.size() == 1) return jump(most_bits);
    return run(header(PacketKind::window, ahead()), nullptr, ahead(), most_bits);
}

std::optional<Packet> Sender::Impl::peek(std::size_t most_bits, std::uint32_t least) {
    const Step step = known->step_to(pending.back(), ahead());
    PacketHeader head = header(PacketKind::peek, ahead() - 1);
    head.is_newest_full = step.is_full;
    return run(head, &step, least, most_bits);
}

std::optional<Packet> Sender::Impl::part(std::size_t most_bits) {
    // From nothing the reference needs no number: a window that ends before the newest.
    const auto kind = known->number() == 0 ? PacketKind::window : PacketKind::part;
    return run(header(kind, static_cast<std::uint32_t>(pending.size())), nullptr, 1, most_bits);
}

/// More than fits: the newest first, and what else there is room for. Where there is none, the
/// newest and older ones take turns.
std::optional<Packet> Sender::Impl::backlog(std::size_t most_bits) {
    if (auto packet = peek(most_bits, 1)) return packet;
    is_part_due = !is_part_due;
    const auto older = [&] { return part(most_bits); };
    const auto newest = [&] { return peek(most_bits, 0); };
    std::optional<Packet> packet = is_part_due ? older() : newest();
    if (!packet) packet = is_part_due ? newest() : older();
    return packet;
}

std::optional<Packet> Sender::Impl::packet(std::size_t max_bytes) {
    if (pending.empty() || max_bytes <= options.check_bits / 8) return {};
    choose_mode();
    const std::size_t most_bits = (max_bytes - options.check_bits / 8) * 8;
    std::optional<Packet> packet;
    if (is_newest || has_hole()) {
        packet = jump(most_bits);
    } else {
        packet = window(most_bits);
        if (!packet && pending.size() > 1) packet = backlog(most_bits);
    }
    if (!packet) return {};
    if (packet->newest == pending.back()) newest_sent = newest();
    if (digests.size() == most_digests) digests.erase(digests.begin());
    digests.push_back(digest(packet->bytes));
    return packet;
}

/// The reference has moved: what went out from the old one cannot be built on any more.
void Sender::Impl::moved(std::uint64_t number) {
    jumps.clear();
    digests.clear();
    if (next && next->number() <= number) next.reset();
    while (!pending.empty() && first <= number) {
        pending.pop_front();
        ++first;
    }
    arriving = std::min(arriving + all_arrives / 16, all_arrives);
}

/// Whether the state of that mark is at hand: it is the reference then.
bool Sender::Impl::adopt(std::uint64_t mark) {
    if (!next || next->mark() != mark) return false;
    known = std::move(next);
    next.reset();
    return true;
}

bool Sender::Impl::advance(const Ack& ack, std::string_view bytes) {
    const auto meant = [&](std::uint64_t number, std::uint64_t mark) {
        return (number & most_ahead) == ack.number &&
               unseal(bytes, mark, options.check_bits).has_value();
    };
    const std::uint64_t reference = known->number();
    for (std::size_t k = steps.size(); k > 0; --k) {
        if (!meant(reference + k, steps[k - 1].mark)) continue;
        if (!adopt(steps[k - 1].mark))
            for (std::size_t j = 0; j < k; ++j) known->learn(steps[j].step);
        steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k));
        moved(reference + k);
        return true;
    }
    for (const Sent& sent : jumps) {
        if (!meant(reference + sent.step.ahead, sent.mark)) continue;
        if (!adopt(sent.mark)) known->learn(sent.step);
        steps.clear();
        moved(known->number());
        return true;
    }
    return false;
}

Sender::Heard Sender::Impl::lost(const Ack& ack, std::string_view bytes) {
    const bool is_ours = unseal(bytes, agreed(options), options.check_bits).has_value() &&
                         std::find(digests.begin(), digests.end(), ack.number) != digests.end();
    if (!is_ours || known->number() == 0) return Heard::nothing;
    begin();
    return Heard::restarted;
}

Sender::Heard Sender::Impl::acknowledge(std::string_view bytes) {
    if (!known || bytes.size() != (1 + ack_bits + options.check_bits) / 8) return Heard::nothing;
    const Ack ack = peek_ack(bytes, options.check_bits);
    if (ack.is_lost) return lost(ack, bytes);
    return advance(ack, bytes) ? Heard::advanced : Heard::nothing;
}

std::string Sender::Impl::save() const {
    StateWriter out(state_version);
    put_word(out, agreed(options));
    put_word(out, first);
    put_word(out, newest_sent);
    put_word(out, dropped);
    out.number(arriving * std::int64_t{4} + (is_newest ? 1 : 0) + (is_part_due ? 2 : 0));
    out.number(std::ssize(pending));
    for (const Fix& fix : pending) put(out, fix);
    out.number(known ? 1 : 0);
    if (known) out.text(known->save());
    out.number(std::ssize(steps));
    out.number(std::ssize(jumps));
    for (const Sent& sent : steps) put(out, sent.step), put_word(out, sent.mark);
    for (const Sent& sent : jumps) put(out, sent.step), put_word(out, sent.mark);
    out.number(std::ssize(digests));
    for (const std::uint32_t d : digests) out.number(d);
    return out.finish();
}

void Sender::Impl::load(std::string_view state) {
    StateReader in(state, state_version);
    if (get_word(in) != agreed(options)) throw DataError("state is of other options");
    first = get_number(in);
    newest_sent = get_number(in);
    dropped = get_number(in);
    const std::int64_t flags = in.number(0, std::int64_t{all_arrives} * 4 + 3);
    arriving = static_cast<std::uint32_t>(flags / 4);
    is_newest = options.mode == LinkMode::newest ||
                (options.mode == LinkMode::automatic && (flags & 1) != 0);
    is_part_due = (flags & 2) != 0;
    for (std::int64_t n = in.number(0, static_cast<std::int64_t>(options.most_pending)); n > 0; --n)
        pending.push_back(get_fix(in));
    if (in.number(0, 1) == 1) {
        known.emplace(options, *codec, *horizon, 0);
        known->load(in.text());
    }
    const std::int64_t step_count = in.number(0, most_count);
    const std::int64_t jump_count = in.number(0, most_count);
    const auto get = [&in] {
        const Step step = get_step(in);
        return Sent{step, get_word(in)};
    };
    for (std::int64_t n = 0; n < step_count; ++n) steps.push_back(get());
    for (std::int64_t n = 0; n < jump_count; ++n) jumps.push_back(get());
    for (std::int64_t n = in.number(0, std::int64_t{most_digests}); n > 0; --n)
        digests.push_back(static_cast<std::uint32_t>(in.number(0, most_ahead)));
    in.finish();
    const bool is_whole = known
                              ? first > known->number() && newest() - known->number() <= most_ahead
                              : pending.empty();
    if (!is_whole) throw DataError("state is cut or damaged");
    if (known && !pending.empty()) make_room();
}

Sender::Sender(const LinkOptions& options, const Codec& codec, const Horizon& horizon) {
    check(options);
    impl_ = std::make_unique<Impl>(options, codec, horizon);
}
Sender::~Sender() = default;
Sender::Sender(Sender&&) noexcept = default;
Sender& Sender::operator=(Sender&&) noexcept = default;

void Sender::sample(const Fix& fix) { impl_->sample(fix); }
std::optional<Packet> Sender::packet(std::size_t max_bytes) { return impl_->packet(max_bytes); }
Sender::Heard Sender::acknowledge(std::string_view ack) { return impl_->acknowledge(ack); }
bool Sender::has_new() const {
    return !impl_->pending.empty() && impl_->newest() > impl_->newest_sent;
}
std::size_t Sender::pending() const { return impl_->pending.size(); }
std::uint64_t Sender::dropped() const { return impl_->dropped; }
bool Sender::sends_newest() const { return impl_->is_newest; }
std::string Sender::save() const { return impl_->save(); }

void Sender::load(std::string_view state) {
    auto next = std::make_unique<Impl>(impl_->options, *impl_->codec, *impl_->horizon);
    next->load(state);
    // The reference points to the options of the one that it was loaded into.
    impl_ = std::move(next);
}

}  // namespace seautils::position
