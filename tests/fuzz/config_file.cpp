// Any text as a configuration file: it says only what may be said.
#include "common.hpp"

#include "seautils/cli/config_file.hpp"

using namespace seautils;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<cli::ConfigOption> options{
        {"schema", "where", "PATH", true, false},
        {"strict", "stop", "false", false, true},
        {"max-record", "bytes", "1048576", false, false},
        {"link.rate", "of a section", "80", false, false}};
    fuzz::accepted([&] {
        const auto values =
            cli::parse_config("input.conf", std::string(fuzz::view(data, size)), options);
        for (const auto& [key, list] : values) {
            bool known = false;
            for (const cli::ConfigOption& o : options) {
                known |= o.key == key && (o.repeatable || list.size() == 1);
            }
            fuzz::require(known && !list.empty(), "a key is one that may be said, and as often");
        }
    });
    return 0;
}
