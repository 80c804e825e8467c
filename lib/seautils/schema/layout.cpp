#include "seautils/core/error.hpp"
#include "seautils/schema/layout_set.hpp"

#include <algorithm>
#include <numeric>

namespace seautils::schema {

namespace {

constexpr std::size_t max_fields = 100'000;

template <class Less>
std::vector<std::uint32_t> sorted_indices(std::size_t count, Less less) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    std::stable_sort(indices.begin(), indices.end(), less);
    return indices;
}

}  // namespace

void fill_indices(Layout& layout) {
    layout.by_name.clear();
    for (Field& f : layout.fields) f.json_key = "\"" + f.name + "\":";
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        layout.by_name.emplace(layout.fields[k].name, k);
    }
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        if (!layout.fields[k].json_name.empty())
            layout.by_name.emplace(layout.fields[k].json_name, k);
    }
    for (std::uint32_t k = 0; k < layout.fields.size(); ++k) {
        const Field& f = layout.fields[k];
        if (f.required || f.kind == Kind::message) layout.to_check.push_back(k);
    }
    layout.by_number = sorted_indices(layout.fields.size(), [&](std::uint32_t a, std::uint32_t b) {
        return layout.fields[a].number < layout.fields[b].number;
    });
    layout.timestamp = layout.full_name == "google.protobuf.Timestamp" &&
                       layout.fields.size() == 2 && layout.fields[0].kind == Kind::int64 &&
                       layout.fields[1].kind == Kind::int32;
}

void fill_indices(EnumLayout& e) {
    e.by_name = sorted_indices(e.values.size(), [&](std::uint32_t a, std::uint32_t b) {
        return e.values[a].name < e.values[b].name;
    });
    e.by_number = sorted_indices(e.values.size(), [&](std::uint32_t a, std::uint32_t b) {
        return e.values[a].number < e.values[b].number;
    });
}

const EnumLayout::Value* EnumLayout::find(std::string_view name) const {
    const auto at =
        std::lower_bound(by_name.begin(), by_name.end(), name,
                         [&](std::uint32_t k, std::string_view n) { return values[k].name < n; });
    return at != by_name.end() && values[*at].name == name ? &values[*at] : nullptr;
}

const EnumLayout::Value* EnumLayout::find(std::int32_t number) const {
    const auto at =
        std::lower_bound(by_number.begin(), by_number.end(), number,
                         [&](std::uint32_t k, std::int32_t n) { return values[k].number < n; });
    return at != by_number.end() && values[*at].number == number ? &values[*at] : nullptr;
}

std::int32_t Layout::find(std::string_view name, std::uint32_t hint) const {
    if (hint < fields.size() && fields[hint].name == name) return static_cast<std::int32_t>(hint);
    const auto at = by_name.find(name);
    return at == by_name.end() ? -1 : static_cast<std::int32_t>(at->second);
}

std::int32_t Layout::search_number(std::int32_t number) const {
    const auto at =
        std::lower_bound(by_number.begin(), by_number.end(), number,
                         [&](std::uint32_t k, std::int32_t n) { return fields[k].number < n; });
    return at != by_number.end() && fields[*at].number == number ? static_cast<std::int32_t>(*at)
                                                                 : -1;
}

void LayoutSet::Impl::count_fields(std::size_t more) {
    fields += more;
    if (fields > max_fields) throw ConfigError("the schema has more than 100000 fields");
}

LayoutSet::LayoutSet() : impl_(std::make_unique<Impl>()) {}
LayoutSet::~LayoutSet() = default;
LayoutSet::LayoutSet(LayoutSet&&) noexcept = default;
LayoutSet& LayoutSet::operator=(LayoutSet&&) noexcept = default;

const Layout& LayoutSet::add(Layout layout) {
    impl_->count_fields(layout.fields.size());
    Layout& kept = impl_->layouts.emplace_back(std::move(layout));
    fill_indices(kept);
    return kept;
}

const EnumLayout& LayoutSet::add(EnumLayout enumeration) {
    EnumLayout& kept = impl_->enums.emplace_back(std::move(enumeration));
    fill_indices(kept);
    return kept;
}

}  // namespace seautils::schema
