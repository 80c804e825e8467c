// Any text as the queues' sections of a configuration file: refused, or queues that make sense.
#include "common.hpp"

#include "seautils/cli/config_file.hpp"
#include "seautils/queue/config.hpp"

using namespace seautils;

namespace {

void check(const queue::QueueConfig& config) {
    fuzz::require(config.max_queue >= 1, "a queue holds a message");
    fuzz::require(config.ttl_ns >= 0 && config.ttl_ns <= 1'000'000'000'000'000'000, "a ttl");
    fuzz::require(config.blackout_ns >= 0, "a blackout does not end before it begins");
    fuzz::require(config.value_base_e6 <= 1'000'000'000'000, "a value is within its bounds");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<cli::ConfigOption> options{{"id", "modem ID", "N"},
                                                        {"queue.*", "", ""}};
    fuzz::accepted([&] {
        const auto values =
            cli::parse_config("input.conf", std::string(fuzz::view(data, size)), options);
        queue::QueueConfigs configs;
        for (const auto& entry : values) {
            const std::string& key = entry.first;
            const auto& list = entry.second;
            if (!key.starts_with("queue.")) continue;
            const std::size_t end = key.rfind('.');
            const std::string section = end > 6 ? key.substr(6, end - 6) : "";
            fuzz::accepted([&] { configs.set(section, key.substr(end + 1), list.front()); });
        }
        for (const std::uint32_t id : {0U, 1U, 12U, 32767U}) {
            for (const std::uint32_t dest : {0U, 3U, 30U}) check(configs.of({id, dest}));
        }
    });
    return 0;
}
