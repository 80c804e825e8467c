#ifndef SEAUTILS_CLI_PROGRESS_HPP
#define SEAUTILS_CLI_PROGRESS_HPP

#include <chrono>
#include <cstdint>
#include <string>

namespace seautils::cli {

/// One line on standard error that is written over and over: how much of a file has been read.
/// Only on a terminal, and only after two seconds.
class Progress {
public:
    Progress(std::string name, std::uint64_t size_bytes);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(std::uint64_t done_bytes);
    /// Takes the line away, so that a message can stand in its place.
    void clear();

private:
    std::string name_;
    std::uint64_t size_bytes_;
    std::chrono::steady_clock::time_point next_;
    bool terminal_;
    bool shown_ = false;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_PROGRESS_HPP
