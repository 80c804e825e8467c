#include "seautils/dccl/compiler.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/dccl/conditions.hpp"
#include "seautils/schema/values.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>

namespace seautils::dccl {

namespace {

constexpr int max_depth = 32;
constexpr std::size_t max_steps = 20000;
constexpr std::uint32_t max_repeats = 65536;
constexpr std::uint64_t max_message_bytes = 1U << 20;

/// No sum of sizes gets near this; a product is cut to it.
constexpr std::uint64_t too_many_bits = std::uint64_t{1} << 40;

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    return a == 0 || b <= too_many_bits / a ? std::min(a * b, too_many_bits) : too_many_bits;
}

}  // namespace

Compiler::Compiler(const schema::Layout& layout, const ProgramOptions& options)
    : layout_(layout),
      options_(options),
      root_(message_options(*layout.descriptor)),
      program_(new Program) {}

void Compiler::refuse(const std::string& path, const std::string& what) const {
    throw ConfigError(path.empty()
                          ? fmt::format("message {}: {}", layout_.full_name, what)
                          : fmt::format("message {}: field {}: {}", layout_.full_name, path, what));
}

std::shared_ptr<const Program> Compiler::run() {
    Program& p = *program_;
    p.layout_ = &layout_;
    identifier();
    if (!root_.codec_version) refuse("", "option codec_version is missing (2, 3 or 4)");
    p.version_ = *root_.codec_version;
    if (!root_.max_bytes) refuse("", "option max_bytes is missing");
    p.max_bytes_ = *root_.max_bytes;
    const std::string name = root_.codec         ? *root_.codec
                             : root_.codec_group ? *root_.codec_group
                                                 : fmt::format("dccl.default{}", p.version_);
    const auto codec = find_codec(name, p.version_);
    const bool known =
        codec && (codec->family == Family::standard || codec->family == Family::presence ||
                  codec->family == Family::native);
    if (p.version_ < 2 || p.version_ > 4 || !known) {
        refuse("",
               fmt::format("no codec {} for messages (codec_version {})", quote(name), p.version_));
    }
    if (count_slots(layout_, 0) > schema::Values::max_slots) {
        refuse("", fmt::format("more than {} values in one message", schema::Values::max_slots));
    }
    Place place;
    place.message_version = codec->family == Family::native ? 4 : codec->version;
    open_ = {&layout_};
    const Bits head = message(layout_, p.head_, place);
    place.pass = Part::body;
    const Bits body = message(layout_, p.body_, place);
    p.head_min_ = head.min;
    p.head_max_ = head.max;
    p.body_min_ = body.min;
    p.body_max_ = body.max;
    if (p.largest_bytes() > p.max_bytes_ || p.largest_bytes() > max_message_bytes) {
        refuse("", fmt::format("can take {} bytes, more than max_bytes {}", p.largest_bytes(),
                               std::min<std::uint64_t>(p.max_bytes_, max_message_bytes)));
    }
    p.pruning_ = pruning(layout_, 0);
    if (!p.hashes_.empty()) {
        const std::uint64_t value = p.definition_hash();
        for (HashCode& h : p.hashes_) h.value = value & ((std::uint64_t{1} << h.width) - 1);
    }
    return program_;
}

void Compiler::identifier() {
    Program& p = *program_;
    p.id_codec_ = options_.id_codec;
    p.omit_id_ = root_.omit_id && !options_.user_id;
    if (p.omit_id_) return;
    const auto id = options_.user_id ? options_.user_id : root_.id;
    if (!id) refuse("", "option id is missing (or omit_id)");
    p.id_ = *id;
    const bool ccl = options_.id_codec == IdCodec::ccl;
    if (ccl && (static_cast<std::uint32_t>(*id) >> 16) == 0x0CC1) {
        p.id_code_ = static_cast<std::uint32_t>(*id) & 0xff;
        p.id_bits_ = 8;
        return;
    }
    if (*id < 0 || *id > 32767) refuse("", fmt::format("id {} is outside 0 to 32767", *id));
    p.id_bits_ = *id < 128 ? 8 : 16;
    p.id_code_ = static_cast<std::uint32_t>(*id) * 2 + (*id < 128 ? 0 : 1);
    if (ccl) {
        p.id_code_ = p.id_code_ << 8 | 0x20;
        p.id_bits_ += 8;
    }
}

