#include "seautils/record/codec.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/record/fields.hpp"
#include "seautils/schema/json.hpp"
#include "seautils/schema/message.hpp"
#include "seautils/schema/values.hpp"
#include "seautils/stream/hex.hpp"

#include <map>
#include <optional>
#include <string>
#include <type_traits>

namespace seautils::record {

namespace {

using schema::Values;

template <class T>
struct Inner {
    using Type = T;
    static constexpr bool repeated = false;
};
template <class T>
struct Inner<std::optional<T>> : Inner<T> {};
template <class T>
struct Inner<std::vector<T>> {
    using Type = T;
    static constexpr bool repeated = true;
};

// ---- the layout, made of the structs ----

class Maker {
public:
    Maker() {
        schema::Layout root;
        root.full_name = "seautils.Record";
        root.oneofs.push_back({"kind", {}, false});
        add<UtcTime>(root, 1, "time");
        kinds([&]<class Struct>(std::int32_t number, const char* name, Of<Struct>) {
            root.oneofs[0].fields.push_back(static_cast<std::uint32_t>(root.fields.size()));
            add<Struct>(root, number, name).oneof = 0;
        });
        add<std::string>(root, 98, "as_json");
        add<std::string>(root, 99, "as_binary").kind = schema::Kind::bytes;
        root_ = &set_.add(std::move(root));
    }

    const schema::Layout& root() const { return *root_; }

private:
    template <class Member>
    schema::Field& add(schema::Layout& layout, std::int32_t number, const char* name) {
        using T = typename Inner<Member>::Type;
        schema::Field f;
        f.number = number;
        f.name = name;
        f.repeated = Inner<Member>::repeated;
        describe(f, static_cast<T*>(nullptr));
        return layout.fields.emplace_back(std::move(f));
    }

    static void describe(schema::Field& f, const std::uint32_t*) { f.kind = schema::Kind::uint32; }
    static void describe(schema::Field& f, const std::int32_t*) { f.kind = schema::Kind::int32; }
    static void describe(schema::Field& f, const bool*) { f.kind = schema::Kind::boolean; }
    static void describe(schema::Field& f, const double*) {
        f.kind = schema::Kind::float64;
        f.wire_form = schema::WireForm::fixed64;
    }
    static void describe(schema::Field& f, const std::string*) {
        f.kind = schema::Kind::string;
        f.wire_form = schema::WireForm::length;
    }
    void describe(schema::Field& f, const UtcTime*) { message(f, timestamp()); }
    template <class T>
    void describe(schema::Field& f, const T*) {
        if constexpr (std::is_enum_v<T>) {
            f.kind = schema::Kind::enumeration;
            f.enumeration = &enumeration<T>();
        } else {
            message(f, of<T>());
        }
    }
    static void message(schema::Field& f, const schema::Layout& layout) {
        f.kind = schema::Kind::message;
        f.wire_form = schema::WireForm::length;
        f.message = &layout;
    }

    const schema::Layout& timestamp() {
        const schema::Layout*& known = layouts_["google.protobuf.Timestamp"];
        if (known != nullptr) return *known;
        schema::Layout layout;
        layout.full_name = "google.protobuf.Timestamp";
        for (const auto& [name, kind] :
             {std::pair{"seconds", schema::Kind::int64}, {"nanos", schema::Kind::int32}}) {
            schema::Field f;
            f.number = static_cast<std::int32_t>(layout.fields.size()) + 1;
            f.name = name;
            f.kind = kind;
            f.has_presence = false;  // proto3
            layout.fields.push_back(f);
        }
        return *(known = &set_.add(std::move(layout)));
    }

    template <class Struct>
    const schema::Layout& of() {
        const schema::Layout*& known = layouts_[Names<Struct>::full_name];
        if (known != nullptr) return *known;
        schema::Layout layout;
        layout.full_name = Names<Struct>::full_name;
        fields(Of<Struct>(), [&]<class Member, class... Tag>(std::int32_t number, const char* name,
                                                             Member Struct::*, Tag...) {
            schema::Field& f = add<Member>(layout, number, name);
            if (sizeof...(Tag) > 0) f.kind = schema::Kind::bytes;
        });
        return *(known = &set_.add(std::move(layout)));
    }

    template <class Enum>
    const schema::EnumLayout& enumeration() {
        const schema::EnumLayout*& known = enums_[Names<Enum>::full_name];
        if (known != nullptr) return *known;
        schema::EnumLayout e;
        e.full_name = Names<Enum>::full_name;
        for (const std::string_view name : Names<Enum>::values)
            e.values.push_back({std::string(name), static_cast<std::int32_t>(e.values.size())});
        return *(known = &set_.add(std::move(e)));
    }

    schema::LayoutSet set_;
    std::map<std::string_view, const schema::Layout*> layouts_;
    std::map<std::string_view, const schema::EnumLayout*> enums_;
    const schema::Layout* root_ = nullptr;
};

// ---- structs to slots ----

class Putter {
public:
    explicit Putter(Values& values) : values_(values) {}

