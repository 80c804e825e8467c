#include "seautils/queue/spool.hpp"

#include "seautils/core/error.hpp"
#include "unit/temp_folder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace seautils::queue {
namespace {

constexpr std::int64_t s_ns = QueueConfig::ns_per_s;
constexpr std::int64_t epoch_us = 1'700'000'000'000'000;

Now at(std::int64_t t_s) { return {t_s * s_ns, epoch_us + t_s * 1'000'000}; }

Accepted accepted(std::uint64_t sequence, const std::string& data, std::int64_t t_s = 0) {
    Message m;
    m.queue = {7, 2};
    m.src = 1;
    m.data = data;
    return accept(m, sequence, at(t_s));
}

std::vector<std::string> held(const std::string& path) {
    std::vector<std::string> all;
    for (const Accepted& a : Spool(path, at(0), "boot").take_contents().messages)
        all.push_back(a.message.data);
    return all;
}

std::string fault(const std::function<void()>& body, ExitCode expected) {
    try {
        body();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), expected) << e.what();
        return e.what();
    }
    return "";
}

std::string contents(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

using Strings = std::vector<std::string>;

TEST(Spool, KeepsEverythingOfAMessage) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    Accepted first = accepted(3, std::string("\0\xff\n", 3), 5);
    first.message.ack_requested = false;
    first.message.created_us = epoch_us - 1;
    first.sends = 2;
    {
        Spool spool(path, at(0), "boot");
        EXPECT_EQ(spool.take_contents().next_sequence, 1U);
        spool.store(std::vector{first, accepted(9, "b")});
    }
    const SpoolContents all = Spool(path, at(0), "boot").take_contents();
    ASSERT_EQ(all.messages.size(), 2U);
    const Accepted& back = all.messages[0];
    EXPECT_EQ(back.sequence, 3U);
    EXPECT_EQ(back.message.queue, first.message.queue);
    EXPECT_EQ(back.message.src, 1U);
    EXPECT_EQ(back.message.ack_requested, false);
    EXPECT_EQ(back.message.created_us, epoch_us - 1);
    EXPECT_EQ(back.message.data, first.message.data);
    EXPECT_EQ(back.born_ns, first.born_ns);
    EXPECT_EQ(back.sends, 2U);
    EXPECT_EQ(all.messages[1].message.ack_requested, std::nullopt);
    EXPECT_EQ(all.next_sequence, 10U);
}

TEST(Spool, ForgetsWhatIsGoneAndKeepsWhoWasServed) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    {
        Spool spool(path, at(0), "boot");
        spool.store(std::vector{accepted(1, "a"), accepted(2, "b")});
        spool.note_gone(1);
        spool.note_sent({2, 0, 5, {7, 2}}, at(60));
        EXPECT_TRUE(spool.has_notes());
    }
    EXPECT_EQ(held(path), (Strings{"a", "b"}));  // notes only: a crash costs a repetition
    {
        Spool spool(path, at(0), "boot");
        spool.note_gone(1);
        spool.note_sent({2, 0, 5, {7, 2}}, at(60));
        spool.flush();
        EXPECT_FALSE(spool.has_notes());
    }
    const SpoolContents all = Spool(path, at(0), "boot").take_contents();
    ASSERT_EQ(all.messages.size(), 1U);
    EXPECT_EQ(all.messages[0].sends, 5U);
    ASSERT_EQ(all.last_ns.size(), 1U);
    EXPECT_EQ(all.last_ns[0].first, (QueueKey{7, 2}));
    EXPECT_EQ(all.last_ns[0].second, 60 * s_ns);
}