Compiler::Bits Compiler::message(const schema::Layout& layout, std::vector<Op>& ops,
                                 const Place& place) {
    if (!layout.oneofs.empty() && place.message_version < 4) {
        refuse(place.path, fmt::format("oneof '{}' needs codec_version 4 (proto3 optional is one)",
                                       layout.oneofs.front().name));
    }
    Bits sum;
    if (place.pass == Part::body && !layout.oneofs.empty()) sum = selectors(layout, ops);
    std::vector<std::uint64_t> largest_member(layout.oneofs.size());
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        field(layout, k, ops, place, sum, largest_member);
    }
    for (const std::uint64_t bits : largest_member) sum.max += bits;
    return sum;
}

Compiler::Bits Compiler::selectors(const schema::Layout& layout, std::vector<Op>& ops) {
    Op op;
    op.kind = OpKind::selectors;
    op.extra = static_cast<std::uint32_t>(program_->selectors_.size());
    SelectorCode code;
    Bits bits;
    for (const schema::Oneof& oneof : layout.oneofs) {
        const auto width =
            static_cast<std::uint8_t>(bits_for(static_cast<double>(oneof.fields.size() + 1)));
        code.oneofs.push_back({width, oneof.fields});
        bits.min += width;
    }
    bits.max = op.min_bits = op.max_bits = bits.min;
    program_->selectors_.push_back(std::move(code));
    op.end = static_cast<std::uint32_t>(ops.size()) + 1;
    ops.push_back(op);
    return bits;
}

/// Decides on the part that a field goes into; compiles it if this is the pass of that part.
void Compiler::field(const schema::Layout& layout, std::uint32_t index, std::vector<Op>& ops,
                     const Place& place, Bits& sum, std::vector<std::uint64_t>& largest_member) {
    const schema::Field& f = layout.fields[index];
    const FieldOptions options = field_options(*f.descriptor);
    if (options.omit) return;
    const bool is_message = f.kind == schema::Kind::message;
    Part part = place.part;
    if (part == Part::undetermined && (!is_message || options.in_head)) {
        part = options.in_head.value_or(false) ? Part::head : Part::body;
    }
    Place inside = place;
    // What encloses the message decides on the message, but its own in_head on what is inside.
    inside.part = part;
    if (is_message && options.in_head) inside.part = *options.in_head ? Part::head : Part::body;
    inside.path = place.path + f.name + (f.repeated ? "[]." : ".");
    inside.depth = place.depth + 1;
    inside.both_passes = false;
    bool here = part == place.pass;
    if (part == Part::undetermined) {
        const CodecChoice codec = choose(f, options, place.path + f.name);
        const bool split = codec.version == 2 && codec.family == Family::standard;
        inside.both_passes = place.both_passes && split;
        here = split || place.pass == Part::body;
    }
    if (!here) {
        if (!place.both_passes) add_lost(f, index, ops, place);
        return;
    }
    const std::size_t at = ops.size();
    add(f, index, options, ops, place, inside);
    const Op& op = ops[at];
    if (op.in_oneof) {
        auto& largest = largest_member[static_cast<std::size_t>(f.oneof)];
        largest = std::max(largest, op.max_bits);
    } else {
        sum.min += op.min_bits;
        sum.max = std::min(sum.max + op.max_bits, too_many_bits);
    }
    if (op.condition >= 0) {
        const ConditionCode& c = program_->conditions_[static_cast<std::size_t>(op.condition)];
        if ((c.asks_omit || c.asks_required) && place.message_version > 2) sum.min = 0;
    }
}

void Compiler::add_lost(const schema::Field& f, std::uint32_t index, std::vector<Op>& ops,
                        const Place& place) {
    Op op;
    op.kind = OpKind::lost;
    op.slot = index;
    op.repeated = f.repeated;
    op.field = &f;
    op.in_head = place.pass == Part::body && place.part == Part::undetermined;
    op.end = static_cast<std::uint32_t>(ops.size()) + 1;
    ops.push_back(op);
    FieldReport row;
    row.depth = place.depth;
    row.field = &f;
    row.path = place.path + f.name;
    row.lost = true;
    program_->report_.push_back(row);
}

namespace {

/// Of a sub-message, too: its fields are no steps.
bool takes_whole(const CodecChoice& codec) {
    return codec.family == Family::ccl || codec.family == Family::custom;
}

bool is_plain(const Op& op) {
    const bool own_way =
        op.kind == OpKind::arithmetic || op.kind == OpKind::fixed_value || op.kind == OpKind::hash;
    return !own_way && !op.repeated && !op.in_oneof && op.condition < 0;
}

}  // namespace

