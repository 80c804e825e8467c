#ifndef SEAUTILS_CLI_MESSAGES_HPP
#define SEAUTILS_CLI_MESSAGES_HPP

#include <string>

namespace seautils::cli {

enum class Level { error, warning, info };

/// Lines on standard error: `tool: what`, with the journal's priority in front where standard error
/// is the journal, in colour where it is a terminal that wants it.
class Messages {
public:
    explicit Messages(std::string tool);

    /// `auto`, `always` or `never`; NO_COLOR and TERM=dumb count with `auto`.
    void set_color(const std::string& when);

    /// Writes one line; control characters in it are shown, not sent.
    void write(Level level, const std::string& what) const;

private:
    std::string tool_;
    bool journal_ = false;
    bool color_ = false;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_MESSAGES_HPP
