// Environment files of the Acoustics Toolbox with those beside them: any text gives an environment, or a refusal in a
// decent message. What is read and holds, is read again from what is written of it.
#include "common.hpp"

#include "seautils/propagation/environment.hpp"
#include "seautils/toolbox/arr_file.hpp"
#include "seautils/toolbox/env_file.hpp"
#include "seautils/toolbox/env_writer.hpp"
#include "seautils/toolbox/shd_file.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace tb = seautils::toolbox;

namespace {

/// Files are parted by lines of `%% EXTENSION`; the first is the .env.
tb::Files parts(std::string_view text) {
    tb::Files files;
    std::string extension = "env";
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        if (line.starts_with("%% "))
            extension = line.substr(3, 3);
        else
            files[extension].append(line).push_back('\n');
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return files;
}

std::optional<tb::EnvFile> read(const tb::Files& files) {
    std::optional<tb::EnvFile> result;
    const auto at = files.find("env");
    fuzz::accepted([&] {
        result = tb::read_env(at == files.end() ? "" : at->second,
                              [&](const std::string& extension) -> std::optional<std::string> {
                                  const auto file = files.find(extension);
                                  if (file == files.end()) return std::nullopt;
                                  return file->second;
                              });
    });
    return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    fuzz::context = text;
    const auto file = read(parts(text));
    if (file) {
        fuzz::require(!file->source_depth_m.empty() && !file->environment.water.profile.empty(),
                      "a source and a profile");
        bool is_sound = fuzz::accepted([&] { seautils::propagation::check(file->environment); });
        std::optional<tb::Files> again;
        if (is_sound)
            fuzz::accepted([&] {
                const auto& e = file->environment;
                again = e.bottom.layers.empty()
                            ? tb::write_bellhop(e, file->options, file->arrivals)
                            : tb::write_kraken(e, file->options, {1400, 1600}, 1);
            });
        if (again) fuzz::require(read(*again).has_value(), "what is written is read");
    }
    fuzz::accepted([&] { tb::read_arr(text); });
    fuzz::accepted([&] { tb::read_arr(text, true); });
    fuzz::accepted([&] { tb::read_shd(text); });
    return 0;
}
