// The clock of a simulation, and where other tools find it.
#ifndef SEAUTILS_TOOLS_MM_SIM_CLOCK_HPP
#define SEAUTILS_TOOLS_MM_SIM_CLOCK_HPP

#include "seautils/cli/io.hpp"
#include "seautils/core/error.hpp"
#include "seautils/core/warp.hpp"
#include "seautils/sim/track.hpp"

#include <sys/stat.h>
#include <time.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

namespace seautils::tools {

inline std::int64_t since_boot_ns() {
    timespec now{};
    ::clock_gettime(CLOCK_BOOTTIME, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

inline void make_folder(const std::string& folder) {
    if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST)
        throw Error(ExitCode::cannot_create, folder + ": " + std::strerror(errno));
}

/// The clock of all tools: the one that was given, or a new one, at the scenario's epoch now.
/// @param warp  how fast the new one runs; 0: not said
/// @return  when the simulation begins
inline sim::Time choose_clock(cli::Io& io, double warp, sim::Time epoch) {
    if (io.clock.is_system()) {
        const double factor = warp == 0 ? 1 : warp;
        io.clock = cli::Clock(format_warp({factor, since_boot_ns(), epoch / 1000}));
        return epoch / 1000 * 1000;
    }
    if (io.clock.is_input())
        throw Error(ExitCode::usage, "option --clock: 'input' makes no time pass");
    if (warp != 0) throw Error(ExitCode::usage, "option --warp: the clock is given already");
    return io.clock.now_ns();
}

/// A file that tells other programs the clock, while this one runs.
class ClockFile {
public:
    /// Under another name first: a reader finds all of it, or nothing.
    ClockFile(std::string file, const std::string& word) : file_(std::move(file)) {
        const std::string fresh = file_ + ".new";
        std::ofstream out(fresh, std::ios::binary);
        out << word << '\n';
        out.close();
        if (!out || std::rename(fresh.c_str(), file_.c_str()) != 0)
            throw Error(ExitCode::cannot_create, file_ + ": " + std::strerror(errno));
    }
    ~ClockFile() { std::remove(file_.c_str()); }
    ClockFile(const ClockFile&) = delete;
    ClockFile& operator=(const ClockFile&) = delete;

private:
    std::string file_;
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_MM_SIM_CLOCK_HPP
