// Environment files: any text gives an environment, or a refusal in a decent message, and check() then holds or says why.
#include "common.hpp"

#include "seautils/propagation/case_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::view(data, size);
    fuzz::context = text;
    fuzz::accepted([&] {
        const seautils::propagation::Case c = seautils::propagation::read_case(text);
        for (const std::string& remark : c.remarks)
            fuzz::require(seautils::is_valid_utf8(remark) && remark.size() < 400, "a remark");
        seautils::propagation::check(c.environment);
        fuzz::require(c.environment.frequency_hz > 0 && !c.environment.receivers.range_m.empty(),
                      "what holds means something");
    });
    return 0;
}
