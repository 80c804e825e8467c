#include "seautils/position/mix_codec.hpp"

#include "seautils/core/error.hpp"
#include "seautils/position/archive.hpp"

#include <array>
#include <stdexcept>

namespace seautils::position {

namespace {

constexpr std::uint8_t state_version = 1;
constexpr std::size_t situations = 1024;
constexpr std::uint32_t most_guessed = 8;  ///< intervals

/// The joint code's classes along one axis: near the centre each value is one, and what is further off
/// on either side.
constexpr std::int32_t reach = ValueCoder::singles;
constexpr std::size_t near_classes = 2 * reach + 1, classes = near_classes + 2;
constexpr std::size_t below_class = near_classes, above_class = near_classes + 1;

std::size_t class_of(std::int32_t value, std::int32_t centre) {
    const std::int32_t off = value - centre;
    if (off < -reach) return below_class;
    return off > reach ? above_class : static_cast<std::size_t>(off + reach);
}

/// Probabilities of the classes, Q32.
std::array<std::uint64_t, classes> class_shares(const ValueCoder::Tree& tree) {
    std::array<std::uint64_t, classes> share{};
    const auto part = [](std::uint64_t of, std::int32_t p) {
        return of * static_cast<std::uint64_t>(p) >> 16;
    };
    constexpr std::uint64_t whole = std::uint64_t{1} << 32;
    share[reach] = part(whole, tree.centre);
    const std::uint64_t beside = whole - share[reach];
    std::uint64_t up = part(beside, tree.above), down = beside - up;
    for (std::size_t d = 0; d < reach; ++d) {
        const std::uint64_t here = part(up, tree.up[d]), there = part(down, tree.down[d]);
        share[reach + 1 + d] = here;
        share[reach - 1 - d] = there;
        up -= here;
        down -= there;
    }
    share[above_class] = up;
    share[below_class] = down;
    return share;
}

/// The symbols of the joint code: (z, x, y) in this order as far as each is near; then what follows is
/// not part of it.
constexpr std::size_t of_x = near_classes * classes + 2;
std::size_t symbol_of(std::size_t z, std::size_t x, std::size_t y) {
    if (z >= near_classes) return near_classes * of_x + (z - near_classes);
    if (x >= near_classes) return z * of_x + near_classes * classes + (x - near_classes);
    return z * of_x + x * classes + y;
}
/// What a symbol says; classes that it does not are `unsaid`.
constexpr std::size_t unsaid = classes;
struct Classes {
    std::size_t z = unsaid, x = unsaid, y = unsaid;
};
Classes classes_of(std::size_t symbol) {
    if (symbol >= near_classes * of_x) return {symbol - near_classes * of_x + near_classes};
    const std::size_t z = symbol / of_x, rest = symbol % of_x;
    if (rest >= near_classes * classes) return {z, rest - near_classes * classes + near_classes};
    return {z, rest / classes, rest % classes};
}

}  // namespace

MixCodec::Ranges MixCodec::exactly(const Cell& step) {
    return {Range{step.x, step.x}, Range{step.y, step.y}, Range{step.z, step.z}};
}

MixCodec::Range MixCodec::range_of(std::size_t klass, std::int32_t centre) {
    if (klass == below_class) return {INT32_MIN, centre - reach - 1};
    if (klass == above_class) return {centre + reach + 1, INT32_MAX};
    const std::int32_t value = centre - reach + static_cast<std::int32_t>(klass);
    return {value, value};
}

MixCodec::MixCodec(const CodecOptions& options)
    : capacity_(options.small ? situations / 2 : situations), model_(capacity_, options.plan) {}

void MixCodec::restart(const Cell& cell) {
    started_ = true;
    motion_.restart(cell);
    model_.begin(cell);
}

Cell MixCodec::step_to(const Cell& next) const {
    if (!can_encode(next))
        throw std::logic_error("a position before the first full fix, or too far");
    return {next.x - motion_.last.x, next.y - motion_.last.y, next.z - motion_.last.z};
}

template <class Decide>
Cell MixCodec::follow(MixModel::Forecast& f, Decide decide) {
    const Cell step = model_.find(motion_, f, decide, true);
    const Cell next{motion_.last.x + step.x, motion_.last.y + step.y, motion_.last.z + step.z};
    if (!in_limits(next)) throw DataError("position is beyond the limits");
    model_.learn(motion_, f, step);
    motion_.step(next);
    return next;
}

void MixCodec::encode(const Cell& next, entropy::Encoder& out) {
    const Ranges actual = exactly(step_to(next));
    MixModel::Forecast f;
    model_.forecast(motion_, f);
    follow(f, [&](std::size_t axis, std::int32_t yes, std::int32_t from, std::int32_t to) {
        const bool is = actual[axis].within(from, to);
        out.bit(is, static_cast<std::uint32_t>(yes));
        return is;
    });
}

std::optional<Cell> MixCodec::decode(entropy::Decoder& in) {
    if (!started_) throw DataError("no position is known to go on from");
    MixModel::Forecast f;
    model_.forecast(motion_, f);
    return follow(f, [&](std::size_t, std::int32_t yes, std::int32_t, std::int32_t) {
        return in.bit(static_cast<std::uint32_t>(yes));
    });
}

void MixCodec::learn(const Cell& next) {
    if (!started_ && in_limits(next)) return restart(next);
    const Ranges actual = exactly(step_to(next));
    MixModel::Forecast f;
    model_.forecast(motion_, f);
    follow(f, [&](std::size_t axis, std::int32_t, std::int32_t from, std::int32_t to) {
        return actual[axis].within(from, to);
    });
}

/// Its filters are told a few positions on the straight way; what is learnt of the vehicle are only
/// positions that were there.
void MixCodec::learn_ahead(std::uint32_t ahead, const Cell& from, const Cell& to) {
    if (!can_encode(to) || ahead > most_guessed) return Codec::learn_ahead(ahead, from, to);
    for (std::uint32_t k = 1; k <= ahead; ++k) motion_.step(on_the_way(from, to, k, ahead));
}

JointCode MixCodec::joint_code(MixModel::Forecast& f) {
    std::vector<std::uint64_t> weights(near_classes * of_x + 2);
    const auto z = class_shares(model_.z_coder(motion_, f).tree());
    const ValueCoder x_coder = model_.x_coder(motion_, f);
    const auto x = class_shares(x_coder.tree());
    const auto both = [](std::uint64_t a, std::uint64_t b) { return (a >> 8) * (b >> 8) >> 16; };
    const auto weight = [&](std::size_t zc, std::size_t xc, std::size_t yc, std::uint64_t share) {
        weights[symbol_of(zc, xc, yc)] = (share >> 4) + 1;
    };
    for (std::size_t xc = 0; xc < classes; ++xc) {
        const bool near = xc < near_classes;
        std::array<std::uint64_t, classes> y{};
        if (near) {
            const std::int32_t value = range_of(xc, x_coder.centre()).least;
            y = class_shares(model_.y_coder(motion_, f, value).tree());
        }
        for (std::size_t zc = 0; zc < near_classes; ++zc) {
            const std::uint64_t zx = both(z[zc], x[xc]);
            if (!near) weight(zc, xc, 0, zx);
            for (std::size_t yc = 0; near && yc < classes; ++yc)
                weight(zc, xc, yc, both(zx, y[yc]));
        }
    }
    weight(below_class, 0, 0, z[below_class]);
    weight(above_class, 0, 0, z[above_class]);
    return JointCode(weights);
}

MixCodec::Ranges MixCodec::said_by(MixModel::Forecast& f, std::size_t symbol) {
    const Classes c = classes_of(symbol);
    Ranges said;
    said[2] = range_of(c.z, model_.z_coder(motion_, f).centre());
    if (c.x == unsaid) return said;
    said[0] = range_of(c.x, model_.x_coder(motion_, f).centre());
    if (c.y == unsaid) return said;
    said[1] = range_of(c.y, model_.y_coder(motion_, f, said[0].least).centre());
    return said;
}

void MixCodec::encode_alone(const Cell& next, entropy::BitString& out) {
    const Cell step = step_to(next);
    const Ranges actual = exactly(step);
    MixModel::Forecast f;
    model_.forecast(motion_, f);
    const JointCode code = joint_code(f);
    const std::size_t symbol =
        symbol_of(class_of(step.z, model_.z_coder(motion_, f).centre()),
                  class_of(step.x, model_.x_coder(motion_, f).centre()),
                  class_of(step.y, model_.y_coder(motion_, f, step.x).centre()));
    code.put(symbol, out);
    const Ranges said = said_by(f, symbol);
    entropy::Encoder rest(out);
    follow(f, [&](std::size_t axis, std::int32_t yes, std::int32_t from, std::int32_t to) {
        const bool is = actual[axis].within(from, to);
        if (said[axis].open(from, to)) rest.bit(is, static_cast<std::uint32_t>(yes));
        return is;
    });
    rest.finish();
}

std::optional<Cell> MixCodec::decode_alone(entropy::BitReader& in) {
    if (!started_) throw DataError("no position is known to go on from");
    MixModel::Forecast f;
    model_.forecast(motion_, f);
    const Ranges said = said_by(f, joint_code(f).get(in));
    entropy::Decoder rest(in);
    return follow(f, [&](std::size_t axis, std::int32_t yes, std::int32_t from, std::int32_t to) {
        return said[axis].open(from, to) ? rest.bit(static_cast<std::uint32_t>(yes))
                                         : said[axis].within(from, to);
    });
}

std::string MixCodec::save() const {
    StateWriter out(state_version);
    out.number(static_cast<std::int64_t>(capacity_));
    out.number(model_.plan_mark());
    MixCodec kept(*this);
    Save archive(out);
    archive.number(kept.started_);
    archive.all(kept.motion_, kept.model_);
    return out.finish();
}

void MixCodec::load(std::string_view state) {
    StateReader in(state, state_version);
    in.same(static_cast<std::int64_t>(capacity_));
    in.same(model_.plan_mark());
    MixCodec loaded(*this);
    Load archive(in);
    archive.number(loaded.started_, 0, 1);
    archive.all(loaded.motion_, loaded.model_);
    in.finish();
    *this = std::move(loaded);
}

}  // namespace seautils::position
