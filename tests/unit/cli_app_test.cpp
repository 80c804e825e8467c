// What all tools share, run in processes of their own: statuses, messages, and the habits of the library
// that reads command lines, which no user is to meet.
#include "seautils/cli/app.hpp"
#include "seautils/core/error.hpp"
#include "temp_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace seautils::cli {
namespace {

using Words = std::vector<std::string>;

struct Ran {
    int status;  ///< 128 + the signal that it died of
    std::string out, err;
};

int memory() { return ::memfd_create("test", MFD_CLOEXEC); }

std::string text_of(int fd) {
    std::string text(static_cast<std::size_t>(::lseek(fd, 0, SEEK_END)), '\0');
    EXPECT_EQ(::pread(fd, text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
    ::close(fd);
    return text;
}

/// Runs `tool` in a child whose standard streams are these; `out` less than 0: a file that is kept.
template <class Tool>
Ran run_with(Tool tool, const std::string& input, int out) {
    const int in = memory(), err = memory(), kept = memory();
    EXPECT_EQ(::write(in, input.data(), input.size()), static_cast<ssize_t>(input.size()));
    ::lseek(in, 0, SEEK_SET);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(in, 0);
        ::dup2(out < 0 ? kept : out, 1);
        ::dup2(err, 2);
        ::_exit(tool());
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    ::close(in);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(kept),
            text_of(err)};
}

/// The tool `echo-deep`: writes each line back; some lines have a meaning of their own.
int echo_tool(const Words& words) {
    App app("echo-deep", "Write each line back.", "  echo hello | echo-deep\n",
            {.schema = false, .config = true, .stream = true, .time = true, .seed = true});
    std::vector<double> slots;
    std::string required;
    app.options()
        .add_option("--slot", slots, "Duration of a slot; may repeat")
        ->allow_extra_args(false)
        ->option_text("SECONDS");
    app.options()
        .add_option("--need", required, "A value that must be")
        ->required()
        ->option_text("VALUE");
    app.input_formats({"ndjson", "text"});
    app.output_formats({"ndjson", "hex"});
    std::vector<std::string> all{"echo-deep"};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all) argv.push_back(word.data());
    argv.push_back(nullptr);
    return app.main(static_cast<int>(all.size()), argv.data(), [&](Io& io) {
        if (required == "bug") throw std::logic_error("a fault of ours");
        if (required == "memory") throw std::bad_alloc();
        if (required == "device") throw Error(ExitCode::unavailable, "the device is not there");
        if (required == "show") {
            io.out << "slots " << std::to_string(slots.size()) << " files "
                   << std::to_string(io.files.size()) << " format " << io.format << " from "
                   << io.input_format << " seed " << std::to_string(io.seed) << " max "
                   << std::to_string(io.max_record) << '\n';
            if (!io.clock.is_system()) io.out << std::to_string(io.now_us()) << '\n';
            return;
        }
        io.warn("a warning");
        io.inform("an information");
        io.for_each(Framing::lines, [&](std::string_view line) {
            if (line == "bad") throw DataError("the value 'bad' is bad");
            io.out << line << '\n';
        });
    });
}

Ran run(const Words& words, const std::string& input = "", int out = -1) {
    return run_with([&] { return echo_tool(words); }, input, out);
}

Ran run_quietly(Words words, const std::string& input = "") {
    words.insert(words.begin(), {"-q", "--need", "x"});
    return run(words, input);
}

void expect_usage(const Words& words, const std::string& what) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.status, 64);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "echo-deep: " + what + "\n");
}

class File {
public:
    explicit File(const std::string& text) : path_(folder_.add("file", text)) {}
    const std::string& path() const { return path_; }

private:
    TempFolder folder_;
    std::string path_;
};

}  // namespace

TEST(CliApp, EveryRecordUsedIsZeroAndSilent) {
    const Ran ran = run_quietly({}, "a\nb\r\n\nc");
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.out, "a\nb\nc\n");
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(run_quietly({}, "").status, 0);
}

