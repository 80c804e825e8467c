// The arithmetic coder: any bits decode to values of the model or run out, and any values come back.
// Input: eight bytes for the model, then bits, then (the same bytes) values.
#include "common.hpp"

#include "seautils/entropy/arithmetic.hpp"

#include <bit>
#include <cmath>

using namespace seautils;

namespace {

entropy::Model model_of(const std::uint8_t* data) {
    entropy::Model model;
    model.name = "fuzz";
    const unsigned k = 1 + data[0] % 16;
    for (unsigned i = 0; i < k; ++i) {
        const std::uint32_t weight = 1U + (data[1 + i % 4] ^ i);
        model.frequency.push_back(weight << data[5] % 16);
        model.value_bound.push_back(static_cast<double>(i) * (1 + data[6] % 4) - data[7]);
    }
    model.value_bound.push_back(model.value_bound.back() + 1.5);
    model.eof_frequency = data[5] % 3 == 0 ? 0 : data[6];
    model.out_of_range_frequency = data[7] % 3;
    model.is_adaptive = data[0] >= 128;
    return model;
}

struct Ended {};

template <class List>
std::string listed(const char* what, const List& list) {
    std::string text = what;
    for (const auto x : list) text += " " + std::to_string(x);
    return text + "\n";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 8) return 0;
    const entropy::Model model = model_of(data);
    if (!fuzz::accepted([&] { entropy::check(model); })) return 0;
    const std::uint32_t max_count = 1 + data[3];
    const std::size_t bits = (size - 8) * 8;
    std::size_t at = 0;
    std::vector<double> values;
    entropy::Counts counts(model);
    try {
        entropy::decode_run(
            model, counts, max_count,
            [&] {
                if (at == bits) throw Ended{};
                const bool bit = ((data[8 + at / 8] >> at % 8) & 1) != 0;
                ++at;
                return bit;
            },
            values);
    } catch (const Ended&) {
    }
    fuzz::require(values.size() <= max_count, "no more values than the most");

    // What was decoded, encoded: comes back the same, in as many bits as were written.
    std::erase_if(values, [](double x) { return std::isnan(x); });
    std::vector<bool> out;
    entropy::Counts encoder(model), decoder(model);
    const auto put = [&](bool bit) { out.push_back(bit); };
    if (!fuzz::accepted([&] { entropy::encode_run(model, encoder, values, max_count, put); }))
        return 0;
    std::vector<double> again;
    std::size_t read = 0;
    const auto get = [&] { return read < out.size() ? out[read++] : (++read, true); };
    entropy::decode_run(model, decoder, max_count, get, again);
    fuzz::context = listed("given", values) + listed("got", again) +
                    listed("weights", model.frequency) + listed("bounds", model.value_bound);
    // The format takes the nearer of two bounds by the squares: 1 stands for -1 where both are bounds.
    for (double& x : values) x = entropy::value_of(model, entropy::coded_symbol(model, x, false));
    fuzz::require(again == values, "values come back");
    fuzz::require(read <= out.size(), "no bit is read that was not written");
    return 0;
}
