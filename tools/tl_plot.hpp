// The picture of tl-model: loss over range and depth with the profile beside it, or arrivals over time.
#ifndef SEAUTILS_TOOLS_TL_PLOT_HPP
#define SEAUTILS_TOOLS_TL_PLOT_HPP

#include "gnuplot.hpp"
#include "tl_answer.hpp"

#include "seautils/core/error.hpp"
#include "seautils/propagation/rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace seautils::tools {

class TlPlot {
public:
    /// @param rays  that are drawn over losses
    /// @throws as Gnuplot::draw()
    static void draw(const Gnuplot::Target& target, const TlResult& result, std::size_t rays) {
        const bool has_loss = !result.field.loss_db.empty();
        if (has_loss && result.task->environment.receivers.pairs)
            throw Error(ExitCode::data, "a picture of losses needs a grid of receivers, not pairs");
        Gnuplot::draw(target, "set terminal " + target.terminal + "\nset encoding utf8\n" +
                                  (has_loss ? losses(result, rays) : arrivals(result)));
    }

private:
    static constexpr std::size_t most_receivers = 7;

    template <class... T>
    static void add(std::string& to, fmt::format_string<T...> form, T&&... values) {
        fmt::format_to(std::back_inserter(to), form, std::forward<T>(values)...);
    }

    /// A text in the single quotes of gnuplot, as it stands.
    static std::string title_of(const pg::Environment& e) {
        std::string text = printable(e.title, 80);
        std::replace(text.begin(), text.end(), '\'', ' ');
        return text;
    }

    static std::string losses(const TlResult& result, std::size_t rays) {
        const pg::Environment& e = result.task->environment;
        std::string s;
        add_profile_data(s, e);
        add_grid_data(s, e.receivers, result.field.loss_db);
        add_line_data(s, e);
        if (rays > 0) add_ray_data(s, e, result.task->options, rays);
        const double deepest_m = std::max(e.bottom_depth_m, e.receivers.depth_m.back());
        const auto [least_db, most_db] = range_db(result.field.loss_db);
        add(s, "set multiplot title '{}' noenhanced\nset yrange [{}:0]\nset ylabel 'depth, m'\n",
            title_of(e), 1.02 * deepest_m);
        s += "set lmargin at screen 0.08\nset rmargin at screen 0.24\nset bmargin at screen 0.13\n"
             "set tmargin at screen 0.90\nset grid\nset xlabel 'sound speed, m/s'\nset xtics 20 "
             "rotate\n"
             "set xtics autofreq\n";
        s += "plot $profile using 1:2 with lines lw 2 lc rgb '#000000' notitle\n";
        // Dark is little sound, in grey too: lightness falls evenly, hues suit every colour vision.
        s += "set palette defined (0 '#fde725', 1 '#5ec962', 2 '#21918c', 3 '#3b528b', 4 "
             "'#440154')\n";
        add(s, "set cbrange [{}:{}]\nset cblabel 'transmission loss, dB re 1 m' offset 1\n",
            least_db, most_db);
        add(s,
            "set lmargin at screen 0.31\nset rmargin at screen 0.86\nunset ylabel\nunset grid\n"
            "set xlabel 'range, km'\nset xtics norotate\nset xrange [0:{}]\nset view map\n",
            e.receivers.range_m.back() / 1000);
        s += "splot $grid nonuniform matrix using ($1/1000):2:3 with pm3d notitle, ";
        if (rays > 0) s += "$rays using 1:2:(0) with lines lw 0.5 lc rgb '#000000' notitle, ";
        s += "$bottom using 1:2:(0) with lines lw 3 lc rgb '#D55E00' notitle, "
             "$source using 1:2:(0) with points pt 7 ps 1.5 lc rgb '#000000' notitle\n"
             "unset multiplot\n";
        return s;
    }

    static void add_profile_data(std::string& s, const pg::Environment& e) {
        s += "$profile << END\n";
        const pg::WaterColumn& w = e.water;
        if (w.mesh) {
            for (std::size_t k = 0; k < w.mesh->depth_m.size(); ++k)
                add(s, "{} {}\n", w.mesh->sound_speed_mps[k * w.mesh->range_m.size()],
                    w.mesh->depth_m[k]);
        } else {
            for (const pg::SpeedPoint& point : w.profile)
                add(s, "{} {}\n", point.sound_speed_mps, point.depth_m);
        }
        s += "END\n";
    }