TEST(CliApp, ABadRecordIsPlacedDroppedAndMakesOne) {
    const Ran ran = run_quietly({}, "a\nbad\nb\nbad");
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "a\nb\n");
    EXPECT_EQ(ran.err,
              "echo-deep: <stdin>:2: the value 'bad' is bad\n"
              "echo-deep: <stdin>:4: the value 'bad' is bad\n");
}

TEST(CliApp, StrictStopsAtTheFirstAndKeepsWhatWasDone) {
    const Ran ran = run_quietly({"--strict"}, "a\nbad\nb\n");
    EXPECT_EQ(ran.status, 65);
    EXPECT_EQ(ran.out, "a\n");
    EXPECT_EQ(ran.err, "echo-deep: <stdin>:2: the value 'bad' is bad\n");
}

TEST(CliApp, ALongRecordIsRefused) {
    const Ran ran = run_quietly({"--max-record", "3"}, "abc\nabcd\nx\n");
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "abc\nx\n");
    EXPECT_EQ(ran.err, "echo-deep: <stdin>:2: longer than 3 bytes (--max-record)\n");
}

TEST(CliApp, FilesInOrderAndStandardInputAmongThem) {
    const File one("1\nbad\n"), two("2\n");
    const Ran ran = run_quietly({one.path(), "-", two.path()}, "in\n");
    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "1\nin\n2\n");
    EXPECT_EQ(ran.err, "echo-deep: " + one.path() + ":2: the value 'bad' is bad\n");
    const Ran missing = run_quietly({one.path(), "/nowhere"});
    EXPECT_EQ(missing.status, 66);
    EXPECT_EQ(missing.out, "1\n");  // what was done before is not lost
    EXPECT_NE(missing.err.find("echo-deep: /nowhere: No such file or directory\n"),
              std::string::npos);
    EXPECT_EQ(run_quietly({"/"}).err, "echo-deep: /: Is a directory\n");
}

TEST(CliApp, StatusesOfExceptions) {
    const Ran bug = run({"--need", "bug"});
    EXPECT_EQ(bug.status, 70);
    EXPECT_EQ(bug.err, "echo-deep: internal error: a fault of ours\n");
    const Ran memory = run({"--need", "memory"});
    EXPECT_EQ(memory.status, 70);
    EXPECT_EQ(memory.err, "echo-deep: out of memory\n");
    const Ran device = run({"--need", "device"});
    EXPECT_EQ(device.status, 69);
    EXPECT_EQ(device.err, "echo-deep: the device is not there\n");
}

TEST(CliApp, AFullDiskIsSeenAtTheEnd) {
    const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
    const Ran ran = run({"-q", "--need", "x"}, "a\n", full);
    EXPECT_EQ(ran.status, 74);
    EXPECT_EQ(ran.err, "echo-deep: write failed: No space left on device\n");
    EXPECT_EQ(run({"--help"}, "", full).status, 74);
    EXPECT_EQ(run({"--version"}, "", full).status, 74);
    ::close(full);
}

TEST(CliApp, AReaderThatGoesAwayEndsIt) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    ::close(ends[0]);
    const Ran ran = run({"-q", "--need", "x"}, "a\n", ends[1]);
    ::close(ends[1]);
    EXPECT_EQ(ran.status, 128 + SIGPIPE);
    EXPECT_EQ(ran.err, "");
}

