#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"
#include "seautils/tdma/discovery.hpp"

#include <fmt/format.h>

#include <charconv>

namespace seautils::tdma {

namespace {

constexpr std::string_view title = "seautils tdma-slot state 1";

/// FNV-1a: finds what a torn or flipped byte does; it is no protection from anybody.
std::uint64_t check_of(std::string_view text) {
    std::uint64_t check = 0xcbf29ce484222325U;
    for (const char c : text) check = (check ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return check;
}

/// Takes what stands before the next `end` off the text.
std::string_view take(std::string_view& text, char end) {
    const std::size_t at = text.find(end);
    if (at == text.npos) throw DataError("the text is cut short");
    const std::string_view part = text.substr(0, at);
    text.remove_prefix(at + 1);
    return part;
}

std::int64_t number(std::string_view text, std::int64_t least, std::int64_t most) {
    std::int64_t x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size() || x < least || x > most)
        throw DataError(fmt::format("{} is outside {} to {}", quote(text), least, most));
    return x;
}

}  // namespace

std::string to_text(const Memory& memory) {
    std::string text = fmt::format("{}\nresume {}\n", title, memory.resume_ns);
    for (const Heard& heard : memory.others)
        text += fmt::format("heard {} {}\n", heard.address, heard.until_ns);
    return text + fmt::format("check {:016x}\n", check_of(text));
}

Memory parse_memory(std::string_view text) {
    constexpr std::int64_t latest = last_ns + max_cycle_ns;
    const std::string_view whole = text;
    if (take(text, '\n') != title) throw DataError("it is no state of tdma-slot");
    Memory memory;
    for (;;) {
        const std::size_t at = whole.size() - text.size();
        std::string_view line = take(text, '\n');
        const std::string_view word = take(line, ' ');
        if (word == "check") {
            if (line != fmt::format("{:016x}", check_of(whole.substr(0, at))))
                throw DataError("its check does not fit");
            if (!text.empty()) throw DataError("something follows its check");
            return memory;
        }
        if (word == "resume") {
            memory.resume_ns = number(line, 0, latest);
        } else if (word == "heard") {
            const auto address = static_cast<int>(number(take(line, ' '), 1, max_address));
            memory.others.push_back({address, number(line, 0, latest)});
        } else {
            throw DataError(quote(word) + " is none of resume, heard, check");
        }
    }
}

}  // namespace seautils::tdma
