// Waiting for several things at once, in a process of its own as tools do.
#include "seautils/cli/loop.hpp"

#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "seautils/stream/fifo.hpp"
#include "seautils/stream/packet_socket.hpp"
#include "temp_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace seautils::cli {
namespace {

using namespace std::chrono_literals;
using Body = std::function<void(Io&, Loop&)>;

/// A tool with a loop, in a child; its standard input and output are pipes of ours.
class Tool {
public:
    explicit Tool(const Body& body, std::vector<std::string> words = {}) {
        int in[2], out[2];
        EXPECT_EQ(::pipe(in), 0);
        EXPECT_EQ(::pipe(out), 0);
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(in[0], 0);
            ::dup2(out[1], 1);
            for (const int fd : {in[0], in[1], out[0], out[1]}) ::close(fd);
            words.insert(words.begin(), "tool");
            std::vector<char*> argv;
            for (std::string& word : words) argv.push_back(word.data());
            argv.push_back(nullptr);
            App app("tool", "A tool of the test.", "", {.clock = true});
            ::_exit(app.main(static_cast<int>(words.size()), argv.data(), [&](Io& io) {
                Loop loop(io);
                body(io, loop);
            }));
        }
        ::close(in[0]);
        ::close(out[1]);
        in_ = in[1];
        out_ = out[0];
    }
    ~Tool() {
        end_input();
        if (child_ > 0) {
            ::kill(child_, SIGKILL);
            ::waitpid(child_, nullptr, 0);
        }
        ::close(out_);
    }
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;

