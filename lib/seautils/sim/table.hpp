#ifndef SEAUTILS_SIM_TABLE_HPP
#define SEAUTILS_SIM_TABLE_HPP

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seautils::sim {

/// Straight lines between points; outside of them the value of the nearest.
class Curve {
public:
    Curve() = default;
    /// @param points  x and y, x increasing, at least one
    /// @throws ConfigError  no point; x does not increase (says after which)
    explicit Curve(std::vector<std::pair<double, double>> points);

    bool empty() const { return points_.empty(); }
    double at(double x) const;
    const std::vector<std::pair<double, double>>& points() const { return points_; }

private:
    std::vector<std::pair<double, double>> points_;
};

/// A decimal number, all of `text`, from `least` to `most`.
/// @throws ConfigError  `WHAT 'text' is not a number`, `… is outside LEAST to MOST UNIT`
double number(std::string_view what, std::string_view text, double least, double most,
              std::string_view unit = "");

/// The text without blanks and carriage returns at its ends.
std::string_view trim(std::string_view text);

/// What stands between the separators, trimmed; one empty word for an empty text.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Comma-separated values: a line of names, then a line of values for each row. Lines that are
/// empty or begin with `#` are passed over. Only the columns asked for are kept.
class Csv {
public:
    /// @param name     of the file, for messages
    /// @throws ConfigError  no line of names
    Csv(std::string name, std::string_view text);

    /// The place of the first of `names` among the columns; -1 where none of them is.
    int column(const std::vector<std::string_view>& names) const;

    /// The next row that is not empty; false at the end.
    /// @throws ConfigError  `FILE:LINE: N values where M are named`
    bool next(std::vector<std::string_view>& values);

    /// Throws a ConfigError with the place of the last row in front.
    [[noreturn]] void fault(const std::string& what) const;

private:
    bool line(std::string_view& line);

    std::string name_;
    std::string_view rest_;
    std::vector<std::string_view> names_;
    std::size_t number_ = 0;
};

}  // namespace seautils::sim

#endif  // SEAUTILS_SIM_TABLE_HPP