    template <class Struct>
    void message(const Struct& from, const schema::Layout& layout, std::uint32_t block) {
        std::uint32_t k = 0;
        fields(Of<Struct>(), [&](std::int32_t, const char*, auto member, auto...) {
            field(from.*member, layout.fields[k], block + k);
            ++k;
        });
    }

    template <class T>
    void field(const T& from, const schema::Field& f, std::uint32_t slot) {
        if constexpr (std::is_same_v<T, std::string>) {
            if (!from.empty()) values_.set_text(slot, from);
        } else {
            element(from, f, slot);
        }
    }
    template <class T>
    void field(const std::optional<T>& from, const schema::Field& f, std::uint32_t slot) {
        if (from) element(*from, f, slot);
    }
    template <class T>
    void field(const std::vector<T>& from, const schema::Field& f, std::uint32_t slot) {
        if (from.empty()) return;
        const auto count = static_cast<std::uint32_t>(from.size());
        const std::uint32_t first = values_.add_elements(slot, count);
        for (std::uint32_t k = 0; k < count; ++k) element(from[k], f, first + k);
    }

private:
    template <class T>
    void element(const T& from, const schema::Field& f, std::uint32_t slot) {
        if constexpr (std::is_same_v<T, std::string>) {
            values_.set_text(slot, from);
        } else if constexpr (std::is_same_v<T, UtcTime>) {
            time(from, f, slot);
        } else if constexpr (std::is_class_v<T>) {
            message(from, *f.message, values_.add_block(slot, *f.message));
        } else {
            number(from, values_[slot]);
        }
    }

    void time(UtcTime from, const schema::Field& f, std::uint32_t slot) {
        const std::uint32_t block = values_.add_block(slot, *f.message);
        const std::int64_t seconds = from.ns / 1'000'000'000;
        const std::int64_t nanos = from.ns % 1'000'000'000;
        if (seconds != 0) number(seconds, values_[block]);
        if (nanos != 0) number(nanos, values_[block + 1]);
    }

    template <class T>
    static void number(T from, schema::Slot& slot) {
        if constexpr (std::is_same_v<T, double>)
            slot.d = from;
        else if constexpr (std::is_same_v<T, std::uint32_t>)
            slot.u = from;
        else
            slot.i = static_cast<std::int64_t>(from);
        slot.present = true;
    }

    Values& values_;
};

// ---- slots to structs ----

class Getter {
public:
    explicit Getter(const Values& values) : values_(values) {}

    template <class Struct>
    void message(Struct& to, std::uint32_t block) const {
        std::uint32_t slot = block;
        fields(Of<Struct>(), [&](std::int32_t, const char*, auto member, auto...) {
            field(to.*member, values_[slot++]);
        });
    }

    template <class T>
    void field(T& to, const schema::Slot& slot) const {
        if (slot.present) element(to, slot);
    }
    template <class T>
    void field(std::optional<T>& to, const schema::Slot& slot) const {
        if (slot.present) element(to.emplace(), slot);
    }
    template <class T>
    void field(std::vector<T>& to, const schema::Slot& slot) const {
        if (!slot.present) return;
        to.resize(slot.aux);
        for (std::uint32_t k = 0; k < slot.aux; ++k)
            element(to[k], values_[static_cast<std::uint32_t>(slot.u) + k]);
    }

private:
    template <class T>
    void element(T& to, const schema::Slot& slot) const {
        if constexpr (std::is_same_v<T, std::string>)
            to = values_.text(slot);
        else if constexpr (std::is_same_v<T, UtcTime>)
            to = time(static_cast<std::uint32_t>(slot.u));
        else if constexpr (std::is_class_v<T>)
            message(to, static_cast<std::uint32_t>(slot.u));
        else if constexpr (std::is_same_v<T, double>)
            to = slot.d;
        else
            to = static_cast<T>(slot.i);
    }