    void say(std::string_view text) const {
        EXPECT_EQ(::write(in_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    void end_input() {
        if (in_ >= 0) ::close(in_);
        in_ = -1;
    }
    /// What the tool has written, once it ends in `end`; or at its end.
    std::string heard(std::string_view end = "\n") {
        std::string text;
        char c = 0;
        while (!(text.ends_with(end) && !end.empty()) && ::read(out_, &c, 1) == 1) text += c;
        return text;
    }
    void signal(int number) const { ::kill(child_, number); }
    /// The exit status, or 128 and the number of the signal.
    int status() {
        int status = 0;
        ::waitpid(child_, &status, 0);
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

private:
    pid_t child_ = -1;
    int in_ = -1, out_ = -1;
};

/// Writes each line of the inputs, with a mark.
void echo(Io& io, Loop& loop) {
    loop.inputs(Framing::lines, [&io](std::string_view line) {
        if (line == "bad") throw DataError("that is bad");
        io.out << "<" << line << ">\n";
    });
}

TEST(CliLoop, InputIsAnsweredAtOnceAndEndsTheRun) {
    Tool tool([](Io& io, Loop& loop) {
        echo(io, loop);
        loop.run();
        io.out << "end\n";
    });
    tool.say("a\nb");
    EXPECT_EQ(tool.heard(), "<a>\n");
    tool.say("c\nbad\nd\n");
    EXPECT_EQ(tool.heard(), "<bc>\n");
    EXPECT_EQ(tool.heard(), "<d>\n");
    tool.end_input();
    EXPECT_EQ(tool.heard(), "end\n");
    EXPECT_EQ(tool.status(), 1);
}

TEST(CliLoop, ManyLinesAtOnceAreNotLeftLying) {
    Tool tool([](Io& io, Loop& loop) {
        int count = 0;
        loop.inputs(Framing::lines, [&](std::string_view) {
            if (++count == 5000) io.out << "all\n";
        });
        loop.run();
    });
    std::string lines;
    for (int k = 0; k < 5000; ++k) lines += "x\n";
    tool.say(lines);
    EXPECT_EQ(tool.heard(), "all\n") << "though no more comes";
}

TEST(CliLoop, FilesAreReadInTurn) {
    const TempFolder folder;
    Tool tool(
        [](Io& io, Loop& loop) {
            echo(io, loop);
            loop.run();
        },
        {folder.add("one", "1\n2\n"), "-", folder.add("two", "3")});
    tool.say("x\n");
    tool.end_input();
    EXPECT_EQ(tool.heard(""), "<1>\n<2>\n<x>\n<3>\n");
    EXPECT_EQ(tool.status(), 0);
}

TEST(CliLoop, AFifoHasNoEnd) {
    const TempFolder folder;
    const std::string path = folder.file("feedback");
    Tool tool([&](Io& io, Loop& loop) {
        loop.fifo(path, Framing::lines, [&](std::string_view line) { io.out << line << "\n"; });
        echo(io, loop);
        loop.run();
    });
    tool.say("ready\n");
    EXPECT_EQ(tool.heard(), "<ready>\n");
    for (const char* text : {"first\n", "second\n"}) {
        stream::FeedbackFifo fifo(path);
        EXPECT_TRUE(fifo.write(text));
        EXPECT_EQ(tool.heard(), text);
    }
    tool.end_input();
    EXPECT_EQ(tool.status(), 0);
}

TEST(CliLoop, AFullFifoDropsAndCounts) {
    const TempFolder folder;
    stream::FeedbackFifo fifo(folder.file("nobody-reads"));
    const std::string record(4096, 'x');
    int written = 0;
    while (fifo.write(record)) ++written;
    EXPECT_GE(written, 15) << "64 KiB, or a page less";
    EXPECT_FALSE(fifo.write("y"));
    EXPECT_EQ(fifo.dropped(), 2U);
    EXPECT_THROW(stream::open_fifo(folder.add("file", "")), Error);
    EXPECT_THROW(stream::open_fifo(folder.file("no/where")), Error);
}

TEST(CliLoop, PacketsAreAnswered) {
    const TempFolder folder;
    const std::string path = folder.file("socket");
    Tool tool([&](Io& io, Loop& loop) {
        loop.listen(path, [&](std::string_view packet, std::uint64_t client) {
            if (packet == "bad") throw DataError("not that");
            loop.reply(client, "ok " + std::string(packet));
        });
        echo(io, loop);
        loop.run();
    });
    tool.say("ready\n");
    tool.heard();
    stream::PacketClient one(path), two(path);
    EXPECT_EQ(one.ask("a", 5s), "ok a");
    EXPECT_EQ(two.ask("b", 5s), "ok b");
    EXPECT_EQ(one.ask("bad", 5s), "error: not that");
    EXPECT_EQ(one.ask(std::string(4096, 'x'), 5s).size(), 4096U) << "an answer is cut there";
    EXPECT_EQ(one.ask(std::string(4097, 'x'), 5s), "error: longer than 4096 bytes");
    EXPECT_THROW(stream::listen_packets(path), Error) << "in use";
    tool.end_input();
    EXPECT_EQ(tool.status(), 0);
    EXPECT_FALSE(std::filesystem::exists(path)) << "removed at the end";
    EXPECT_THROW(one.ask("c", 5s), Error);
    EXPECT_THROW(stream::PacketClient{path}, Error);
}

TEST(CliLoop, ASocketThatWasLeftBehindIsReplaced) {
    const TempFolder folder;
    const std::string path = folder.file("socket");
    ::close(stream::listen_packets(path));
    ASSERT_TRUE(std::filesystem::exists(path));
    ::close(stream::listen_packets(path));
    EXPECT_THROW(stream::listen_packets(folder.add("file", "kept")), Error);
    EXPECT_TRUE(std::filesystem::exists(folder.file("file")));
    EXPECT_THROW(stream::listen_packets(folder.file(std::string(200, 'x'))), Error);
}

TEST(CliLoop, WakesAtItsTime) {
    Tool tool([](Io& io, Loop& loop) {
        const std::int64_t begin = io.clock.now_ns(), start = io.clock.steady_ns();
        int count = 0;
        loop.on_wake([&] {
            ++count;
            const bool early = count == 1 ? io.clock.now_ns() < begin + 20'000'000
                                          : io.clock.steady_ns() < start + 40'000'000;
            io.out << (early ? "early\n" : "wake\n");
            if (count == 2) loop.stop();
        });
        loop.wake_at(begin + 20'000'000);
        loop.wake_at_steady(start + 40'000'000);
        loop.run();
    });
    EXPECT_EQ(tool.heard(""), "wake\nwake\n");
    EXPECT_EQ(tool.status(), 0);
}

TEST(CliLoop, AWarpedClockWakesSooner) {
    Tool tool(
        [](Io& io, Loop& loop) {
            loop.on_wake([&] {
                io.out << (io.clock.now_ns() >= 1'000'003'600'000'000'000 ? "hour\n" : "early\n");
                loop.stop();
            });
            loop.wake_at(1'000'003'600'000'000'000);
            loop.run();
        },
        {"--clock", [] {
             WarpedClock clock;
             clock.factor = 1000;
             timespec now{};
             ::clock_gettime(CLOCK_BOOTTIME, &now);
             clock.boot_ns = now.tv_sec * 1'000'000'000L + now.tv_nsec - 3'590'000'000;
             clock.sim_us = 1'000'000'000'000'000;
             return format_warp(clock);
         }()});
    EXPECT_EQ(tool.heard(""), "hour\n");
}

TEST(CliLoop, TimeOfTheInputRunsWakesInBetween) {
    Tool tool(
        [](Io& io, Loop& loop) {
            loop.on_wake([&] {
                io.out << "wake " << std::to_string(io.clock.now_ns()) << "\n";
                if (io.clock.now_ns() < 30) loop.wake_at(io.clock.now_ns() + 10);
            });
            loop.inputs(Framing::lines, [&](std::string_view line) {
                loop.advance(std::stoll(std::string(line)));
                io.out << "at " << std::to_string(io.clock.now_ns()) << "\n";
            });
            loop.wake_at(10);
            loop.run();
        },
        {"--clock", "input"});
    tool.say("5\n25\n20\n100\n");
    tool.end_input();
    EXPECT_EQ(tool.heard(""), "at 5\nwake 10\nwake 20\nat 25\nat 25\nwake 30\nat 100\n");
}

TEST(CliLoop, ASignalEndsItWhenAllIsWritten) {
    for (const int number : {SIGTERM, SIGINT}) {
        Tool tool([](Io& io, Loop& loop) {
            echo(io, loop);
            loop.run();
            io.out << "cleaned up\n";
        });
        tool.say("a\n");
        EXPECT_EQ(tool.heard(), "<a>\n");
        tool.signal(number);
        EXPECT_EQ(tool.heard(""), "cleaned up\n");
        EXPECT_EQ(tool.status(), 128 + number);
    }
}

TEST(CliLoop, OtherSignalsAreTheTools) {
    Tool tool([](Io& io, Loop& loop) {
        echo(io, loop);
        loop.on_signal(SIGUSR1, [&] { io.out << "statistics\n"; });
        loop.run();
    });
    tool.say("a\n");
    tool.heard();
    tool.signal(SIGUSR1);
    EXPECT_EQ(tool.heard(), "statistics\n");
    tool.end_input();
    EXPECT_EQ(tool.status(), 0);
}

TEST(CliLoop, WatchesDescriptorsOfTheTool) {
    Tool tool([](Io& io, Loop& loop) {
        int ends[2];
        if (::pipe(ends) != 0) throw Error(ExitCode::internal, "no pipe");
        loop.watch(ends[0], [&] {
            char c = 0;
            if (::read(ends[0], &c, 1) == 1) io.out << std::string(1, c) << "\n";
            loop.unwatch(ends[0]);
            loop.stop();
        });
        if (::write(ends[1], "x", 1) != 1) throw Error(ExitCode::internal, "no write");
        loop.run();
    });
    EXPECT_EQ(tool.heard(""), "x\n");
}

TEST(CliClock, Words) {
    EXPECT_TRUE(Clock().is_system());
    EXPECT_TRUE(Clock("system").is_system());
    EXPECT_TRUE(Clock("input").is_input());
    for (const char* bad : {"", "noon", "warp:", "warp:1,2", "warp:0,1,@0", "warp:1,x,@0"})
        EXPECT_THROW(Clock{bad}, DataError) << bad;
    Clock input("input");
    EXPECT_EQ(input.now_ns(), 0);
    input.advance(5);
    input.advance(3);
    EXPECT_EQ(input.now_ns(), 5) << "time does not run backwards";
    EXPECT_EQ(input.steady_ns(), 5);
    Clock fixed = Clock::fixed(7);
    fixed.advance(9'000'000);
    EXPECT_EQ(fixed.now_ns(), 7000);
}

}  // namespace
}  // namespace seautils::cli
