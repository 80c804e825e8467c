// Pseudo-terminals that outlive the programs that use them.
#include "seautils/core/error.hpp"
#include "seautils/stream/pty.hpp"
#include "temp_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace seautils::stream {
namespace {

/// A program that has the device open.
class Client {
public:
    explicit Client(const std::string& path)
        : fd_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        EXPECT_GE(fd_, 0) << path;
    }
    ~Client() { ::close(fd_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    void write(std::string_view bytes) {
        EXPECT_EQ(::write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    }
    std::string read() {
        pollfd ready{fd_, POLLIN, 0};
        ::poll(&ready, 1, 20);
        char block[8192];
        const ssize_t got = ::read(fd_, block, sizeof block);
        return {block, static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
    }

private:
    int fd_;
};

std::string received(Pty& pty) {
    pollfd ready{pty.descriptor(), POLLIN, 0};
    ::poll(&ready, 1, 1000);
    std::string bytes;
    pty.read(bytes);
    return bytes;
}

}  // namespace

TEST(StreamPty, BytesGoBothWaysAsTheyAre) {
    const TempFolder folder;
    Pty pty(folder.path() + "/modem");
    Client client(folder.path() + "/modem");
    client.write("$A\r\n\x03\x04\xff");
    EXPECT_EQ(received(pty), "$A\r\n\x03\x04\xff");
    EXPECT_TRUE(pty.write("$B\r\n\x11\x13"));
    EXPECT_EQ(client.read(), "$B\r\n\x11\x13");
    EXPECT_TRUE(pty.is_open());
}

TEST(StreamPty, ProgramsComeAndGo) {
    const TempFolder folder;
    Pty pty(folder.path() + "/modem");
    if (pty.changes() < 0) GTEST_SKIP() << "no notifications";
    EXPECT_FALSE(pty.is_open());
    EXPECT_TRUE(pty.write("nobody listens"));
    for (int k = 0; k < 3; ++k) {
        pty.look();  // as a loop does it that polls changes()
        Client client(folder.path() + "/modem");
        EXPECT_EQ(client.read(), "") << "nothing old";
        client.write("x");
        EXPECT_EQ(received(pty), "x");
        EXPECT_TRUE(pty.write("y"));
        EXPECT_TRUE(pty.is_open());
        if (k == 1) continue;  // goes without having read it
        EXPECT_EQ(client.read(), "y");
    }
    pty.look();
    EXPECT_FALSE(pty.is_open());
}

TEST(StreamPty, AReaderThatSleepsLosesBytesAndDoesNotHoldUsUp) {
    const TempFolder folder;
    Pty pty(folder.path() + "/modem");
    const Client client(folder.path() + "/modem");
    const std::string line(100, 'x');
    bool all = true;
    for (int k = 0; k < 10'000 && all; ++k) all = pty.write(line);
    EXPECT_FALSE(all);
}

TEST(StreamPty, LinksAreReplacedAndFilesAreNot) {
    const TempFolder folder;
    const std::string link = folder.path() + "/modem";
    std::filesystem::create_symlink("/dev/pts/gone", link);
    {
        const Pty pty(link);
        EXPECT_EQ(std::filesystem::read_symlink(link), pty.device());
        const Pty heir(link);  // a second one takes it over
        EXPECT_EQ(std::filesystem::read_symlink(link), heir.device());
    }
    EXPECT_FALSE(std::filesystem::is_symlink(link));
    std::ofstream(link) << "mine";
    EXPECT_THROW(Pty{link}, Error);
    EXPECT_TRUE(std::filesystem::is_regular_file(link));
    EXPECT_THROW(Pty{folder.path() + "/no/such/folder"}, Error);
}

}  // namespace seautils::stream
