// Lines and records, whatever the pieces in which the bytes come.
#include "seautils/core/error.hpp"
#include "seautils/stream/hex.hpp"
#include "seautils/stream/input.hpp"
#include "temp_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace seautils::stream {
namespace {

using Strings = std::vector<std::string>;
using Got = Input::Got;

int file_of(std::string_view bytes) {
    const int fd = ::memfd_create("input", MFD_CLOEXEC);
    EXPECT_EQ(::write(fd, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    ::lseek(fd, 0, SEEK_SET);
    return fd;
}

/// The reading end of a socket that gives each piece to one read(2), and then the end.
int socket_of(const Strings& pieces) {
    int ends[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
    for (const std::string& piece : pieces) {
        if (piece.empty()) continue;
        EXPECT_EQ(::send(ends[1], piece.data(), piece.size(), 0),
                  static_cast<ssize_t>(piece.size()));
    }
    ::close(ends[1]);
    return ends[0];
}

/// The lines; one that is too long is "<too long>".
Strings lines_of(int fd, std::size_t max_record = 1U << 20) {
    Input input(fd, "", {max_record, false, {}});
    Strings lines;
    std::string_view line;
    for (;;) {
        const Got got = input.line(line);
        if (got == Got::end) return lines;
        lines.emplace_back(got == Got::too_long ? "<too long>" : line);
    }
}

/// The records; at the end, behind "!", why reading stopped before the end.
Strings records_of(int fd, std::size_t max_record = 1U << 20) {
    Input input(fd, "", {max_record, false, {}});
    Strings records;
    std::string_view record;
    try {
        while (input.record(record) == Got::record) records.emplace_back(record);
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::data);
        records.push_back(std::string("!") + e.what());
    }
    return records;
}

/// Cuts the bytes at random places, into no more pieces than a socket holds.
Strings pieces_of(const std::string& bytes) {
    Strings pieces;
    const std::size_t largest = 20 + bytes.size() / 50;
    for (std::size_t at = 0; at < bytes.size();) {
        const auto size = *rc::gen::inRange<std::size_t>(1, largest);
        pieces.push_back(bytes.substr(at, size));
        at += size;
    }
    return pieces;
}

}  // namespace

TEST(StreamInput, Lines) {
    EXPECT_EQ(lines_of(file_of("")), Strings{});
    EXPECT_EQ(lines_of(file_of("a\nb\n")), (Strings{"a", "b"}));
    EXPECT_EQ(lines_of(file_of("a\nb")), (Strings{"a", "b"}));
    EXPECT_EQ(lines_of(file_of("\n\na\n\n")), (Strings{"", "", "a", ""}));
    EXPECT_EQ(lines_of(file_of("a\r\nb\r\r\nc\rd\n\r")), (Strings{"a", "b\r", "c\rd", ""}));
    EXPECT_EQ(lines_of(file_of(std::string_view("a\0b\n\0", 5))),
              (Strings{std::string("a\0b", 3), std::string(1, '\0')}));
}

TEST(StreamInput, ALineAboveTheLimitIsSkippedWhole) {
    EXPECT_EQ(lines_of(file_of("abc\nabcd\nab\n"), 3), (Strings{"abc", "<too long>", "ab"}));
    EXPECT_EQ(lines_of(file_of("abc\r\nabcd\r\nab"), 3), (Strings{"abc", "<too long>", "ab"}));
    EXPECT_EQ(lines_of(file_of("abcd"), 3), Strings{"<too long>"});
    EXPECT_EQ(lines_of(file_of("abc"), 3), Strings{"abc"});
    EXPECT_EQ(
        lines_of(file_of(std::string(500'000, 'x') + "\nshort\n" + std::string(500'000, 'y')), 100),
        (Strings{"<too long>", "short", "<too long>"}));
}

TEST(StreamInput, LinesLongerThanABlock) {
    const std::string a(200'000, 'a'), b(65'536, 'b'), c(1'000'000, 'c');
    EXPECT_EQ(lines_of(file_of(a + "\n" + b + "\r\n\n" + c)), (Strings{a, b, "", c}));
}

TEST(StreamInput, CountAndOffsetAreOfTheLastLine) {
    Input input(file_of("one\r\n\nfour\nlonger than ten\nend"), "", {10, false, {}});
    std::string_view line;
    const std::vector<std::uint64_t> offsets{0, 5, 6, 11, 27};
    for (std::size_t k = 0; k < offsets.size(); ++k) {
        ASSERT_NE(input.line(line), Got::end);
        EXPECT_EQ(input.count(), k + 1);
        EXPECT_EQ(input.offset(), offsets[k]);
    }
    EXPECT_EQ(line, "end");
    EXPECT_EQ(input.line(line), Got::end);
    EXPECT_EQ(input.line(line), Got::end);
    EXPECT_EQ(input.bytes_read(), 30U);
}

TEST(StreamInput, BytesBehindALineMayBeRead) {
    for (const std::size_t size : {0U, 1U, 65'535U, 65'536U, 131'072U, 131'100U}) {
        Input input(file_of(std::string(size, 'x')), "", {1U << 20, false, {}});
        std::string_view line;
        if (input.line(line) == Got::end) continue;
        unsigned sum = 0;
        for (int k = 0; k < 64; ++k) sum += static_cast<unsigned char>(line.end()[k]);
        EXPECT_LE(sum, 64U * 255U);  // a sanitizer sees a byte too far
    }
}

/// The law: in whatever pieces the bytes come, the lines are the same.
TEST(StreamInput, PiecesMakeNoDifferenceToLines) {
    EXPECT_TRUE(rc::check("lines", [] {
        const auto bytes =
            *rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab\r\n")));
        const auto limit = *rc::gen::inRange<std::size_t>(1, 9);
        RC_ASSERT(lines_of(socket_of(pieces_of(bytes)), limit) == lines_of(file_of(bytes), limit));
    }));
}

TEST(StreamInput, Records) {
    EXPECT_EQ(records_of(file_of("")), Strings{});
    EXPECT_EQ(records_of(file_of(std::string_view("\x01"
                                                  "a\0\x02"
                                                  "bc",
                                                  6))),
              (Strings{"a", "", "bc"}));
    // A length in more bytes than it takes is one all the same.
    EXPECT_EQ(records_of(file_of(std::string_view("\x81\x80\x00"
                                                  "a",
                                                  4))),
              Strings{"a"});
}

TEST(StreamInput, CutRecordsAreSaid) {
    EXPECT_EQ(records_of(file_of("\x01"
                                 "a\x03"
                                 "bc")),
              (Strings{"a", "!the stream ends after 2 of the record's 3 bytes"}));
    EXPECT_EQ(records_of(file_of("\x03")),
              Strings{"!the stream ends after 0 of the record's 3 bytes"});
    EXPECT_EQ(records_of(file_of("\x80")),
              Strings{"!the stream ends within the length of a record"});
    EXPECT_EQ(records_of(file_of("\xff\xff\xff\xff\xff")),
              Strings{"!no length of a record stands here"});
    EXPECT_EQ(records_of(file_of("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01")),
              Strings{"!no length of a record stands here"});
    EXPECT_EQ(records_of(file_of("\xff\xff\xff\xff\x0f")),
              Strings{"!record of 4294967295 bytes is longer than 1048576 bytes (--max-record)"});
    EXPECT_EQ(records_of(file_of("\x02"
                                 "ab\x03"
                                 "abc"),
                         2),
              (Strings{"ab", "!record of 3 bytes is longer than 2 bytes (--max-record)"}));
}

TEST(StreamInput, AFaultIsCountedAtItsByte) {
    Input input(file_of("\x02"
                        "ab\x05"
                        "abc"),
                "", {1U << 20, false, {}});
    std::string_view record;
    EXPECT_EQ(input.record(record), Got::record);
    EXPECT_EQ(input.count(), 1U);
    EXPECT_EQ(input.offset(), 0U);
    EXPECT_THROW(input.record(record), Error);
    EXPECT_EQ(input.count(), 2U);
    EXPECT_EQ(input.offset(), 3U);
}

/// The law: records come out as they went in, in whatever pieces the bytes come, and a cut stream
/// gives those that are whole.
TEST(StreamInput, PiecesMakeNoDifferenceToRecords) {
    EXPECT_TRUE(rc::check("records", [] {
        auto records = *rc::gen::arbitrary<Strings>();
        if (!records.empty() && *rc::gen::inRange(0, 4) == 0)
            records[0] = std::string(*rc::gen::inRange<std::size_t>(100, 300), 'x');
        std::string bytes;
        std::vector<std::size_t> ends{0};
        for (const std::string& record : records) {
            append_delimited(bytes, record);
            ends.push_back(bytes.size());
        }
        RC_ASSERT(records_of(socket_of(pieces_of(bytes))) == records);
        const auto cut = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
        Strings got = records_of(socket_of(pieces_of(bytes.substr(0, cut))));
        const bool between = std::find(ends.begin(), ends.end(), cut) != ends.end();
        RC_ASSERT((!got.empty() && got.back().starts_with("!the stream ends ")) == !between);
        if (!between) got.pop_back();
        RC_ASSERT(got == Strings(records.begin(), records.begin() + static_cast<long>(got.size())));
    }));
}

TEST(StreamInput, BlocksGrowByWhatIsNotConsumed) {
    Input input(socket_of({"abc", "def", "g"}), "", {5, false, {}});
    bool ended = false;
    EXPECT_EQ(input.block(ended), "abc");
    EXPECT_EQ(input.offset(), 0U);
    EXPECT_FALSE(ended);
    input.consume(1);
    EXPECT_FALSE(input.full());
    EXPECT_EQ(input.block(ended), "bcdef");
    EXPECT_EQ(input.offset(), 1U);
    EXPECT_TRUE(input.full());
    EXPECT_EQ(input.block(ended), "bcdef");  // nothing more is read while it is full
    input.consume(5);
    EXPECT_EQ(input.block(ended), "g");
    EXPECT_EQ(input.offset(), 6U);
    input.consume(100);
    EXPECT_EQ(input.block(ended), "");
    EXPECT_TRUE(ended);
    EXPECT_EQ(input.offset(), 7U);
}

TEST(StreamInput, FlushesBeforeItWaitsAndAtNoOtherTime) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    int flushed = 0;
    Input input(ends[0], "", {1U << 20, false, [&] {
                                  ++flushed;
                                  if (flushed > 2) return;
                                  EXPECT_EQ(::write(ends[1], "c\nd\n", 4), 4);
                                  if (flushed == 2) ::close(ends[1]);
                              }});
    ASSERT_EQ(::write(ends[1], "a\nb\n", 4), 4);
    std::string_view line;
    Strings lines;
    std::vector<int> flushed_before;
    while (input.line(line) == Got::record) {
        lines.emplace_back(line);
        flushed_before.push_back(flushed);
    }
    EXPECT_EQ(lines, (Strings{"a", "b", "c", "d", "c", "d"}));
    EXPECT_EQ(flushed_before, (std::vector<int>{0, 0, 1, 1, 2, 2}));
    EXPECT_EQ(flushed, 2);
}

TEST(StreamInput, NoFlushWhileAFileIsRead) {
    int flushed = 0;
    Input input(file_of(std::string(1'000'000, '\n')), "", {100, false, [&] { ++flushed; }});
    std::string_view line;
    while (input.line(line) != Got::end) continue;
    EXPECT_EQ(flushed, 0);
}

TEST(StreamInput, ADescriptorThatDoesNotBlockIsWaitedFor) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
    std::thread writer([&] {
        ::usleep(20'000);
        EXPECT_EQ(::write(ends[1], "late\n", 5), 5);
        ::close(ends[1]);
    });
    EXPECT_EQ(lines_of(ends[0]), Strings{"late"});
    writer.join();
}

TEST(StreamInput, AReadThatFailsIsSaid) {
    Input input(::open("/", O_RDONLY | O_CLOEXEC), "", {1U << 20, false, {}});
    std::string_view line;
    try {
        input.line(line);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::io);
        EXPECT_STREQ(e.what(), "read failed: Is a directory");
    }
}

