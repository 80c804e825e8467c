#ifndef SEAUTILS_TOOLBOX_PROGRAM_HPP
#define SEAUTILS_TOOLBOX_PROGRAM_HPP

#include <csignal>
#include <cstdint>
#include <string>
#include <vector>

namespace seautils::toolbox {

/// What a program may take before it is ended.
struct ProgramLimits {
    double seconds = 60;
    std::uint64_t memory_bytes = std::uint64_t{2} << 30;  ///< of address space
};

/// A folder of one's own, which goes with all that is in it. While it is there, signals that would end
/// the process wait: it ends when the folder has gone.
class PrivateFolder {
public:
    /// @param parent  where it is to be made. @throws Error(cannot_create)
    explicit PrivateFolder(const std::string& parent);
    ~PrivateFolder();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
    sigset_t before_{};  ///< signals that waited anyway
};

/// Runs a program in a folder, without a shell, with nothing to read and nowhere to write but files, and waits for its
/// end; with it ends what it started.
/// @param names  of the program, the first that is there is run
/// @throws Error(unavailable)  none is there; Error(try_again)  it did not end in time; DataError  it failed: its status or
///                    signal
/// A signal that waits, see PrivateFolder, ends it as if its time were over.
void run_program(const std::vector<std::string>& names, const std::vector<std::string>& arguments,
                 const std::string& folder, const ProgramLimits& limits);

}  // namespace seautils::toolbox

#endif  // SEAUTILS_TOOLBOX_PROGRAM_HPP
