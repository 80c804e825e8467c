// A buffered output: what goes in comes out, in order, and what cannot be written is said.
#include "seautils/core/error.hpp"
#include "seautils/stream/output.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <thread>

namespace seautils::stream {
namespace {

/// A file without name, and a second descriptor to look at it with.
struct File {
    File() : fd(::memfd_create("output", 0)), eye(::dup(fd)) {}
    ~File() { ::close(eye); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    std::string text() const {
        std::string all(static_cast<std::size_t>(::lseek(eye, 0, SEEK_END)), '\0');
        EXPECT_EQ(::pread(eye, all.data(), all.size(), 0), static_cast<ssize_t>(all.size()));
        return all;
    }
    int fd, eye;
};

std::string refusal(Output& out) {
    try {
        out.flush();
        return "written";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::io);
        return e.what();
    }
}

}  // namespace

TEST(StreamOutput, KeepsUntilTheBufferIsFull) {
    const File file;
    Output out(file.fd, 8);
    out << "abc" << '\n';
    EXPECT_EQ(file.text(), "");
    out << "defg";
    EXPECT_EQ(file.text(), "abc\ndefg");
    out << "h";
    EXPECT_EQ(file.text(), "abc\ndefg");
    out.flush();
    EXPECT_EQ(file.text(), "abc\ndefgh");
    out.close();
}

TEST(StreamOutput, RecordsAppendedToTheBufferGoOutWhole) {
    const File file;
    Output out(file.fd, 4);
    out.buffer() += "one record that is longer than the buffer";
    EXPECT_EQ(file.text(), "");
    out.commit();
    EXPECT_EQ(file.text(), "one record that is longer than the buffer");
    EXPECT_TRUE(out.buffer().empty());
    out.close();
}

TEST(StreamOutput, CloseWritesAndCloses) {
    const File file;
    Output out(file.fd);
    out << "last words";
    out.close();
    EXPECT_EQ(file.text(), "last words");
    EXPECT_EQ(::fcntl(file.fd, F_GETFD), -1);
}

TEST(StreamOutput, WithoutCloseTheRestIsDropped) {
    const File file;
    { Output(file.fd) << "unsaid"; }
    EXPECT_EQ(file.text(), "");
    ::close(file.fd);
}

TEST(StreamOutput, AFullDiskIsSaid) {
    Output out(::open("/dev/full", O_WRONLY | O_CLOEXEC));
    out << "x";
    EXPECT_EQ(refusal(out), "write failed: No space left on device");
    EXPECT_EQ(refusal(out), "written");  // what failed is not tried again at the end
    out.close();
}

TEST(StreamOutput, ADescriptorThatIsNoneIsSaid) {
    Output out(-1);
    out << "x";
    EXPECT_EQ(refusal(out), "write failed: Bad file descriptor");
    Output empty(-1);
    EXPECT_EQ(refusal(empty), "written");
}

TEST(StreamOutput, APipeThatIsFullIsWaitedFor) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
    const std::string all(1U << 20, 'p');
    std::string got;
    std::thread reader([&] {
        std::string block(4096, '\0');
        while (got.size() < all.size()) {
            const ssize_t n = ::read(ends[0], block.data(), block.size());
            if (n > 0) got.append(block, 0, static_cast<std::size_t>(n));
        }
    });
    Output out(ends[1]);
    out << all;
    out.close();
    reader.join();
    ::close(ends[0]);
    EXPECT_EQ(got, all);
}

TEST(StreamOutput, WhatGoesInComesOutInOrder) {
    EXPECT_TRUE(rc::check("any writes, any buffer", [] {
        const File file;
        Output out(file.fd, *rc::gen::inRange<std::size_t>(0, 64));
        std::string all;
        for (const std::string& piece : *rc::gen::arbitrary<std::vector<std::string>>()) {
            if (*rc::gen::arbitrary<bool>()) {
                out << piece;
            } else {
                out.buffer() += piece;
                out.commit();
            }
            all += piece;
            RC_ASSERT(file.text() == all.substr(0, file.text().size()));
        }
        out.close();
        RC_ASSERT(file.text() == all);
    }));
}

}  // namespace seautils::stream