namespace {

void write_file(const std::string& path, std::string_view text,
                std::ios::openmode mode = std::ios::trunc) {
    std::ofstream(path, std::ios::binary | mode) << text;
}

/// Reads lines of a followed file; `steps` are done one at each time that the reader has to wait.
Strings followed(const std::string& path, std::vector<std::function<void()>> steps,
                 std::size_t count) {
    std::size_t step = 0;
    const auto wait = [&] {
        if (step < steps.size()) steps[step]();
        if (++step > steps.size() + 30) throw std::runtime_error("waits for ever");
    };
    Input input(::open(path.c_str(), O_RDONLY | O_CLOEXEC), path, {1U << 20, true, wait});
    Strings lines;
    std::string_view line;
    while (lines.size() < count) {
        // The end stands between the two files where one is replaced.
        if (input.line(line) == Got::record)
            lines.push_back(std::to_string(input.count()) + ":" + std::string(line));
    }
    return lines;
}

}  // namespace

TEST(StreamInput, FollowsAFileThatGrows) {
    const TempFolder folder;
    const std::string path = folder.file("log");
    write_file(path, "a\nb");
    const auto grown = followed(path,
                                {[&] { write_file(path, "c\n", std::ios::app); },
                                 [&] { write_file(path, "d\n", std::ios::app); }},
                                3);
    EXPECT_EQ(grown, (Strings{"1:a", "2:bc", "3:d"}));
}

TEST(StreamInput, FollowsAFileThatIsReplaced) {
    const TempFolder folder;
    const std::string path = folder.file("log");
    write_file(path, "a\nhalf");
    const auto replaced = followed(path, {[&] {
                                       write_file(folder.file("new"), "b\nc\n");
                                       std::filesystem::rename(folder.file("new"), path);
                                   }},
                                   4);
    EXPECT_EQ(replaced, (Strings{"1:a", "2:half", "1:b", "2:c"}));  // half of one is not joined
}

TEST(StreamInput, FollowsAFileThatIsCut) {
    const TempFolder folder;
    const std::string path = folder.file("log");
    write_file(path, "a long line\n");
    EXPECT_EQ(followed(path, {[&] { write_file(path, "b\n"); }}, 2),
              (Strings{"1:a long line", "1:b"}));
}

}  // namespace seautils::stream