    static void add_grid_data(std::string& s, const pg::Receivers& r,
                              const std::vector<float>& loss_db) {
        add(s, "$grid << END\n{}", r.range_m.size());
        for (const double range_m : r.range_m) add(s, " {}", range_m);
        s += '\n';
        const float* loss = loss_db.data();
        for (const double depth_m : r.depth_m) {
            add(s, "{}", depth_m);
            for (std::size_t k = 0; k < r.range_m.size(); ++k, ++loss) {
                s += ' ';
                if (std::isfinite(*loss))
                    append_hundredths(s, *loss);
                else
                    s += "NaN";
            }
            s += '\n';
        }
        s += "END\n";
    }

    static void add_line_data(std::string& s, const pg::Environment& e) {
        add(s, "$source << END\n0 {}\nEND\n$bottom << END\n", e.source.depth_m);
        const double last_m = e.receivers.range_m.back();
        add(s, "0 {}\n", bottom_depth_m(e, 0));
        if (e.bottom_line)
            for (std::size_t k = 0; k < e.bottom_line->range_m.size(); ++k)
                if (e.bottom_line->range_m[k] > 0 && e.bottom_line->range_m[k] < last_m)
                    add(s, "{} {}\n", e.bottom_line->range_m[k] / 1000, e.bottom_line->depth_m[k]);
        add(s, "{} {}\nEND\n", last_m / 1000, bottom_depth_m(e, last_m));
    }

    static void add_ray_data(std::string& s, const pg::Environment& e,
                             const pg::FieldOptions& options, std::size_t rays) {
        s += "$rays << END\n";
        for (const pg::RayPath& path : pg::ray_paths(e, options, rays)) {
            for (std::size_t k = 0; k < path.range_m.size(); ++k)
                add(s, "{:.4f} {:.2f}\n", path.range_m[k] / 1000, path.depth_m[k]);
            s += "\n\n";
        }
        s += "END\n";
    }

    /// Tens of decibels between which nine tenths of the losses are.
    static std::pair<double, double> range_db(const std::vector<float>& loss_db) {
        std::vector<float> all;
        for (const float x : loss_db)
            if (std::isfinite(x)) all.push_back(x);
        if (all.empty()) return {0, 10};
        const auto at = [&all](double share) {
            const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size() - 1));
            std::nth_element(all.begin(), all.begin() + k, all.end());
            return double{all[static_cast<std::size_t>(k)]};
        };
        const double least = std::floor(at(0.05) / 10) * 10;
        return {least, std::max(least + 10, std::ceil(at(0.95) / 10) * 10)};
    }

    static std::string arrivals(const TlResult& result) {
        std::string s, list;
        std::size_t shown = 0;
        for (const pg::ReceiverArrivals& receiver : result.arrivals) {
            if (receiver.arrivals.empty() || shown == most_receivers) continue;
            add(s, "$a{} << END\n", shown);
            for (const pg::Arrival& a : receiver.arrivals)
                if (a.amplitude > 0)
                    add(s, "{:.6f} {:.3f}\n", 1000 * (a.delay_s - receiver.arrivals[0].delay_s),
                        a.absorption_db - 20 * std::log10(a.amplitude));
            s += "END\n";
            add(list, "{}$a{} using 1:2 with linespoints title '{} m deep, {} m away' {} pt {}",
                shown == 0 ? "" : ", ", shown, receiver.depth_m, receiver.range_m,
                Gnuplot::style(shown), shown + 1);
            ++shown;
        }
        add(s, "set title '{}' noenhanced\nset grid\nset key outside\n",
            title_of(result.task->environment));
        s += "set xlabel 'time behind the first arrival, ms'\n"
             "set ylabel 'loss of the path, dB re 1 m'\nset yrange [] reverse\n";
        return s + (list.empty() ? "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n"
                                 : "plot [0:] " + list + "\n");
    }
};

}  // namespace seautils::tools

#endif  // SEAUTILS_TOOLS_TL_PLOT_HPP
