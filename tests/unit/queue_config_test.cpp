#include "seautils/queue/config.hpp"

#include "seautils/core/error.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace seautils::queue {
namespace {

constexpr std::int64_t s_ns = QueueConfig::ns_per_s;

std::string fault(std::string_view section, std::string_view key, std::string_view value) {
    try {
        QueueConfigs().set(section, key, value);
    } catch (const ConfigError& e) {
        return e.what();
    }
    return "";
}

TEST(QueueConfigs, DefaultsAreGobys) {
    const QueueConfig config = QueueConfigs().of({3, 0});
    EXPECT_TRUE(config.ack);
    EXPECT_EQ(config.blackout_ns, 0);
    EXPECT_EQ(config.max_queue, 100U);
    EXPECT_TRUE(config.newest_first);
    EXPECT_EQ(config.ttl_ns, 1800 * s_ns);
    EXPECT_EQ(config.value_base_e6, 1'000'000U);
}

TEST(QueueConfigs, TheNarrowerSectionWinsKeyByKey) {
    QueueConfigs configs;
    configs.set("12.3", "ttl_s", "30.5");
    configs.set("12", "ttl_s", "60");
    configs.set("12", "value_base", "2.5");
    configs.set("", "value_base", "0.1");
    configs.set("", "newest_first", "false");
    EXPECT_EQ(configs.of({12, 3}).ttl_ns, 30'500'000'000);
    EXPECT_EQ(configs.of({12, 3}).value_base_e6, 2'500'000U);
    EXPECT_FALSE(configs.of({12, 3}).newest_first);
    EXPECT_EQ(configs.of({12, 4}).ttl_ns, 60 * s_ns);
    EXPECT_EQ(configs.of({13, 3}).ttl_ns, 1800 * s_ns);
    EXPECT_EQ(configs.of({13, 3}).value_base_e6, 100'000U);
}

TEST(QueueConfigs, EveryKey) {
    QueueConfigs configs;
    configs.set("1", "ack", "false");
    configs.set("1", "blackout_time_s", "0.000000001");
    configs.set("1", "max_queue", "1");
    configs.set("1", "newest_first", "true");
    configs.set("1", "ttl_s", "infinite");
    configs.set("1", "value_base", "1000000");
    const QueueConfig config = configs.of({1, 7});
    EXPECT_FALSE(config.ack);
    EXPECT_EQ(config.blackout_ns, 1);
    EXPECT_EQ(config.max_queue, 1U);
    EXPECT_TRUE(config.is_infinite());
    EXPECT_EQ(config.value_base_e6, 1'000'000'000'000U);
}

// Pitfall 8: a ttl of 0 divides by nothing, a queue of 0 holds nothing.
TEST(QueueConfigs, NonsenseIsRefused) {
    const std::string ttl = " is not more than 0 and at most 1000000000 s, or infinite";
    EXPECT_EQ(fault("", "ttl_s", "0"), "ttl_s '0'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "0.000000000"), "ttl_s '0.000000000'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "-1"), "ttl_s '-1'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "inf"), "ttl_s 'inf'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "1e3"), "ttl_s '1e3'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "1000000001"), "ttl_s '1000000001'" + ttl);
    EXPECT_EQ(fault("", "ttl_s", "1.0000000001"), "ttl_s '1.0000000001'" + ttl);
    EXPECT_EQ(fault("", "max_queue", "0"), "max_queue '0' is not 1 to 1000000 messages");
    EXPECT_EQ(fault("", "max_queue", "1.5"), "max_queue '1.5' is not 1 to 1000000 messages");
    EXPECT_EQ(fault("", "value_base", "nan"),
              "value_base 'nan' is not 0 to 1000000, with at most 6 decimals");
    EXPECT_EQ(fault("", "value_base", "-0.5"),
              "value_base '-0.5' is not 0 to 1000000, with at most 6 decimals");
    EXPECT_EQ(fault("", "blackout_time_s", ""),
              "blackout_time_s '' is not 0 to 1000000000 s, with at most 9 decimals");
    EXPECT_EQ(fault("", "ack", "yes"), "ack 'yes' is not true or false");
    EXPECT_EQ(fault("", "newest_first", ""), "newest_first '' is not true or false");
    EXPECT_EQ(fault("", "tll_s", "5"), "unknown key 'tll_s' (did you mean 'ttl_s'?)");
}

TEST(QueueConfigs, ASectionNamesAQueue) {
    const std::string why =
        " names no queue: a DCCL id of 0 to 32767, or that, a point, and a modem ID of 0 to 30";
    for (const std::string section :
         {"x", "12.", ".3", "12.31", "32768", "-1", "1.2.3", "012", "1.5x", " 1", "1.03"})
        EXPECT_EQ(fault(section, "ack", "true"), "'" + section + "'" + why);
    EXPECT_EQ(fault("32767.30", "ack", "true"), "");
    EXPECT_EQ(fault("0", "ack", "true"), "");
}

TEST(ParseDecimal, IsExact) {
    EXPECT_TRUE(rc::check("what is printed is read", [] {
        const auto whole = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000);
        const auto fraction = *rc::gen::inRange<std::int64_t>(0, 1000);
        const std::string digits = std::to_string(1000 + fraction).substr(1);
        RC_ASSERT(parse_decimal(std::to_string(whole) + "." + digits, 3) ==
                  whole * 1000 + fraction);
        RC_ASSERT(parse_decimal(std::to_string(whole), 3) == whole * 1000);
        RC_ASSERT(!parse_decimal(std::to_string(whole) + "." + digits, 2));
    }));
    EXPECT_TRUE(rc::check("any text gives a number or nothing", [](const std::string& text) {
        const auto value = parse_decimal(text, 9);
        RC_ASSERT(!value || *value >= 0);
    }));
    EXPECT_EQ(parse_decimal("999999999999999999", 0), 999'999'999'999'999'999);
    EXPECT_FALSE(parse_decimal("9999999999999999999", 0));
    EXPECT_FALSE(parse_decimal("99999999999999999999999999", 0));
    EXPECT_FALSE(parse_decimal("1000000000000", 9));
    EXPECT_FALSE(parse_decimal(".5", 1));
    EXPECT_FALSE(parse_decimal("5.", 1));
    EXPECT_FALSE(parse_decimal("1.2.3", 3));
    EXPECT_FALSE(parse_decimal("+1", 0));
}

}  // namespace
}  // namespace seautils::queue
