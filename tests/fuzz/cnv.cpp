// Sea-Bird's .cnv: any text gives profiles that can be used, or refusals in decent messages.
#include "casts.hpp"

#include "seautils/acoustics/cnv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text = fuzz::view(data + 1, size - 1);
    fuzz::context = text;
    fuzz::read_cast(seautils::acoustics::Cnv(), text, data[0]);
    seautils::acoustics::parse_position(text);
    seautils::acoustics::parse_cnv_time(text);
    return 0;
}