    UtcTime time(std::uint32_t block) const {
        const std::int64_t seconds = values_[block].i, nanos = values_[block + 1].i;
        if (seconds < 0 || seconds > 9'223'372'035 || nanos < 0 || nanos > 999'999'999)
            throw DataError("a time is outside the years 1970 to 2262");
        return {seconds * 1'000'000'000 + nanos};
    }

    const Values& values_;
};

// ---- sizes ----

std::size_t framed_bytes(std::size_t bytes, Form form) {
    return bytes + (form == Form::ndjson || bytes < 128 ? 1 : 2);
}

void check_size(std::size_t framed, std::string_view what) {
    if (framed <= max_bytes) return;
    throw DataError(std::string(what) + " of " + counted(framed, "byte") + " is longer than " +
                    std::to_string(max_bytes) + " bytes");
}

void append_framed(std::string& out, std::string_view bytes, Form form) {
    check_size(framed_bytes(bytes.size(), form), "record");
    if (form == Form::delimited) return stream::append_delimited(out, bytes);
    out += bytes;
    out += '\n';
}

constexpr std::uint32_t time_slot = 0;
constexpr std::uint32_t first_kind = 1;
constexpr auto kind_count =
    static_cast<std::uint32_t>(std::variant_size_v<decltype(Record::kind)> - 1);
constexpr std::uint32_t as_json_slot = first_kind + kind_count;
constexpr std::uint32_t as_binary_slot = as_json_slot + 1;

Form other(Form form) { return form == Form::ndjson ? Form::delimited : Form::ndjson; }

/// Where a record of this form holds one that was written in the other.
std::uint32_t packing(Form form) { return form == Form::delimited ? as_json_slot : as_binary_slot; }

}  // namespace

const schema::Layout& layout() {
    static const Maker made;
    return made.root();
}

struct Codec::Impl {
    schema::JsonReader json;
    Values values;
    std::string bytes;

    /// Fills `values`. @return whether all was known
    bool parse(std::string_view text, Form form) {
        check_size(framed_bytes(text.size(), form), "record");
        if (form == Form::delimited) return schema::read_binary(text, layout(), values);
        return json.read(text, layout(), values, schema::Unknown::skip);
    }

    /// What a record is once it is out of the packing that a converter put around it.
    struct Opened {
        bool all_known = false;             ///< the other form can say all of it
        std::optional<std::string> packed;  ///< as it was written in the other form
    };

    /// parse(), where a packing that means something in the other form only counts as not known.
    bool parse_bare(std::string_view text, Form form) {
        return parse(text, form) && !values[packing(other(form))].present;
    }

    /// Fills `values` with the record itself.
    Opened open(std::string_view text, Form form) {
        const bool all_known = parse_bare(text, form);
        if (!values[packing(form)].present) return {all_known, std::nullopt};
        std::string packed(values.text(values[packing(form)]));
        if (form == Form::delimited && packed.find('\n') != std::string::npos)
            throw DataError("as_json: more than one line");
        const bool inner_known = parse_bare(packed, other(form));
        if (values[packing(other(form))].present)
            throw DataError("a record is packed in a packed one");
        return {inner_known, std::move(packed)};
    }

    void serialize(Form form) {
        bytes.clear();
        form == Form::ndjson ? schema::write_json(values, bytes)
                             : schema::write_binary(values, bytes);
    }

    void get(Record& record, bool all_known) const;
    void put(const Record& record);
};

void Codec::Impl::get(Record& record, bool all_known) const {
    const Getter getter(values);
    record.time = {};
    record.kind.emplace<std::monostate>();
    getter.field(record.time, values[time_slot]);
    std::uint32_t slot = first_kind;
    kinds([&]<class Struct>(std::int32_t, const char*, Of<Struct>) {
        const schema::Slot& kind = values[slot++];
        if (!kind.present) return;
        all_known = false;
        getter.message(record.kind.emplace<Struct>(), static_cast<std::uint32_t>(kind.u));
    });
    if (all_known) throw DataError("the record is of no kind: there is only a time, or nothing");
}

void Codec::Impl::put(const Record& record) {
    values.reset(layout());
    Putter putter(values);
    putter.field(record.time, layout().fields[time_slot], time_slot);
    std::visit(
        [&]<class Struct>(const Struct& kind) {
            if constexpr (std::is_same_v<Struct, std::monostate>) {
                throw DataError("the record is of no kind");
            } else {
                const auto slot = static_cast<std::uint32_t>(record.kind.index());
                putter.field(kind, layout().fields[slot], slot);
            }
        },
        record.kind);
}

Codec::Codec() : impl_(std::make_unique<Impl>()) {}
Codec::~Codec() = default;
Codec::Codec(Codec&&) noexcept = default;
Codec& Codec::operator=(Codec&&) noexcept = default;

void Codec::read(std::string_view text, Form form, Record& record) {
    impl_->get(record, impl_->open(text, form).all_known);
}

void Codec::write(const Record& record, Form form, std::string& out) {
    impl_->put(record);
    impl_->serialize(form);
    check_size(framed_bytes(impl_->bytes.size(), form), kind_name(record));
    append_framed(out, impl_->bytes, form);
}

void Codec::convert(std::string_view text, Form from, Form to, std::string& out) {
    if (from == to) return append_framed(out, text, to);
    const Impl::Opened opened = impl_->open(text, from);
    if (opened.packed) return append_framed(out, *opened.packed, to);
    if (!opened.all_known) {
        impl_->values.reset(layout());
        impl_->values.set_text(packing(to), text);
    }
    impl_->serialize(to);
    append_framed(out, impl_->bytes, to);
}

std::string_view kind_name(const Record& record) {
    const std::size_t index = record.kind.index();
    return index == 0 ? "unknown" : std::string_view(layout().fields[index].name);
}

}  // namespace seautils::record
