// The pictures of poscode stat and simulate, by gnuplot.
#ifndef SEAUTILS_TOOLS_POSCODE_PLOT_HPP
#define SEAUTILS_TOOLS_POSCODE_PLOT_HPP

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

extern char** environ;

namespace seautils::tools {

class Plot {
public:
    struct Target {
        std::string file, terminal;
        bool is_wanted() const { return !file.empty(); }
    };
    struct Curve {
        std::string title;
        std::vector<std::uint64_t> deltas_by_bits;
    };
    /// What a way of sending costs, by the chance of loss.
    struct Way {
        struct Point {
            double loss = 0, bits = 0, age = 0;
            bool is_stable = true;  ///< else there is no age
        };
        std::string title;
        std::vector<Point> points;
    };

    /// @throws Error(usage)  neither .png nor .svg
    static Target target(const std::string& file) {
        if (file.empty()) return {};
        if (file.ends_with(".png")) return {file, "png size 1000,600 truecolor"};
        if (file.ends_with(".svg")) return {file, "svg size 1000,600 dynamic"};
        throw Error(ExitCode::usage,
                    "option --plot: " + quote(file) + " ends neither in .png nor .svg");
    }

    /// @throws Error(cannot_create), Error(unavailable)  gnuplot is not there
    static void draw(const Target& target, const std::vector<Curve>& curves) {
        draw(target, script(target, curves));
    }
    static void draw(const Target& target, const std::vector<Way>& ways) {
        draw(target, script(target, ways));
    }

private:
    static constexpr int not_there = 127;

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

    static std::string script(const Target& target, const std::vector<Curve>& curves) {
        std::string text = "set terminal " + target.terminal +
                           "\nset encoding utf8\nset xlabel 'bits a delta'\nset ylabel 'deltas'\n"
                           "set grid\nset key top right\n";
        std::string list;
        for (std::size_t k = 0; k < curves.size(); ++k) {
            text += fmt::format("$c{} << END\n", k);
            const auto& counts = curves[k].deltas_by_bits;
            for (std::size_t bits = 0; bits <= counts.size(); ++bits)
                text += fmt::format("{} {}\n", bits, bits < counts.size() ? counts[bits] : 0);
            text += "END\n";
            list += fmt::format("{} $c{} using 1:2 with histeps title '{}' {}", k == 0 ? "" : ",",
                                k, curves[k].title, style(k));
        }
        return text + "plot [0:][0:]" + list + "\n";
    }

    static std::string script(const Target& target, const std::vector<Way>& ways) {
        std::string text = "set terminal " + target.terminal +
                           "\nset encoding utf8\nset grid\nset key top left\n"
                           "set xlabel 'packets lost, share'\n";
        std::string bits, age;
        for (std::size_t k = 0; k < ways.size(); ++k) {
            text += fmt::format("$w{} << END\n", k);
            for (const Way::Point& point : ways[k].points) {
                text += fmt::format("{:.4f} {:.3f} {}\n", point.loss, point.bits,
                                    point.is_stable ? fmt::format("{:.3f}", point.age) : "NaN");
            }
            text += "END\n";
            const std::string how =
                fmt::format("with linespoints title '{}' {} pt {}", ways[k].title, style(k), k + 1);
            bits += fmt::format("{} $w{} using 1:2 {}", k == 0 ? "" : ",", k, how);
            age += fmt::format("{} $w{} using 1:3 {}", k == 0 ? "" : ",", k, how);
        }
        return text + "set multiplot layout 1,2\nset ylabel 'bits a position'\nplot [][0:]" + bits +
               "\nset ylabel 'age of the newest position, intervals'\nplot [][0:]" + age +
               "\nunset multiplot\n";
    }

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

#endif  // SEAUTILS_TOOLS_POSCODE_PLOT_HPP
