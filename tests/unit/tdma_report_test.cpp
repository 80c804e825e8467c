// Simulations as text and as JSON.
#include "seautils/core/error.hpp"
#include "seautils/tdma/report.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace seautils::tdma {
namespace {

using nlohmann::json;

Network table() { return {{1, 3}, 0, {{Rule::goby1, 5}, 1, 0}}; }
constexpr std::int64_t slot_ns = 15'000'000'000;

std::string refusal(void (*parse)(std::string_view), std::string_view text) {
    try {
        parse(text);
        return "taken";
    } catch (const DataError& e) {
        return e.what();
    }
}

}  // namespace

TEST(TdmaReport, StepsAsText) {
    Network network = table();
    std::string text;
    append_head_text(network, text);
    for (int k = 0; k < 3; ++k) {
        network.step();
        append_step_text(network, {1, 1}, slot_ns, text);
    }
    EXPECT_EQ(text,
              "    slot      time_s   1   3\n"
              "       0           0   S   S\n"
              "       1          15   B   B\n"
              "       2          30   B   S   1 finds 3\n");
}

TEST(TdmaReport, StepsAsJson) {
    Network network = table();
    std::string text;
    for (int k = 0; k < 3; ++k) {
        network.step();
        text.clear();
        append_step_json(network, slot_ns, text);
    }
    EXPECT_EQ(json::parse(text), json::parse(R"({"step": {"slot": 2, "time_s": 30, "vehicles": [
        {"id": 1, "cycle": 1, "does": "blank", "heard": [3], "knows": [1, 3]},
        {"id": 3, "cycle": 1, "does": "send", "heard": [], "knows": [3]}]}})"));
    EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(TdmaReport, Outcomes) {
    Network network = table();
    std::string text;
    append_outcome_text(network, run(network, 1000), slot_ns, text);
    Network never({1, 5}, 0, {{Rule::goby1, 4}, 1, 0});
    append_outcome_text(never, run(never, 1000), slot_ns, text);
    Network late({1, 5}, 7, {{Rule::goby1, 4}, 1, 0});
    append_outcome_text(late, run(late, 5), slot_ns, text);
    EXPECT_EQ(
        text,
        "everybody knows everybody after 7 slots (105 s), and all take turns after 9 (135 s)\n"
        "not everybody knows everybody after 16 slots, and never will\n"
        "not everybody knows everybody after 5 slots\n");
}

TEST(TdmaReport, Summaries) {
    Summary summary;
    std::string text;
    append_summary_json(summary, text);
    EXPECT_TRUE(json::parse(text)["summary"]["mean_slots"].is_null());
    SurveyOptions options;
    options.network.excitation = {Rule::goby1, 4};
    survey({1, 3}, options, summary);
    survey({1, 5}, options, summary);
    text.clear();
    append_summary_json(summary, text);
    EXPECT_EQ(json::parse(text), json::parse(R"({"summary": {"runs": 2, "failed": 1, "proven": 1,
        "quiet": 2, "mean_slots": 7, "mean_settled_slots": 9, "longest_slots": 7}})"));
    text.clear();
    append_set_json({1, 3}, summary, text);
    EXPECT_EQ(json::parse(text)["network"]["vehicles"], json::parse("[1,3]"));
    EXPECT_EQ(json::parse(text)["network"]["failed"], 1);
    text.clear();
    append_set_text({1, 3}, summary, text);
    append_summary_text(summary, text);
    EXPECT_EQ(
        text,
        "1 3                      1 of 2 failed, else 7.000 slots\n"
        "2 runs, 1 failed (50.00 %); everybody known after 7.000 slots on average, 7 at most; "
        "nothing got through in the first two slots of 100.000 %\n");
}

TEST(TdmaReport, AddressesAndPools) {
    EXPECT_EQ(parse_addresses("3"), std::vector<int>{3});
    EXPECT_EQ(parse_addresses("12,3,127"), (std::vector<int>{3, 12, 127}));
    EXPECT_EQ(parse_pool("1-10").last, 10);
    EXPECT_EQ(parse_pool("5-5").first, 5);
    const auto addresses = [](std::string_view t) { parse_addresses(t); };
    EXPECT_EQ(refusal(addresses, ""), "address '' is outside 1 to 127");
    EXPECT_EQ(refusal(addresses, "1,"), "address '' is outside 1 to 127");
    EXPECT_EQ(refusal(addresses, "1,0"), "address '0' is outside 1 to 127");
    EXPECT_EQ(refusal(addresses, "1,128"), "address '128' is outside 1 to 127");
    EXPECT_EQ(refusal(addresses, "1, 2"), "address ' 2' is outside 1 to 127");
    EXPECT_EQ(refusal(addresses, "4,4"), "address 4 is given twice");
    const auto pool = [](std::string_view t) { parse_pool(t); };
    EXPECT_EQ(refusal(pool, "10"), "pool '10' is not of the form 1-10");
    EXPECT_EQ(refusal(pool, "9-1"), "pool '9-1' is empty");
    EXPECT_EQ(refusal(pool, "-1-3"), "address '' is outside 1 to 127");
}

}  // namespace seautils::tdma
