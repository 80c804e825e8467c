// Pictures by gnuplot.
#ifndef SEAUTILS_TOOLS_GNUPLOT_HPP
#define SEAUTILS_TOOLS_GNUPLOT_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

extern char** environ;

namespace seautils::tools {

class Gnuplot {
public:
    struct Target {
        std::string file, terminal;
        bool is_wanted() const { return !file.empty(); }
    };

    /// @throws Error(usage)  neither .png nor .svg
    static Target target(const std::string& file) {
        if (file.empty()) return {};
        if (file.ends_with(".png")) return {file, "png size 1000,600 truecolor"};
        if (file.ends_with(".svg")) return {file, "svg size 1000,600 dynamic"};
        throw Error(ExitCode::usage,
                    "option --plot: " + quote(file) + " ends neither in .png nor .svg");
    }

    /// Draws what a script says, whose terminal is the target's.
    /// @throws Error(cannot_create), Error(unavailable)  gnuplot is not there
    static void draw(const Target& target, const std::string& drawing) {
        const int picture =
            ::open(target.file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (picture < 0)
            throw Error(ExitCode::cannot_create, target.file + ": " + std::strerror(errno));
        const int status = run_gnuplot(drawing, picture);
        ::close(picture);
        if (status == 0) return;
        ::unlink(target.file.c_str());
        if (status == not_there)
            throw Error(ExitCode::unavailable, "option --plot needs gnuplot (package gnuplot-nox)");
        throw Error(ExitCode::io, target.file + ": gnuplot could not draw it");
    }

    /// Colours that people of any colour vision tell apart (Okabe and Ito 2008), and dashes.
    static std::string style(std::size_t k) {
        static constexpr std::array<const char*, 7> colours = {
            "#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2", "#D55E00", "#CC79A7"};
        return fmt::format("lc rgb '{}' dt {} lw {}", colours[k % colours.size()], k % 5 + 1,
                           k == 0 ? 3 : 2);
    }

private:
    static constexpr int not_there = 127;

    /// @return its status; 127: it is not there
    static int run_gnuplot(const std::string& script, int picture) {
        std::FILE* const text = std::tmpfile();
        if (text == nullptr) return 1;
        const bool written = std::fwrite(script.data(), 1, script.size(), text) == script.size() &&
                             std::fflush(text) == 0 && std::fseek(text, 0, SEEK_SET) == 0;
        posix_spawn_file_actions_t streams;
        ::posix_spawn_file_actions_init(&streams);
        ::posix_spawn_file_actions_adddup2(&streams, ::fileno(text), 0);
        ::posix_spawn_file_actions_adddup2(&streams, picture, 1);
        ::posix_spawn_file_actions_addopen(&streams, 2, "/dev/null", O_WRONLY, 0);
        char name[] = "gnuplot";
        char* const words[] = {name, nullptr};
        pid_t child = 0;
        const int fault =
            written ? ::posix_spawnp(&child, name, &streams, nullptr, words, environ) : EIO;
        ::posix_spawn_file_actions_destroy(&streams);
        std::fclose(text);
        if (fault != 0) return fault == ENOENT ? not_there : 1;
        int status = 0;
        while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    }
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_GNUPLOT_HPP
