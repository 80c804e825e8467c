#ifndef SEAUTILS_CORE_ERROR_HPP
#define SEAUTILS_CORE_ERROR_HPP

#include <stdexcept>
#include <string>

namespace seautils {

/// Exit statuses, the same in every tool (seautils(7)); 64 and up are those of sysexits.h.
enum class ExitCode : int {
    ok = 0,              ///< every record used
    some_refused = 1,    ///< reached the end, some records were refused
    usage = 64,          ///< the command line is wrong
    data = 65,           ///< the data are wrong, and reading stopped there
    no_input = 66,       ///< an input cannot be opened
    unavailable = 69,    ///< a device is not there
    internal = 70,       ///< a fault of seautils itself
    cannot_create = 73,  ///< an output cannot be created
    io = 74,             ///< a read or a write failed
    try_again = 75,      ///< timed out, try again
    config = 78,         ///< a configuration file or a schema is wrong
};

/// An error with the status that it ends the program with.
///
/// `what()` is one line without location: no capital, no stop, the value quoted, the bound with
/// its unit. The tool puts its own name and the place of the record in front.
class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& what) : std::runtime_error(what), code_(code) {}
    ExitCode code() const noexcept { return code_; }

private:
    ExitCode code_;
};

/// A record that cannot be used. Inside a stream it is reported and dropped; the next one is read.
class DataError : public Error {
public:
    explicit DataError(const std::string& what) : Error(ExitCode::data, what) {}
};

/// A schema, a model or a configuration file that cannot be used.
class ConfigError : public Error {
public:
    explicit ConfigError(const std::string& what) : Error(ExitCode::config, what) {}
};

}  // namespace seautils

#endif  // SEAUTILS_CORE_ERROR_HPP
