// The pictures of poscode stat and simulate, by gnuplot.
#ifndef SEAUTILS_TOOLS_POSCODE_PLOT_HPP
#define SEAUTILS_TOOLS_POSCODE_PLOT_HPP

#include "gnuplot.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace seautils::tools {

class Plot {
public:
    using Target = Gnuplot::Target;
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
    static Target target(const std::string& file) { return Gnuplot::target(file); }

    /// @throws Error(cannot_create), Error(unavailable)  gnuplot is not there
    static void draw(const Target& target, const std::vector<Curve>& curves) {
        Gnuplot::draw(target, script(target, curves));
    }
    static void draw(const Target& target, const std::vector<Way>& ways) {
        Gnuplot::draw(target, script(target, ways));
    }

private:
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
                                k, curves[k].title, Gnuplot::style(k));
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
            const std::string how = fmt::format("with linespoints title '{}' {} pt {}",
                                                ways[k].title, Gnuplot::style(k), k + 1);
            bits += fmt::format("{} $w{} using 1:2 {}", k == 0 ? "" : ",", k, how);
            age += fmt::format("{} $w{} using 1:3 {}", k == 0 ? "" : ",", k, how);
        }
        return text + "set multiplot layout 1,2\nset ylabel 'bits a position'\nplot [][0:]" + bits +
               "\nset ylabel 'age of the newest position, intervals'\nplot [][0:]" + age +
               "\nunset multiplot\n";
    }
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_POSCODE_PLOT_HPP
