#ifndef SEAUTILS_CLI_SOURCE_HPP
#define SEAUTILS_CLI_SOURCE_HPP

#include "seautils/cli/io.hpp"
#include "seautils/core/error.hpp"
#include "seautils/stream/input.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace seautils::cli {

/// A file of the command line, opened for reading: its descriptor and its name in messages.
struct OpenedFile {
    int fd = -1;
    std::string name;
    bool is_terminal = false;
    bool is_fifo = false;
    std::int64_t bytes = -1;  ///< of a regular file, else -1
};

/// Opens a FILE; "-" is standard input.
/// @param text  binary is not read from a terminal
/// @throws Error(no_input), Error(usage)
OpenedFile open_input(const std::string& file, bool text);

/// One input of records, which knows where it is.
class Source {
public:
    Source(std::string name, int fd, std::string path, stream::Input::Options options)
        : name_(std::move(name)), input_(fd, std::move(path), std::move(options)) {}

    stream::Input& input() { return input_; }
    const stream::Input& input() const { return input_; }

    /// `file:LINE: ` or `file:record N (byte OFFSET): `, of the last record read.
    std::string place(Framing framing) const;

    /// Does what reads the input, and says where it was when that fails.
    template <class Read>
    auto located(Framing framing, Read read) {
        try {
            return read();
        } catch (const Error& e) {
            if (e.code() == ExitCode::data) throw Error(e.code(), place(framing) + e.what());
            const bool failed = std::string_view(e.what()).starts_with("read failed");
            if (e.code() == ExitCode::io && failed) throw Error(e.code(), name_ + ": " + e.what());
            throw;
        }
    }

    /// The next record. What is cut or cannot be read ends it, located.
    /// @throws Error(data), Error(io)
    stream::Input::Got next(Framing framing, std::string_view& record) {
        return located(framing, [&] {
            return framing == Framing::lines ? input_.line(record) : input_.record(record);
        });
    }

    const std::string& name() const { return name_; }

private:
    std::string name_;
    stream::Input input_;
};

}  // namespace seautils::cli

#endif  // SEAUTILS_CLI_SOURCE_HPP
