#include "seautils/acoustics/sound_speed.hpp"

#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <cmath>
#include <cstddef>
#include <string>

namespace seautils::acoustics {

namespace {

/// The coefficients of the UNESCO equation: powers of temperature along a row, of pressure (bar)
/// down the rows.
struct UnescoTable {
    double c[4][6];
    double a[4][5];
    double b[2][2];
    double d[2];
};

constexpr UnescoTable its_90{{{1402.388, 5.03830, -5.81090e-2, 3.3432e-4, -1.47797e-6, 3.1419e-9},
                              {0.153563, 6.8999e-4, -8.1829e-6, 1.3632e-7, -6.1260e-10},
                              {3.1260e-5, -1.7111e-6, 2.5986e-8, -2.5353e-10, 1.0415e-12},
                              {-9.7729e-9, 3.8513e-10, -2.3654e-12}},
                             {{1.389, -1.262e-2, 7.166e-5, 2.008e-6, -3.21e-8},
                              {9.4742e-5, -1.2583e-5, -6.4928e-8, 1.0515e-8, -2.0142e-10},
                              {-3.9064e-7, 9.1061e-9, -1.6009e-10, 7.994e-12},
                              {1.100e-10, 6.651e-12, -3.391e-13}},
                             {{-1.922e-2, -4.42e-5}, {7.3637e-5, 1.7950e-7}},
                             {1.727e-3, -7.9836e-6}};

constexpr UnescoTable ipts_68{{{1402.388, 5.03711, -5.80852e-2, 3.3420e-4, -1.47800e-6, 3.1464e-9},
                               {0.153563, 6.8982e-4, -8.1788e-6, 1.3621e-7, -6.1185e-10},
                               {3.1260e-5, -1.7107e-6, 2.5974e-8, -2.5335e-10, 1.0405e-12},
                               {-9.7729e-9, 3.8504e-10, -2.3643e-12}},
                              {{1.389, -1.262e-2, 7.164e-5, 2.006e-6, -3.21e-8},
                               {9.4742e-5, -1.2580e-5, -6.4885e-8, 1.0507e-8, -2.0122e-10},
                               {-3.9064e-7, 9.1041e-9, -1.6002e-10, 7.988e-12},
                               {1.100e-10, 6.649e-12, -3.389e-13}},
                              {{-1.922e-2, -4.42e-5}, {7.3637e-5, 1.7945e-7}},
                              {1.727e-3, -7.9836e-6}};

template <std::size_t n>
double polynomial(const double (&coefficients)[n], double x) {
    double sum = 0;
    for (std::size_t k = n; k-- > 0;) sum = sum * x + coefficients[k];
    return sum;
}

template <std::size_t rows, std::size_t n>
double polynomial(const double (&coefficients)[rows][n], double x, double y) {
    double sum = 0;
    for (std::size_t k = rows; k-- > 0;) sum = sum * y + polynomial(coefficients[k], x);
    return sum;
}

/// The square root of a salinity; that of none where rubbish is asked for.
double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

double unesco_mps(const UnescoTable& table, double t, double s, double pressure_dbar) {
    const double bar = pressure_dbar / 10;
    return polynomial(table.c, t, bar) +
           s * (polynomial(table.a, t, bar) + root(s) * polynomial(table.b, t, bar) +
                s * polynomial(table.d, bar));
}

constexpr SpeedRange ranges[]{
    {0, 40, 0, 40, 10000, true},     // chen_millero
    {0, 30, 30, 40, 9806.65, true},  // del_grosso
    {2, 30, 25, 40, 8000, false},    // mackenzie
    {-2, 34, 0, 42, 12000, false},   // leroy
    {0, 35, 0, 45, 1000, false},     // medwin
    {0, 35, 0, 45, 4000, false},     // coppens
};

double speed_mps(SpeedFormula formula, const Water& w) {
    switch (formula) {
        case SpeedFormula::chen_millero:
            return chen_millero_mps(w.temperature_c, w.salinity, w.pressure_dbar);
        case SpeedFormula::del_grosso:
            return del_grosso_mps(w.temperature_c, w.salinity, w.pressure_dbar);
        case SpeedFormula::mackenzie:
            return mackenzie_mps(w.temperature_c, w.salinity, w.depth_m);
        case SpeedFormula::leroy:
            return leroy_mps(w.temperature_c, w.salinity, w.depth_m, w.latitude_deg);
        case SpeedFormula::medwin:
            return medwin_mps(w.temperature_c, w.salinity, w.depth_m);
        default:
            return coppens_mps(w.temperature_c, w.salinity, w.depth_m);
    }
}

}  // namespace

std::string_view name(SpeedFormula formula) {
    static constexpr std::string_view names[]{"chen-millero", "del-grosso", "mackenzie",
                                              "leroy",        "medwin",     "coppens"};
    return names[static_cast<std::size_t>(formula)];
}

SpeedFormula parse_formula(std::string_view text) {
    std::string all;
    for (const SpeedFormula formula : all_formulas) {
        if (text == name(formula)) return formula;
        all.append(all.empty() ? "" : ", ").append(name(formula));
    }
    throw DataError("formula " + quote(text) + " is none of " + all);
}

const SpeedRange& range_of(SpeedFormula formula) {
    return ranges[static_cast<std::size_t>(formula)];
}

SoundSpeed sound_speed(SpeedFormula formula, const Water& water) {
    constexpr double above_surface = -0.5;
    const SpeedRange& r = range_of(formula);
    const double vertical = r.by_pressure ? water.pressure_dbar : water.depth_m;
    const bool within = water.temperature_c >= r.least_temperature_c &&
                        water.temperature_c <= r.most_temperature_c &&
                        water.salinity >= r.least_salinity && water.salinity <= r.most_salinity &&
                        vertical >= above_surface && vertical <= r.most_vertical;
    return {speed_mps(formula, water), !within};
}

double chen_millero_mps(double t, double s, double pressure_dbar) {
    return unesco_mps(its_90, t, s, pressure_dbar);
}

double chen_millero_68_mps(double t68, double s, double pressure_dbar) {
    return unesco_mps(ipts_68, t68, s, pressure_dbar);
}

double del_grosso_mps(double t, double s, double pressure_dbar) {
    const double p = pressure_dbar / 9.80665;  // kg/cm²
    const double of_t = t * (5.012285 + t * (-0.0551184 + t * 2.21649e-4));
    const double of_s = s * (1.329530 + s * 1.288598e-4);
    const double of_p = p * (0.1560592 + p * (2.449993e-5 - p * 8.833959e-9));
    const double mixed = -1.275936e-2 * s * t + 6.353509e-3 * t * p + 2.656174e-8 * t * t * p * p -
                         1.593895e-6 * t * p * p + 5.222483e-10 * t * p * p * p -
                         4.383615e-7 * t * t * t * p - 1.616745e-9 * s * s * p * p +
                         9.688441e-5 * s * t * t + 4.857614e-6 * s * s * t * p -
                         3.406824e-4 * s * t * p;
    return 1402.392 + of_t + of_s + of_p + mixed;
}

double mackenzie_mps(double t, double s, double d) {
    return 1448.96 + t * (4.591 + t * (-5.304e-2 + t * 2.374e-4)) + 1.340 * (s - 35) +
           d * (1.630e-2 + d * 1.675e-7) - 1.025e-2 * t * (s - 35) - 7.139e-13 * t * d * d * d;
}

double leroy_mps(double t, double s, double z, double latitude_deg) {
    return 1402.5 + t * (5 + t * (-5.44e-2 + t * 2.1e-4)) + 1.33 * s - 1.23e-2 * s * t +
           8.7e-5 * s * t * t + z * (1.56e-2 + z * (2.55e-7 - z * 7.3e-12)) +
           1.2e-6 * z * (latitude_deg - 45) - 9.5e-13 * t * z * z * z + 3e-7 * t * t * z +
           1.43e-5 * s * z;
}

double medwin_mps(double t, double s, double z) {
    return 1449.2 + t * (4.6 + t * (-0.055 + t * 2.9e-4)) + (1.34 - 0.010 * t) * (s - 35) +
           0.016 * z;
}

double coppens_mps(double temperature_c, double s, double depth_m) {
    const double t = temperature_c / 10, d = depth_m / 1000;
    const double surface = 1449.05 + t * (45.7 + t * (-5.21 + t * 0.23)) +
                           (1.333 + t * (-0.126 + t * 0.009)) * (s - 35);
    return surface + d * (16.23 + 0.253 * t + d * (0.213 - 0.1 * t)) +
           (0.016 + 0.0002 * (s - 35)) * (s - 35) * t * d;
}

double temperature_at_speed_c(SpeedFormula formula, double sound_speed_mps, Water water) {
    double low = -4, high = 40;
    for (int k = 0; k < 60; ++k) {
        water.temperature_c = (low + high) / 2;
        (speed_mps(formula, water) < sound_speed_mps ? low : high) = water.temperature_c;
    }
    return (low + high) / 2;
}

}  // namespace seautils::acoustics