// Pitfall 23: within one boot the wall clock does not matter; after another there is no other.
TEST(Spool, AgesGoOnOverARestartAndOverABoot) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    {
        Spool spool(path, at(100), "one");
        spool.store(std::vector{accepted(1, "a", 100)});
        spool.note_sent({1, 0, 1, {7, 2}}, at(110));
        spool.flush();
    }
    const Now stepped{200 * s_ns, epoch_us + 999'000'000};
    EXPECT_EQ(Spool(path, stepped, "one").take_contents().messages[0].born_ns, 100 * s_ns);
    const Now rebooted{5 * s_ns, epoch_us + 160'000'000};  // 60 s later, says the wall clock
    const SpoolContents all = Spool(path, rebooted, "two").take_contents();
    EXPECT_EQ(all.messages[0].born_ns, -55 * s_ns);
    EXPECT_EQ(all.last_ns[0].second, -45 * s_ns);
    EXPECT_EQ(Spool(path, at(500), "two").take_contents().messages[0].born_ns, -55 * s_ns);
    // A clock that went back: not older than it is, not from the future.
    EXPECT_EQ(Spool(path, {9 * s_ns, 0}, "three").take_contents().messages[0].born_ns, 9 * s_ns);
}

TEST(Spool, TransmissionNumbersAreNeverGivenTwice) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    std::uint32_t next = Spool(path, at(0), "boot").take_contents().next_transmission;
    EXPECT_EQ(next, 1U);
    for (int restart = 0; restart < 3; ++restart) {
        Spool spool(path, at(0), "boot");
        const std::uint32_t first = spool.take_contents().next_transmission;
        EXPECT_GE(first, next);
        for (next = first; next < first + 300; ++next) spool.reserve(next + 1);
    }
}

TEST(Spool, OneProcessAtATime) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    const Spool spool(path, at(0), "boot");
    EXPECT_EQ(fault([&] { Spool(path, at(0), "boot"); }, ExitCode::try_again),
              "spool '" + path + "' is in use by another process");
}

TEST(Spool, WhatIsNotOursIsLeftAlone) {
    const TempFolder folder;
    const std::string text = folder.add("notes.txt", std::string(5000, 'x'));
    const std::string name = "spool '" + text + "' ";
    EXPECT_EQ(fault([&] { Spool(text, at(0), "boot"); }, ExitCode::data),
              name + "is not a spool (move it away to start with an empty one)");
    EXPECT_EQ(contents(text), std::string(5000, 'x'));

    const std::string other = folder.file("other.db");
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(other.c_str(), &db), SQLITE_OK);
    sqlite3_exec(db, "CREATE TABLE bookmarks(url)", nullptr, nullptr, nullptr);
    sqlite3_close(db);
    const std::string before = contents(other);
    EXPECT_EQ(fault([&] { Spool(other, at(0), "boot"); }, ExitCode::data),
              "spool '" + other + "' is another program's database");
    EXPECT_EQ(contents(other), before);
}

TEST(Spool, AnotherVersionsIsRefused) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    { Spool(path, at(0), "boot"); }
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
    sqlite3_exec(db, "PRAGMA user_version = 2", nullptr, nullptr, nullptr);
    sqlite3_close(db);
    EXPECT_EQ(fault([&] { Spool(path, at(0), "boot"); }, ExitCode::data),
              "spool '" + path + "' is of version 2, where 1 is read");
}

TEST(Spool, CannotBeOpened) {
    const TempFolder folder;
    EXPECT_EQ(fault([&] { Spool(folder.path(), at(0), "boot"); }, ExitCode::cannot_create)
                  .substr(0, 7 + folder.path().size()),
              "spool '" + folder.path());
    const std::string nowhere = folder.file("no/such/folder");
    EXPECT_EQ(fault([&] { Spool(nowhere, at(0), "boot"); }, ExitCode::cannot_create),
              "spool '" + nowhere + "' cannot be opened for writing: No such file or directory");
}

// Whatever the bytes: messages, or a clear error.
TEST(Spool, DamageIsNoticedOrHarmless) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    {
        Spool spool(path, at(0), "boot");
        for (std::uint64_t k = 1; k <= 200; ++k)
            spool.store(std::vector{accepted(k, std::string(50, 'd'))});
    }
    const std::string whole = contents(path);
    EXPECT_TRUE(rc::check("some bytes are wrong, or missing", [&] {
        std::string bytes = whole;
        const int wrong = *rc::gen::inRange(1, 20);
        for (int k = 0; k < wrong; ++k)
            bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<char>();
        if (*rc::gen::arbitrary<bool>())
            bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
        const std::string damaged = folder.add("damaged.db", bytes);
        std::filesystem::remove(damaged + "-wal");
        try {
            Spool spool(damaged, at(0), "other boot");
            RC_ASSERT(spool.take_contents().messages.size() <= 200U);
            spool.store(std::vector{accepted(1000, "a")});
        } catch (const Error& e) {
            RC_ASSERT(std::string(e.what()).starts_with("spool '"));
        }
    }));
}

