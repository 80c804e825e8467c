#include "seautils/dccl/lint.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>

namespace seautils::dccl {

namespace {

using schema::Kind;

constexpr std::uint64_t mtus[] = {32, 64, 256};

/// Codes that the number has, without the one for "not set".
double codes_of(const NumberCode& n) { return std::ceil((n.max - n.min) / n.resolution + 1); }

void wasted_codes(const FieldReport& row, std::vector<Remark>& out) {
    const NumberCode& n = row.number;
    const bool is_number = row.kind == OpKind::integer || row.kind == OpKind::floating;
    if (!is_number || n.width < 2 || row.has_conditions) return;
    const double spent = n.null_code ? 1 : 0;
    const double room = std::ldexp(1.0, n.width);
    const double used = codes_of(n) + spent;
    const double half = room / 2;
    if (used > 0.75 * room) return;
    const double wider = n.min + (room - spent - 1) * n.resolution;
    const double narrower = n.min + (half - spent - 1) * n.resolution;
    std::string text = fmt::format("uses {} of {} codes ({} bits): max {:.10g} fits for free", used,
                                   room, n.width, wider);
    if (used - half <= 0.1 * half) {
        text += fmt::format(", max {:.10g} saves a bit{}", narrower,
                            n.null_code && used - half == 1 ? " (one code means unset)" : "");
    }
    out.push_back({"wasted-codes", row.path, text});
}

void unreachable_bound(const FieldReport& row, std::vector<Remark>& out) {
    if (row.kind != OpKind::floating || row.number.kind != Kind::float32) return;
    for (const double bound : {row.number.min, row.number.max}) {
        const auto nearest = static_cast<double>(static_cast<float>(bound));
        if (encode_float(row.number, nearest)) continue;
        out.push_back(
            {"unreachable-bound", row.path,
             fmt::format("a float of {} is {:.17g}, which is out of range: use double, or a "
                         "wider bound",
                         bound, nearest)});
    }
}

void cut_values(const FieldReport& row, std::vector<Remark>& out) {
    const double step = row.number.resolution;
    // A step of 0.5 is exact, for 1 is two of them; 1 is 3.33 steps of 0.3, and comes back as 0.
    const double steps = step < 1 ? row.number.inverse : step;
    if (row.kind != OpKind::integer || steps == std::trunc(steps)) return;
    out.push_back(
        {"cut-values", row.path,
         fmt::format("whole numbers in steps of {} are cut, not rounded: up to {} too small", step,
                     std::ceil(step))});
}

void off_grid(const FieldReport& row, const FieldOptions& options, std::vector<Remark>& out) {
    if (!options.precision || (row.kind != OpKind::integer && row.kind != OpKind::floating)) return;
    const NumberCode& n = row.number;
    for (const double bound : {n.min, n.max}) {
        if (std::fabs(quantize(bound, n.resolution, n.inverse) - bound) < 1e-10) continue;
        out.push_back({"bounds-off-grid", row.path,
                       fmt::format("bound {} is no multiple of {}", bound, n.resolution)});
    }
}

void field_remarks(const FieldReport& row, int version, std::vector<Remark>& out) {
    if (row.lost) {
        out.push_back(
            {"lost-field", row.path,
             fmt::format(
                 "in_head differs from the message around it: codec version {} never sends it",
                 version)});
        return;
    }
    const FieldOptions options = field_options(*row.field->descriptor);
    wasted_codes(row, out);
    unreachable_bound(row, out);
    cut_values(row, out);
    off_grid(row, options, out);
    if (row.kind == OpKind::time && options.precision && row.field->kind != Kind::float64) {
        out.push_back({"time-precision", row.path,
                       "precision of an integer time counts digits of microseconds here; other "
                       "releases may differ"});
    }
    const bool fixed_bytes =
        row.kind == OpKind::text && row.field->kind == Kind::bytes &&
        row.max_bits == row.max_length * 8ULL + (row.has_presence_cost ? 1 : 0);
    if (fixed_bytes && row.max_length > 1) {
        out.push_back(
            {"length-lost", row.path,
             fmt::format("always {} bytes: shorter values come back with zeros behind them",
                         row.max_length)});
    }
}

void over_mtu(const Program& program, std::vector<Remark>& out) {
    const std::uint64_t head = (program.id_bits() + program.head_max_bits() + 7) / 8;
    for (const std::uint64_t mtu : mtus) {
        if (program.largest_bytes() <= mtu) continue;
        std::uint64_t bits = 0;
        std::string crossing;
        for (const FieldReport& row : program.report()) {
            if (row.in_head || row.lost || row.depth > 0) continue;
            bits += row.max_bits;
            if (head + (bits + 7) / 8 > mtu && crossing.empty()) crossing = row.path;
        }
        out.push_back({"over-mtu", crossing,
                       fmt::format("up to {} bytes, more than a frame of {} holds",
                                   program.largest_bytes(), mtu)});
    }
}

bool time_in_header(const Program& program) {
    const auto& head = program.head();
    return std::any_of(head.begin(), head.end(), [](const Op& op) {
        return op.kind == OpKind::time || (op.kind == OpKind::integer && op.number.width >= 16);
    });
}

}  // namespace

std::vector<Remark> lint(const Program& program) {
    std::vector<Remark> remarks;
    if (program.body_max_bits() > 0 && !time_in_header(program)) {
        remarks.push_back({"no-time-in-header", "",
                           "encrypted bodies of equal headers share a key stream: put a time, or a "
                           "sequence number of 16 bits, into the header"});
    }
    for (const FieldReport& row : program.report()) {
        field_remarks(row, program.codec_version(), remarks);
    }
    over_mtu(program, remarks);
    return remarks;
}

namespace {

/// The code of the value halfway between the bounds, as decode_integer and decode_float take it.
std::uint64_t middle_code(const NumberCode& n) {
    return static_cast<std::uint64_t>(std::floor((n.max - n.min) / n.resolution / 2));
}

/// Fills a message's fields with what is typical of them.
class Typical {
public:
    Typical(const Program& program, std::int64_t now_s, schema::Values& values)
        : program_(program), now_s_(now_s), values_(values) {}