void Compiler::add(const schema::Field& f, std::uint32_t index, const FieldOptions& options,
                   std::vector<Op>& ops, const Place& place, const Place& inside) {
    const std::string path = place.path + f.name;
    if (++steps_ > max_steps) refuse(path, fmt::format("more than {} fields in all", max_steps));
    const CodecChoice codec = choose(f, options, path);
    Op op;
    op.slot = index;
    op.field = &f;
    op.repeated = f.repeated;
    op.in_oneof = f.oneof >= 0;
    op.required = is_required(f);
    conditions(op, options, path);
    const std::size_t at = ops.size();
    const std::size_t row = program_->report_.size();
    program_->report_.emplace_back();  // in front of those of its fields
    ops.push_back(op);
    const bool nested = f.kind == schema::Kind::message && !takes_whole(codec);
    const Bits bits =
        nested ? sub_message(op, codec, ops, inside, path) : element(op, options, codec, path);
    op.end = static_cast<std::uint32_t>(nested ? ops.size() : at + 1);
    repeat(op, options, bits, path);
    if (place.pass == Part::head && (op.in_oneof || op.min_bits != op.max_bits)) {
        refuse(path, op.in_oneof ? "a oneof member cannot be in the header"
                                 : "its size varies, which the header does not allow");
    }
    op.plain = is_plain(op);
    ops[at] = op;
    FieldReport& r = program_->report_[row];
    r = report(op, options);
    r.depth = place.depth;
    r.path = path;
    r.codec = codec.name;
    r.in_head = place.pass == Part::head;
}

Compiler::Bits Compiler::sub_message(Op& op, const CodecChoice& codec, std::vector<Op>& ops,
                                     const Place& inside, const std::string& path) {
    const schema::Field& f = *op.field;
    if (std::find(open_.begin(), open_.end(), f.message) != open_.end()) {
        refuse(path, fmt::format("message {} contains itself", f.message->full_name));
    }
    if (open_.size() >= max_depth) refuse(path, fmt::format("nested deeper than {}", max_depth));
    open_.push_back(f.message);
    Place child = inside;
    child.message_version = codec.family == Family::native ? 4 : codec.version;
    op.kind = OpKind::message;
    op.drop_empty = child.message_version == 2;
    if (child.message_version == 3) op.presence_bit = !f.required && !f.repeated;
    if (child.message_version == 4) op.presence_bit = !op.required && !f.required && !f.repeated;
    const Bits bits = message(*f.message, ops, child);
    open_.pop_back();
    op.element_min_bits = bits.min;
    return op.presence_bit ? Bits{1, bits.max + 1} : bits;
}

/// What the step itself says of its field.
FieldReport Compiler::report(const Op& op, const FieldOptions& options) {
    FieldReport r;
    r.field = op.field;
    r.kind = op.kind;
    r.number = op.number;
    r.min_bits = op.min_bits;
    r.max_bits = op.max_bits;
    r.min_repeat = op.repeated ? op.min_repeat : 0;
    r.max_repeat = op.repeated ? op.max_repeat : 0;
    r.has_bounds = options.min.has_value() && options.max.has_value();
    r.min = options.min.value_or(0);
    r.max = options.max.value_or(0);
    r.resolution = op.number.resolution;
    r.unit = options.unit;
    r.max_length = options.max_length.value_or(0);
    r.has_presence_cost = op.presence_bit || op.number.null_code;
    r.has_conditions = op.condition >= 0;
    return r;
}

CodecChoice Compiler::choose(const schema::Field& f, const FieldOptions& options,
                             const std::string& path) const {
    std::string name;
    if (options.codec) name = *options.codec;
    if (name.empty() && f.kind == schema::Kind::message) {
        name = message_options(*f.message->descriptor).codec.value_or("");
    }
    if (name.empty()) name = root_.codec_group.value_or("");
    if (name.empty()) name = fmt::format("dccl.default{}", program_->version_);
    auto codec = find_codec(name, program_->version_);
    if (!codec && options_.field_codecs.contains(name)) {
        codec.emplace();
        codec->family = Family::custom;
        codec->name = name;
    }
    if (!codec || !fits(*codec, f)) {
        refuse(path, fmt::format("no codec {} for its type (codec_version {})", quote(name),
                                 program_->version_));
    }
    return *codec;
}

bool Compiler::is_required(const schema::Field& f) const {
    if (program_->version_ == 2) return f.required && !f.repeated;
    if (program_->version_ == 3) return f.required || f.repeated;
    return f.required || f.repeated || f.oneof >= 0;
}

