// Tables of casts: any text gives profiles that can be used, or refusals in decent messages.
#include "casts.hpp"

#include "seautils/acoustics/ctd_csv.hpp"

using namespace seautils::acoustics;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text = fuzz::view(data + 1, size - 1);
    fuzz::context = text;
    std::vector<NamedColumn> named;
    if ((data[0] & 128) != 0)
        named = {parse_named_column("depth_m=2"), parse_named_column("sound_speed_mps=speed")};
    fuzz::read_cast(CtdCsv(named), text, data[0]);
    fuzz::accepted([&] { parse_named_column(text); });
    return 0;
}
