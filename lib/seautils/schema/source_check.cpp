#include "seautils/schema/source_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace seautils::schema {

namespace {

constexpr std::size_t max_nesting = 64;
constexpr std::size_t max_word = 512;
constexpr std::size_t max_parts = 100;
constexpr std::size_t max_items = 1000;
constexpr std::uint64_t max_name_bytes = 1U << 27;

/// Where a comment or string that begins at `at` ends; `at` itself where none begins.
std::size_t skip_opaque(std::string_view text, std::size_t at) {
    if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
    if (text.substr(at, 2) == "/*") {
        const std::size_t end = text.find("*/", at + 2);
        return end == text.npos ? text.size() : end + 1;
    }
    if (text[at] != '"' && text[at] != '\'') return at;
    for (std::size_t k = at + 1; k < text.size(); ++k) {
        if (text[k] == text[at] || text[k] == '\n') return k;
        if (text[k] == '\\' && text.substr(k + 1, 1) != "\n") ++k;
    }
    return text.size();
}

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Counts, token by token, what the compiler would count too late.
class Counter {
public:
    const char* fault() const { return fault_; }

    void word(std::string_view text) {
        longest_ = std::max(longest_, text.size());
        name_bytes_ += (depth_[0] + 1) * longest_;
        if (longest_ > max_word) fault_ = "a name of more than 512 bytes";
        if (name_bytes_ > max_name_bytes) fault_ = "names of more than 128 MiB in all";
        if (text == "option" || text == "reserved" || text == "extensions") item();
    }

    void symbol(char c) {
        if (c == '.') {
            if (++parts_ > max_parts) fault_ = "a name of more than 100 parts";
            return;
        }
        parts_ = 0;
        if (c == ',') comma();
        if (const std::size_t kind = opening.find(c); kind != opening.npos) open(kind);
        if (const std::size_t kind = closing.find(c); kind != closing.npos && depth_[kind] > 0)
            --depth_[kind];
    }

private:
    static constexpr std::string_view opening = "{[(<", closing = "}])>";

    /// A bracket of another kind never closes this one: the compiler, which mends faults as it goes,
    /// may not take it for the end either.
    void open(std::size_t kind) {
        if (++depth_[kind] > max_nesting) {
            fault_ = "nested deeper than 64 brackets";
            return;
        }
        if (kind == 0) items_[depth_[0]] = 0;
        if (kind == 1 && depth_[1] == 1) elements_ = 0;
    }

    void comma() {
        if (depth_[1] > 0) {
            if (++elements_ >= max_items) fault_ = "more than 1000 elements in square brackets";
        } else if (depth_[3] == 0) {  // no map<K, V>
            item();
        }
    }

    void item() {
        if (++items_[depth_[0]] > max_items)
            fault_ = "more than 1000 options and reserved numbers in a block";
    }

    const char* fault_ = nullptr;
    std::array<std::size_t, 4> depth_{};                ///< of {}, [], (), <>
    std::array<std::size_t, max_nesting + 1> items_{};  ///< of each open block
    std::size_t elements_ = 0, parts_ = 0, longest_ = 0;
    std::uint64_t name_bytes_ = 0;
};

}  // namespace

std::string source_fault(std::string_view text) {
    if (text.find('\0') != text.npos) return "a NUL byte is in it";
    Counter counter;
    for (std::size_t at = 0; at < text.size() && counter.fault() == nullptr; ++at) {
        const std::size_t end = skip_opaque(text, at);
        if (end != at) {
            at = end;
        } else if (is_word(text[at])) {
            const std::size_t begin = at;
            while (at + 1 < text.size() && is_word(text[at + 1])) ++at;
            counter.word(text.substr(begin, at + 1 - begin));
        } else if (!is_space(text[at])) {
            counter.symbol(text[at]);
        }
    }
    return counter.fault() == nullptr ? "" : counter.fault();
}

}  // namespace seautils::schema