TEST(CliApp, HelpAndVersionAreAnswers) {
    const Ran help = run({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_TRUE(
        help.out.starts_with("Write each line back.\n\nUsage: echo-deep [OPTION]... [FILE]...\n"));
    EXPECT_NE(help.out.find("--slot SECONDS"), std::string::npos);
    EXPECT_EQ(help.out.find("FLOAT"), std::string::npos);
    EXPECT_EQ(help.out.find("TEXT"), std::string::npos);
    EXPECT_EQ(help.out.find("REQUIRED"), std::string::npos);
    EXPECT_TRUE(help.out.ends_with("The manual: man echo-deep\n"));
    EXPECT_LE(std::count(help.out.begin(), help.out.end(), '\n'), 40);
    const Ran version = run({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_TRUE(version.out.starts_with("echo-deep (seautils) ")) << version.out;
    EXPECT_EQ(version.err, "");
    for (const char* word : {"-h", "-V"}) EXPECT_EQ(run({word}).status, 0) << word;
}

/// CLI11 would take the FILE for the second value.
TEST(CliApp, AFileBehindARepeatableOptionIsAFile) {
    const Ran ran = run({"--need", "show", "--slot", "1", "--slot", "2.5", "/nowhere"});
    EXPECT_EQ(ran.out, "slots 2 files 1 format ndjson from ndjson seed 0 max 1048576\n");
}

TEST(CliApp, AnUnknownOptionIsNamedEvenWhenAnotherIsMissing) {
    expect_usage({"--slots", "5"}, "unknown option --slots (did you mean --slot?)");
    expect_usage({"--zzzzzz"}, "unknown option --zzzzzz (try --help)");
    expect_usage({"--need", "x", "--zzzzzz=7"}, "unknown option --zzzzzz (try --help)");
    expect_usage({"--need", "x", "-Z"}, "unknown option -Z (try --help)");
}

/// CLI11's own statuses are 100 to 127, its sentences begin with a capital.
TEST(CliApp, FaultsOfTheCommandLineAre64InOurWords) {
    expect_usage({}, "option --need is required");
    expect_usage({"--need"}, "option --need lacks its value (VALUE)");
    expect_usage({"--need", "x", "--need", "y"}, "option --need is given twice");
    expect_usage({"--need", "x", "--need="}, "option --need: the value is empty");
    expect_usage({"--need", ""}, "option --need: the value is empty");
    expect_usage({"--need", "x", ""}, "the name of a FILE is empty");
    expect_usage({"--need", "x", "--max-record", "0"},
                 "option --max-record: '0' is outside 1 to 16777216 bytes");
    expect_usage({"--need", "x", "--seed", "x"},
                 "option --seed: 'x' is no whole number, or one too large");
    expect_usage({"--need", "x", "--color", "red"},
                 "option --color: 'red' is none of auto, always, never");
    expect_usage({"--need", "x", "-F", "hex"},
                 "option --input-format: 'hex' is none of ndjson, text");
    expect_usage({"--need", "x", "-f", "xml"}, "option --format: 'xml' is none of ndjson, hex");
    expect_usage({"--need", "x", "--time", "noon"},
                 "option --time: time 'noon' is not of the form 2024-05-01T12:00:25Z");
}

TEST(CliApp, SharedOptionsReachTheTool) {
    EXPECT_EQ(run({"--need", "show", "-f", "hex", "-F", "text", "--seed", "7", "--max-record",
                   "16777216", "--time", "@1.5", "-", "--", "--strict"})
                  .out,
              "slots 0 files 2 format hex from text seed 7 max 16777216\n1500000\n");
}

TEST(CliApp, QuietAndVerbose) {
    EXPECT_EQ(run({"--need", "x"}).err, "echo-deep: a warning\n");
    EXPECT_EQ(run({"--need", "x", "-v"}).err, "echo-deep: a warning\necho-deep: an information\n");
    EXPECT_EQ(run({"--need", "x", "-q"}).err, "");
}

TEST(CliApp, MessagesAreOneLineInPlainText) {
    const Ran ran = run({"--need", "x", "-F", "a\nb\x1b[31m"});
    EXPECT_EQ(ran.err,
              "echo-deep: option --input-format: 'a\\x0ab\\x1b[31m' is none of ndjson, text\n");
    const Ran colour = run({"-q", "--need", "x", "--color", "always"}, "bad\n");
    EXPECT_EQ(colour.err, "\033[31mecho-deep: <stdin>:1: the value 'bad' is bad\033[0m\n");
    EXPECT_EQ(run({"-q", "--need", "x", "--color", "never"}, "bad\n").err,
              "echo-deep: <stdin>:1: the value 'bad' is bad\n");
}

TEST(CliApp, ConfigurationGivesWayToTheCommandLine) {
    const File vehicle("format = hex\nslot = 1\nslot = 2\n"), fleet("format = ndjson\nseed = 5\n");
    EXPECT_EQ(run({"--need", "show", "-c", vehicle.path(), "-c", fleet.path()}).out,
              "slots 2 files 0 format hex from ndjson seed 5 max 1048576\n");
    EXPECT_EQ(run({"--need", "show", "-c", vehicle.path(), "-f", "ndjson", "--slot", "9"}).out,
              "slots 1 files 0 format ndjson from ndjson seed 0 max 1048576\n");
}

TEST(CliApp, FaultsOfConfigurationAre78AtTheirLine) {
    const auto fault = [](const std::string& text) {
        const File file(text);
        const Ran ran = run({"--need", "x", "-c", file.path()});
        EXPECT_EQ(ran.out, "");
        const std::size_t at = ran.err.find(file.path());
        return std::to_string(ran.status) +
               (at == ran.err.npos ? " " + ran.err : ran.err.substr(at + file.path().size()));
    };
    EXPECT_EQ(fault("seed = 1\nsed = 1\n"), "78:2: unknown key 'sed' (did you mean 'seed'?)\n");
    EXPECT_EQ(fault("\nseed = x\n"),
              "78:2: option --seed: 'x' is no whole number, or one too large\n");
    EXPECT_EQ(fault("format = xml\n"), "78:1: option --format: 'xml' is none of ndjson, hex\n");
    EXPECT_EQ(fault("config = other.conf\n").substr(0, 5), "78:1:");
    EXPECT_EQ(fault("help = true\n").substr(0, 5), "78:1:");
    EXPECT_EQ(run({"--need", "x", "-c", "/nowhere"}).status, 66);
}

TEST(CliApp, AnExampleOfAConfigurationIsPrinted) {
    const Ran ran = run({"--need", "x", "--print-config"});
    EXPECT_EQ(ran.status, 0);
    EXPECT_NE(ran.out.find("\n#slot = SECONDS\n"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("help"), std::string::npos);
    const File file(ran.out);
    EXPECT_EQ(run({"-q", "--need", "x", "-c", file.path()}).status, 0);
}

/// A daemon may start us without standard streams: a file must not take their place.
TEST(CliApp, ClosedStandardStreamsAreNotTakenByFiles) {
    const File file("a\n");
    const Ran ran = run_with(
        [&] {
            ::close(0);
            return echo_tool({"-q", "--need", "x", file.path()});
        },
        "", -1);
    EXPECT_EQ(ran.status, 0);
    EXPECT_EQ(ran.out, "a\n");
    const Ran mute = run_with(
        [&] {
            ::close(1);
            return echo_tool({"-q", "--need", "x", file.path()});
        },
        "", -1);
    EXPECT_EQ(mute.status, 74);
}

/// Whoever writes a line and waits for the answer gets it before the end.
TEST(CliApp, ALivePipeIsAnsweredAtOnce) {
    int to[2], from[2];
    ASSERT_EQ(::pipe2(to, O_CLOEXEC), 0);
    ASSERT_EQ(::pipe2(from, O_CLOEXEC), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(to[0], 0);
        ::dup2(from[1], 1);
        ::close(to[1]);
        ::_exit(echo_tool({"-q", "--need", "x"}));
    }
    ::close(to[0]);
    ::close(from[1]);
    for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(::write(to[1], "hello\n", 6), 6);
        pollfd answer{from[0], POLLIN, 0};
        ASSERT_EQ(::poll(&answer, 1, 5000), 1) << "no answer in 5 s";
        char text[16];
        EXPECT_EQ(::read(from[0], text, sizeof text), 6);
    }
    ::close(to[1]);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    ::close(from[0]);
}

}  // namespace seautils::cli
