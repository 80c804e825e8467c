// A tree of JSON, asked for its fields one by one: each refusal has the field's path.
#ifndef SEAUTILS_PROPAGATION_JSON_FIELDS_HPP
#define SEAUTILS_PROPAGATION_JSON_FIELDS_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seautils::propagation::json_fields {

using nlohmann::json;

inline constexpr std::uint64_t most_points = 2'000'000;

/// A value and the path to it.
class Value {
public:
    Value(const json& value, std::string path) : value_(&value), path_(std::move(path)) {}

    const json& raw() const { return *value_; }
    const std::string& path() const { return path_; }

    [[noreturn]] void refuse(const std::string& what) const { throw DataError(path_ + " " + what); }

    double number() const {
        if (!value_->is_number()) refuse(shown() + " is not a number");
        return value_->get<double>();
    }

    std::uint64_t whole(std::uint64_t least, std::uint64_t most) const {
        const double x = number();
        if (!(x >= static_cast<double>(least) && x <= static_cast<double>(most)) ||
            x != std::floor(x))
            refuse(fmt::format("{} is not a whole number of {} to {}", shown(), least, most));
        return static_cast<std::uint64_t>(x);
    }

    std::string text() const {
        if (!value_->is_string()) refuse(shown() + " is not a text");
        return value_->get<std::string>();
    }

    /// The one of these that the text names. @param names  several may mean the same
    template <class T>
    T one_of(std::initializer_list<std::pair<const char*, T>> names) const {
        const std::string said = text();
        std::string all;
        for (const auto& [name, meaning] : names) {
            if (said == name) return meaning;
            all.append(all.empty() ? "" : ", ").append(name);
        }
        refuse(quote(said) + " is none of " + all);
    }

    std::size_t length() const {
        if (!value_->is_array()) refuse(shown() + " is not a list");
        if (value_->size() > most_points)
            refuse(fmt::format("has {} elements, which is outside 0 to {}", value_->size(),
                               most_points));
        return value_->size();
    }

    Value operator[](std::size_t k) const {
        return {(*value_)[k], fmt::format("{}[{}]", path_, k)};
    }

    std::vector<double> numbers() const {
        std::vector<double> all(length());
        for (std::size_t k = 0; k < all.size(); ++k) {
            const json& element = (*value_)[k];
            all[k] = element.is_number() ? element.get<double>() : (*this)[k].number();
        }
        return all;
    }

    /// A list of N numbers each.
    template <std::size_t N>
    std::vector<std::array<double, N>> rows() const {
        std::vector<std::array<double, N>> all(length());
        for (std::size_t k = 0; k < all.size(); ++k) {
            const Value row = (*this)[k];
            if (row.length() != N)
                row.refuse(fmt::format("has {} elements in place of {}", row.length(), N));
            for (std::size_t i = 0; i < N; ++i) all[k][i] = row[i].number();
        }
        return all;
    }

private:
    std::string shown() const {
        if (value_->is_object()) return "an object";
        if (value_->is_array()) return "a list";
        return quote(value_->dump(-1, ' ', false, json::error_handler_t::replace));
    }

    const json* value_;
    std::string path_;
};

/// An object whose fields are asked for one by one.
class Object {
public:
    Object(const Value& value, std::vector<std::string>& remarks)
        : value_(value), remarks_(remarks) {
        if (value.raw().is_object()) return;
        throw DataError((value.path().empty() ? "the file" : value.path()) + " is not an object");
    }

    /// A field; none where it is absent or null.
    std::optional<Value> get(const char* key) {
        known_.push_back(key);
        const auto at = value_.raw().find(key);
        if (at == value_.raw().end() || at->is_null()) return std::nullopt;
        return Value(*at, path_of(key));
    }

    Value need(const char* key) {
        if (auto value = get(key)) return *value;
        throw DataError(path_of(key) + " is not given");
    }

    double number(const char* key, double otherwise) {
        const auto value = get(key);
        return value ? value->number() : otherwise;
    }

    /// Fields that say nothing of the sea.
    void known(std::initializer_list<const char*> keys) {
        known_.insert(known_.end(), keys.begin(), keys.end());
    }

    /// When all fields have been asked for: what else there is, is remarked.
    void end() const {
        for (const auto& [key, element] : value_.raw().items()) {
            const bool known = std::find(known_.begin(), known_.end(), key) != known_.end();
            if (known || element.is_null()) continue;
            const std::string near = nearest(key, known_);
            const std::string field = "field " + quote(path_of(key)) + " is not known";
            if (!near.empty()) throw DataError(field + " (did you mean " + quote(near) + "?)");
            if (remarks_.size() < 20) remarks_.push_back(field + ": left alone");
        }
    }

private:
    std::string path_of(const std::string& key) const {
        return value_.path().empty() ? key : value_.path() + "." + key;
    }

    Value value_;
    std::vector<std::string>& remarks_;
    std::vector<std::string> known_;
};

}  // namespace seautils::propagation::json_fields

#endif  // SEAUTILS_PROPAGATION_JSON_FIELDS_HPP