    void steps(const std::vector<Op>& ops, std::size_t first, std::size_t last,
               std::uint32_t block) {
        for (std::size_t at = first; at < last; at = ops[at].end) {
            const Op& op = ops[at];
            const bool unknown = op.kind == OpKind::custom || op.condition >= 0;
            if (op.kind == OpKind::selectors || op.kind == OpKind::lost || unknown) continue;
            if (op.in_oneof && !first_member(op)) continue;
            const std::uint32_t slot = block + op.slot;
            if (!op.repeated) {
                one(ops, at, slot);
                continue;
            }
            const std::uint32_t count = std::max({1U, op.min_repeat, op.max_repeat / 4});
            const std::uint32_t list = values_[slot].present
                                           ? static_cast<std::uint32_t>(values_[slot].u)
                                           : values_.add_elements(slot, count);
            for (std::uint32_t k = 0; k < count; ++k) one(ops, at, list + k);
        }
    }

private:
    static bool first_member(const Op& op) {
        return op.field->descriptor->containing_oneof()->field(0) == op.field->descriptor;
    }

    void one(const std::vector<Op>& ops, std::size_t at, std::uint32_t slot) {
        const Op& op = ops[at];
        if (op.kind == OpKind::message) {
            const std::uint32_t block = values_[slot].present
                                            ? static_cast<std::uint32_t>(values_[slot].u)
                                            : values_.add_block(slot, *op.field->message);
            return steps(ops, at + 1, op.end, block);
        }
        if (op.kind == OpKind::text)
            return values_.set_text(slot, std::string((op.max_length + 1) / 2, 'x'));
        if (op.kind == OpKind::fixed_value && !program_.fixed_value(op).text.empty()) {
            return values_.set_text(slot, program_.fixed_value(op).text);
        }
        values_[slot].present = true;
        scalar(op, slot);
    }

    void scalar(const Op& op, std::uint32_t slot) {
        schema::Slot& s = values_[slot];
        const std::uint64_t middle = middle_code(op.number);
        switch (op.kind) {
            case OpKind::integer:
                s.i = decode_integer(op.number, middle);
                break;
            case OpKind::floating:
                s.d = decode_float(op.number, middle);
                break;
            case OpKind::enumeration:
                s.i = program_.enum_code(op).numbers.front();
                break;
            case OpKind::fixed_value:
                s.u = program_.fixed_value(op).value.u;
                break;
            case OpKind::time:
                if (op.field->kind == Kind::float64)
                    s.d = static_cast<double>(now_s_);
                else
                    s.i = now_s_ * 1'000'000;
                break;
            case OpKind::arithmetic:
                number(op, s, program_.model(op).value_bound.front());
                break;
            default:
                number(op, s, 1);
                break;
        }
    }

    static void number(const Op& op, schema::Slot& s, double x) {
        if (op.field->kind == Kind::float32 || op.field->kind == Kind::float64)
            s.d = x;
        else
            s.i = static_cast<std::int64_t>(x);
    }

    const Program& program_;
    std::int64_t now_s_;
    schema::Values& values_;
};

std::uint64_t plain_block(const schema::Values& values, const schema::Layout& layout,
                          std::uint32_t block) {
    std::uint64_t bytes = 0;
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        const schema::Field& f = layout.fields[k];
        const schema::Slot& slot = values[block + k];
        if (!slot.present) continue;
        const std::uint32_t count = f.repeated ? slot.aux : 1;
        for (std::uint32_t e = 0; e < count; ++e) {
            const schema::Slot& one =
                f.repeated ? values[static_cast<std::uint32_t>(slot.u) + e] : slot;
            switch (f.kind) {
                case Kind::message:
                    bytes += plain_block(values, *f.message, static_cast<std::uint32_t>(one.u));
                    break;
                case Kind::string:
                case Kind::bytes:
                    bytes += (one.aux + 3ULL) / 4 * 4;
                    break;
                case Kind::int64:
                case Kind::uint64:
                    bytes += 8;
                    break;
                default:
                    bytes += 4;
                    break;
            }
        }
    }
    return bytes;
}

}  // namespace

void typical_values(const Program& program, std::int64_t now_s, schema::Values& values) {
    values.reset(program.layout());
    Typical typical(program, now_s, values);
    typical.steps(program.head(), 0, program.head().size(), 0);
    typical.steps(program.body(), 0, program.body().size(), 0);
}

std::uint64_t plain_bytes(const schema::Values& values) {
    return plain_block(values, values.layout(), 0);
}

}  // namespace seautils::dccl