/// Runs `body` in a process of its own. @return its status, as waitpid() says
int in_child(const std::function<void()>& body) {
    const pid_t child = ::fork();
    if (child == 0) {
        body();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

TEST(Spool, SurvivesAKillAtAnyMoment) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    std::size_t kept = 0;
    for (int round = 0; round < 10; ++round) {
        int pipe[2];
        ASSERT_EQ(::pipe(pipe), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            Spool spool(path, at(0), "boot");
            std::uint64_t sequence = spool.take_contents().next_sequence;
            for (;; ++sequence) {
                spool.store(std::vector{accepted(sequence, "m")});
                if (::write(pipe[1], "!", 1) != 1) ::_exit(1);  // says: it is safe
            }
        }
        char byte = 0;
        for (int k = 0; k < 5 + round; ++k) {
            ASSERT_EQ(::read(pipe[0], &byte, 1), 1);
            ++kept;
        }
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        ::close(pipe[1]);
        while (::read(pipe[0], &byte, 1) == 1) ++kept;
        ::close(pipe[0]);
        const std::size_t found = held(path).size();
        EXPECT_GE(found, kept);
        EXPECT_LE(found, kept + 1);
        kept = found;
    }
}

TEST(Spool, AFullDiskRefusesAndIsUsedOnWhenThereIsRoom) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    EXPECT_EQ(in_child([&] {
                  ::signal(SIGXFSZ, SIG_IGN);
                  Spool spool(path, at(0), "boot");
                  spool.store(std::vector{accepted(1, "before")});
                  rlimit limit{200'000, RLIM_INFINITY};
                  ::setrlimit(RLIMIT_FSIZE, &limit);
                  spool.note_gone(77);
                  try {
                      for (std::uint64_t k = 2;; ++k)
                          spool.store(std::vector{accepted(k, std::string(2000, 'x'))});
                  } catch (const Error& e) {
                      if (e.code() != ExitCode::io) ::_exit(1);
                  }
                  limit.rlim_cur = RLIM_INFINITY;
                  ::setrlimit(RLIMIT_FSIZE, &limit);
                  spool.store(std::vector{accepted(1000, "after")});
              }),
              0);
    const Strings all = held(path);
    ASSERT_GE(all.size(), 3U);
    EXPECT_EQ(all.front(), "before");
    EXPECT_EQ(all.back(), "after");
}

// Messages come and go; the log of all that may not fill the disk for good, nor over kills.
TEST(Spool, ItsOwnLogDoesNotFillASmallDisk) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    for (std::uint64_t run = 0; run < 3; ++run) {
        EXPECT_EQ(in_child([&] {
                      ::signal(SIGXFSZ, SIG_IGN);
                      const rlimit limit{200'000, RLIM_INFINITY};
                      ::setrlimit(RLIMIT_FSIZE, &limit);
                      Spool spool(path, at(0), "boot");
                      for (std::uint64_t k = 1000 * run + 1; k <= 1000 * run + 300; ++k) {
                          spool.store(std::vector{accepted(k, std::string(100, 'x'))});
                          spool.note_gone(k);
                      }
                      ::raise(SIGKILL);
                  }),
                  SIGKILL);
    }
    EXPECT_EQ(held(path).size(), 3U);  // the last one that went in each run was not yet told
}

TEST(Spool, StoresAllOrNone) {
    const TempFolder folder;
    const std::string path = folder.file("q.db");
    {
        Spool spool(path, at(0), "boot");
        spool.store(std::vector{accepted(1, "a")});
        spool.note_gone(1);
        // A number is given twice.
        EXPECT_NE(fault(
                      [&] {
                          spool.store(std::vector{accepted(2, "b"), accepted(2, "c")});
                      },
                      ExitCode::io),
                  "");
        EXPECT_TRUE(spool.has_notes());
    }
    EXPECT_EQ(held(path), Strings{"a"});
}

}  // namespace
}  // namespace seautils::queue
