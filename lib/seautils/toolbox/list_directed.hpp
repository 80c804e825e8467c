#ifndef SEAUTILS_TOOLBOX_LIST_DIRECTED_HPP
#define SEAUTILS_TOOLBOX_LIST_DIRECTED_HPP

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seautils::toolbox {

/// Metres, to the micrometre, so that 0.57 km is 570 m.
double metres(double km);

/// Text as Fortran's list-directed READ (*) takes it: values between blanks, commas and line ends; `3*1.5` is a value
/// three times, `3*` and `,,` leave values as they are, and so does `/` with all that remain. What follows the last value
/// wanted on its line is ignored; a READ that is not satisfied goes on to the next line.
///
/// The text must outlive it. All refusals say the line.
class ListDirected {
public:
    explicit ListDirected(std::string_view text) : text_(text) {}

    /// One READ: values are asked for one by one, each with its name for messages. One that the text leaves alone keeps
    /// what it is.
    class Read {
    public:
        /// @return whether the text says it
        /// @throws DataError  it is no number, or the text ends
        bool real(double& x, std::string_view name);
        /// @throws DataError  it is no whole number of least to most, too
        bool whole(std::int64_t& x, std::string_view name, std::int64_t least, std::int64_t most);
        /// A text in quotes, or up to a blank or comma.
        bool text(std::string& x, std::string_view name);
        /// Whether `/` has ended it.
        bool is_ended() const { return is_ended_; }

    private:
        friend class ListDirected;
        explicit Read(ListDirected& from) : from_(from) {}
        /// The next value as it stands. False: it is left alone.
        bool next(std::string_view name);
        void take_repeats(std::string_view name);
        void take_quoted(std::string_view name);

        ListDirected& from_;
        std::string token_;
        std::int64_t repeats_ = 0;
        bool is_null_ = false, is_quoted_ = false, is_ended_ = false;
    };

    /// Calls `values` with a READ, and goes to the line behind it.
    template <class Values>
    void read(Values values) {
        Read one(*this);
        values(one);
        skip_line();
    }

    /// `N`, and in the next READ as many values. The Acoustics Toolbox's abbreviations count: of three or more, the first
    /// and the last stand for equal steps, and one for all.
    /// @throws DataError  N is outside 1 to `most`; values are not there
    std::vector<double> vector(std::string_view name, std::size_t most);
    /// The same of kilometres, in metres.
    std::vector<double> vector_km(std::string_view name, std::size_t most);

    /// Of what comes next, from 1.
    std::size_t line() const { return line_; }
    /// Whether only blanks are left.
    bool is_at_end() const { return text_.find_first_not_of(" \t\r\n", at_) == text_.npos; }
    /// What is left. For looking ahead.
    std::string_view rest() const { return text_.substr(at_); }

    [[noreturn]] void refuse(std::string_view what) const;

private:
    void skip_line();
    bool skip_blanks();
    std::vector<double> values(std::string_view name, std::size_t most, double (*unit)(double));

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
};

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_LIST_DIRECTED_HPP
