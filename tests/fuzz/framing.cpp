// Any bytes as a stream: lines are those that a plain split gives, however small the limit;
// delimited records end in a refusal or at the end. Input: a byte for the limit, then the stream.
#include "common.hpp"

#include "seautils/stream/hex.hpp"
#include "seautils/stream/input.hpp"
#include "seautils/stream/output.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <vector>

using namespace seautils;

namespace {

int file_of(std::string_view bytes) {
    const int fd = ::memfd_create("stream", 0);
    fuzz::require(fd >= 0, "a file in memory");
    fuzz::require(::write(fd, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
                  "a file in memory takes all");
    ::lseek(fd, 0, SEEK_SET);
    return fd;
}

/// What lines there are; one that is too long is "!".
std::vector<std::string> plain_lines(std::string_view bytes, std::size_t limit) {
    std::vector<std::string> lines;
    while (!bytes.empty()) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        const bool has_end = end < bytes.size();
        if (has_end && line.ends_with('\r')) line.remove_suffix(1);
        if (!has_end && line.ends_with('\r')) line.remove_suffix(1);
        lines.emplace_back(line.size() > limit ? "!" : line);
        bytes.remove_prefix(has_end ? end + 1 : end);
    }
    return lines;
}

std::vector<std::string> read_lines(std::string_view bytes, std::size_t limit) {
    stream::Input input(file_of(bytes), "", {limit, false, {}});
    std::vector<std::string> lines;
    std::string_view line;
    for (;;) {
        const auto got = input.line(line);
        if (got == stream::Input::Got::end) return lines;
        lines.emplace_back(got == stream::Input::Got::too_long ? "!" : line);
    }
}

void delimited(std::string_view bytes, std::size_t limit) {
    stream::Input input(file_of(bytes), "", {limit, false, {}});
    std::string again;
    std::string_view record;
    const bool whole = fuzz::accepted([&] {
        while (input.record(record) != stream::Input::Got::end) {
            fuzz::require(record.size() <= limit, "no record above the limit");
            stream::append_delimited(again, record);
        }
    });
    // A length may be written in more bytes than it takes: then what comes out is shorter.
    if (whole) fuzz::require(again.size() <= bytes.size(), "nothing is invented");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t limit = 1 + data[0];
    const std::string_view bytes = fuzz::view(data + 1, size - 1);
    fuzz::require(read_lines(bytes, limit) == plain_lines(bytes, limit), "lines are as split");
    delimited(bytes, limit);
    return 0;
}