void Compiler::repeat(Op& op, const FieldOptions& options, Bits bits, const std::string& path) {
    op.min_bits = bits.min;
    op.max_bits = bits.max;
    if (!op.repeated) return;
    if (op.field->descriptor->is_map()) refuse(path, "map fields have no bounds and no codec");
    if (!options.max_repeat) refuse(path, "option max_repeat is missing");
    if (*options.max_repeat < 1 || *options.max_repeat > max_repeats) {
        refuse(path,
               fmt::format("max_repeat {} is outside 1 to {}", *options.max_repeat, max_repeats));
    }
    if (options.min_repeat > *options.max_repeat) {
        refuse(path, fmt::format("min_repeat {} is above max_repeat {}", options.min_repeat,
                                 *options.max_repeat));
    }
    op.max_repeat = *options.max_repeat;
    op.min_repeat = options.min_repeat;
    if (op.kind == OpKind::arithmetic) return;  // one run for all, which counts by itself
    op.counted = program_->version_ > 2;
    if (op.counted) {
        op.count_width = static_cast<std::uint8_t>(bits_for(op.max_repeat - op.min_repeat + 1.0));
    }
    const std::uint64_t fewest = op.counted ? op.min_repeat : op.max_repeat;
    op.min_bits = op.count_width + times(bits.min, fewest);
    op.max_bits = op.count_width + times(bits.max, op.max_repeat);
}

void Compiler::conditions(Op& op, const FieldOptions& options, const std::string& path) {
    if (!options.conditions) return;
    ConditionCode c;
    c.scripts = *options.conditions;
    const bool newer = program_->version_ > 2;
    c.asks_omit =
        (!c.scripts.omit_if.empty() || !c.scripts.only_if.empty()) && (newer || op.repeated);
    c.asks_required = (!c.scripts.required_if.empty() || !c.scripts.only_if.empty()) && newer;
    c.asks_bounds = !c.scripts.min.empty() || !c.scripts.max.empty();
    if (op.field->kind == schema::Kind::message && program_->version_ == 4 &&
        (!c.scripts.required_if.empty() || !c.scripts.only_if.empty())) {
        refuse(path, "required_if or only_if on a sub-message asks about what it decides on");
    }
    ConditionEngine engine;
    for (const std::string* script : {&c.scripts.required_if, &c.scripts.omit_if,
                                      &c.scripts.only_if, &c.scripts.min, &c.scripts.max}) {
        try {
            if (!script->empty()) engine.check(*script);
        } catch (const ConfigError& e) {
            refuse(path, e.what());
        }
    }
    op.condition = static_cast<std::int32_t>(program_->conditions_.size());
    program_->conditions_.push_back(c);
}

std::vector<Pruning> Compiler::pruning(const schema::Layout& layout, int depth) {
    std::vector<Pruning> all;
    for (std::uint32_t k = 0; k < layout.fields.size() && depth < max_depth; ++k) {
        const schema::Field& f = layout.fields[k];
        if (f.kind != schema::Kind::message) continue;
        const FieldOptions options = field_options(*f.descriptor);
        if (options.omit) continue;
        if (++steps_ > 3 * max_steps) refuse(f.name, fmt::format("more than {} fields", max_steps));
        const CodecChoice codec = choose(f, options, f.name);
        if (takes_whole(codec)) continue;
        Pruning one{k, f.repeated, codec.family == Family::standard && codec.version == 2,
                    f.message, pruning(*f.message, depth + 1)};
        if (one.drop_empty || !one.below.empty()) all.push_back(std::move(one));
    }
    return all;
}

std::uint64_t Compiler::count_slots(const schema::Layout& layout, int depth) {
    if (depth > max_depth) return 0;  // refused later, with its path
    std::uint64_t sum = layout.fields.size();
    for (const schema::Field& f : layout.fields) {
        if (sum > schema::Values::max_slots) return sum;
        if (f.kind != schema::Kind::message && !f.repeated) continue;
        const FieldOptions options = field_options(*f.descriptor);
        if (options.omit) continue;
        std::uint64_t one = f.repeated ? 1 : 0;
        const bool again = std::find(open_.begin(), open_.end(), f.message) != open_.end();
        if (f.kind == schema::Kind::message && !again) {
            open_.push_back(f.message);
            one += count_slots(*f.message, depth + 1);
            open_.pop_back();
        }
        sum += times(one, f.repeated ? options.max_repeat.value_or(1) : 1);
    }
    return sum;
}

}  // namespace seautils::dccl
