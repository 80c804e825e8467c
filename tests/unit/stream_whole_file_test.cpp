// Small files, read whole and replaced whole.
#include "seautils/core/error.hpp"
#include "seautils/stream/whole_file.hpp"

#include "temp_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace seautils::stream {

TEST(StreamWholeFile, WhatWasPutThereComesBack) {
    const TempFolder folder;
    const std::string path = folder.file("state");
    EXPECT_EQ(read_whole_file(path, 100), std::nullopt);
    replace_file(path, "one");
    EXPECT_EQ(read_whole_file(path, 100), "one");
    replace_file(path, std::string("t\0w", 3));
    EXPECT_EQ(read_whole_file(path, 100), std::string("t\0w", 3));
    EXPECT_EQ(read_whole_file(path, 2), std::string("t\0", 2));
    replace_file(path, "synced", Sync::yes);
    EXPECT_EQ(read_whole_file(path, 100), "synced");
    replace_file(path, "");
    EXPECT_EQ(read_whole_file(path, 100), "");
    EXPECT_FALSE(std::filesystem::exists(path + ".new"));
}

TEST(StreamWholeFile, WhatCannotBeReadOrMadeIsNamed) {
    const TempFolder folder;
    const auto failure = [](auto action) {
        try {
            action();
            return std::string("done");
        } catch (const Error& e) {
            return std::to_string(static_cast<int>(e.code())) + " " + e.what();
        }
    };
    const std::string path = folder.path();
    EXPECT_EQ(failure([&] { read_input_file(path + "/none", 10); }),
              "66 " + path + "/none: No such file or directory");
    replace_file(folder.file("ten"), "0123456789");
    EXPECT_EQ(read_input_file(folder.file("ten"), 10), "0123456789");
    EXPECT_EQ(failure([&] { read_input_file(folder.file("ten"), 9); }),
              "78 " + folder.file("ten") + ": longer than 9 bytes");
    EXPECT_EQ(failure([&] { read_input_file("/dev/zero", 3U << 20); }),
              "78 /dev/zero: longer than 3 MiB");
    EXPECT_EQ(failure([&] { read_input_descriptor(99, "descriptor 99", 9); }),
              "66 descriptor 99: Bad file descriptor");
    EXPECT_EQ(failure([&] { read_whole_file(path, 10); }), "66 " + path + ": Is a directory");
    EXPECT_EQ(failure([&] { replace_file(folder.file("gone/x"), "x"); }),
              "73 " + folder.file("gone/x.new") + ": No such file or directory");
    EXPECT_EQ(failure([&] { replace_file(folder.file("gone/x"), "x", Sync::yes); }),
              "73 " + folder.file("gone/x.new") + ": No such file or directory");
    std::filesystem::create_directory(folder.file("in"));
    EXPECT_EQ(failure([&] { replace_file(folder.file("in"), "x"); }),
              "73 " + folder.file("in") + ": Is a directory");
    std::filesystem::create_symlink("/dev/full", folder.file("full.new"));
    EXPECT_EQ(failure([&] { replace_file(folder.file("full"), "x"); }),
              "74 " + folder.file("full.new") + ": No space left on device");
}

}  // namespace seautils::stream
