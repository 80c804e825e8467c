// Plots that OAST leaves: a .plp and, behind a line of `%%`, its .plt. Any text gives curves, or a refusal in a decent
// message; curves have the values that were there, and no more.
#include "common.hpp"

#include "seautils/toolbox/oast_file.hpp"

#include <cstddef>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    fuzz::context = text;
    const std::size_t at = text.find("\n%%\n");
    const std::string_view plp = text.substr(0, at == text.npos ? text.size() : at + 1);
    const std::string_view plt = at == text.npos ? std::string_view{} : text.substr(at + 4);
    fuzz::accepted([&] {
        std::size_t values = 0;
        for (const auto& curve : seautils::toolbox::read_plots(plp, plt)) {
            values += curve.y.size();
            if (curve.y.empty()) continue;
            fuzz::accepted(
                [&] { seautils::toolbox::value_at(curve, curve.first + curve.step / 2); });
        }
        fuzz::require(values <= plt.size(), "no more values than text");
    });
    return 0;
}
