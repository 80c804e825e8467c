// How values are quoted in messages; what is UTF-8; base64 by RFC 4648.
#include "seautils/core/error.hpp"
#include "seautils/core/text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace seautils {
namespace {

/// UTF-8 of a code point, written from the definition.
std::string encoded(std::uint32_t c) {
    const auto tail = [&](unsigned shift) { return static_cast<char>(0x80 | (c >> shift & 0x3f)); };
    if (c < 0x80) return {static_cast<char>(c)};
    if (c < 0x800) return {static_cast<char>(0xc0 | c >> 6), tail(0)};
    if (c < 0x10000) return {static_cast<char>(0xe0 | c >> 12), tail(6), tail(0)};
    return {static_cast<char>(0xf0 | c >> 18), tail(12), tail(6), tail(0)};
}

bool is_scalar(std::uint32_t c) { return c < 0x110000 && (c < 0xd800 || c > 0xdfff); }

std::string base64(std::string_view bytes) {
    std::string text;
    append_base64(text, bytes);
    return text;
}

std::string base64_refusal(const std::string& text) {
    try {
        return "taken: " + from_base64(text);
    } catch (const DataError& e) {
        return e.what();
    }
}

/// Any bytes, more often than not UTF-8 in part.
rc::Gen<std::string> any_bytes() {
    return rc::gen::oneOf(
        rc::gen::arbitrary<std::string>(),
        rc::gen::container<std::string>(rc::gen::elementOf(std::string("aé\xe2\x82\xac\xf0\x9f\x98"
                                                                       "\x80\xc2\xed\xa0\xff"))));
}

}  // namespace

TEST(CoreText, EveryCodePointAndNoSurrogateIsUtf8) {
    for (std::uint32_t c = 0; c < 0x110400; ++c) {
        const std::string text = encoded(c);
        ASSERT_EQ(utf8_length(text), is_scalar(c) ? text.size() : 0U) << c;
    }
}

TEST(CoreText, AllPairsOfBytes) {
    for (unsigned a = 0; a < 256; ++a) {
        for (unsigned b = 0; b < 256; ++b) {
            const std::string text{static_cast<char>(a), static_cast<char>(b)};
            const bool two = a >= 0xc2 && a <= 0xdf && b >= 0x80 && b <= 0xbf;
            ASSERT_EQ(utf8_length(text), a < 0x80 ? 1U : two ? 2U : 0U) << a << ' ' << b;
            ASSERT_EQ(is_valid_utf8(text), (a < 0x80 && b < 0x80) || two) << a << ' ' << b;
        }
    }
}

TEST(CoreText, OverlongAndCutFormsAreNoUtf8) {
    for (const char* bad :
         {"\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xe0\x9f\xbf", "\xf0\x80\x80\x80",
          "\xf0\x8f\xbf\xbf", "\xed\xa0\x80", "\xed\xbf\xbf", "\xf4\x90\x80\x80",
          "\xf5\x80\x80\x80", "\xfe", "\xff", "\x80", "\xe2\x82", "\xf0\x9f\x98", "\xe2\x82\x41"}) {
        EXPECT_EQ(utf8_length(bad), 0U);
        EXPECT_FALSE(is_valid_utf8(std::string("ok") + bad));
    }
    EXPECT_TRUE(is_valid_utf8(""));
    EXPECT_EQ(utf8_length(""), 0U);
    EXPECT_TRUE(is_valid_utf8(std::string(1, '\0')));
}

TEST(CoreText, WhatIsShownIsOneLineOfUtf8) {
    EXPECT_EQ(printable("a\tb\x1b[31m\x7f\xff"), R"(a\x09b\x1b[31m\x7f\xff)");
    EXPECT_EQ(printable("Tiefe in µPa 😀"), "Tiefe in µPa 😀");
    EXPECT_EQ(printable("abcdef", 3), "abc…");
    EXPECT_EQ(printable("abc", 3), "abc");
    EXPECT_EQ(printable("aéb", 2), "aé…");  // no character is cut
    EXPECT_TRUE(rc::check("printable", [] {
        const std::string text = *any_bytes();
        const auto most = *rc::gen::inRange<std::size_t>(0, 40);
        const std::string shown = printable(text, most);
        RC_ASSERT(is_valid_utf8(shown));
        for (const char c : shown) RC_ASSERT(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
        RC_ASSERT(shown.size() <= 4 * most + 3 + 3);
        RC_ASSERT(printable(shown) == shown);
    }));
}

TEST(CoreText, AQuotedValueIsShort) {
    EXPECT_EQ(quote(""), "''");
    EXPECT_EQ(quote("99999"), "'99999'");
    EXPECT_EQ(quote(std::string(60, 'x')), "'" + std::string(60, 'x') + "'");
    EXPECT_EQ(quote(std::string(61, 'x')), "'" + std::string(60, 'x') + "…'");
    EXPECT_LT(quote(std::string(1U << 20, '\0')).size(), 260U);
}

TEST(CoreText, CountsAndSentences) {
    EXPECT_EQ(counted(0, "byte"), "0 bytes");
    EXPECT_EQ(counted(1, "byte"), "1 byte");
    EXPECT_EQ(counted(2, "byte"), "2 bytes");
    EXPECT_EQ(where_left(6, "bit", 0), "6 bits where 0 are left");
    EXPECT_EQ(where_left(2, "byte", 1), "2 bytes where 1 is left");
    EXPECT_EQ(lower_first("Expected \";\""), "expected \";\"");
    EXPECT_EQ(lower_first("UTF-8 is expected"), "UTF-8 is expected");
    EXPECT_EQ(lower_first(""), "");
    EXPECT_EQ(lower_first("A"), "A");
}

TEST(CoreText, TheNearestName) {
    const std::vector<std::string> names{"depth_m", "heading_deg", "speed_mps"};
    EXPECT_EQ(nearest("depth", names), "");  // 2 edits of 5 letters are too many
    EXPECT_EQ(nearest("depth_n", names), "depth_m");
    EXPECT_EQ(nearest("speed_mp", names), "speed_mps");
    EXPECT_EQ(nearest("hedding_deg", names), "heading_deg");
    EXPECT_EQ(nearest("salinity", names), "");
    EXPECT_EQ(nearest("x", {"y"}), "y");
    EXPECT_EQ(nearest("ab", {"ax", "ay"}), "ax");  // the first of equals
    EXPECT_EQ(nearest("", {"abc"}), "");
    EXPECT_EQ(nearest("abc", {}), "");
    EXPECT_EQ(nearest(std::string(1U << 20, 'x'), {std::string(1U << 20, 'x')}), "");
}

TEST(CoreText, Base64OfRfc4648) {
    // Test vectors of section 10.
    const std::vector<std::pair<std::string, std::string>> vectors{{"", ""},
                                                                   {"f", "Zg=="},
                                                                   {"fo", "Zm8="},
                                                                   {"foo", "Zm9v"},
                                                                   {"foob", "Zm9vYg=="},
                                                                   {"fooba", "Zm9vYmE="},
                                                                   {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : vectors) {
        EXPECT_EQ(base64(bytes), text);
        EXPECT_EQ(from_base64(text), bytes);
        EXPECT_EQ(from_base64(text.substr(0, text.find('='))), bytes);
    }
    EXPECT_EQ(base64("\xfb\xff\xbf"), "+/+/");
    EXPECT_EQ(from_base64("-_-_"), "\xfb\xff\xbf");
}

TEST(CoreText, Base64ReadsBackTheSame) {
    EXPECT_TRUE(rc::check("base64", [](const std::string& bytes) {
        const std::string text = base64(bytes);
        RC_ASSERT(text.size() == (bytes.size() + 2) / 3 * 4);
        RC_ASSERT(from_base64(text) == bytes);
        RC_ASSERT(from_base64(text.substr(0, text.find('='))) == bytes);
    }));
}

TEST(CoreText, WhatIsNoBase64IsNamed) {
    EXPECT_EQ(base64_refusal("Zm9v!mFy"), "'!' in column 5 is no base64 digit");
    EXPECT_EQ(base64_refusal("Zm 9v"), "base64 of 5 characters is cut short");
    EXPECT_EQ(base64_refusal("Zm9 "), "' ' in column 4 is no base64 digit");
    EXPECT_EQ(base64_refusal("Z"), "base64 of 1 character is cut short");
    EXPECT_EQ(base64_refusal("="), "base64 of 1 character is cut short");
    EXPECT_EQ(base64_refusal("Zg="), "base64 of 3 characters is cut short");
    EXPECT_EQ(base64_refusal("Zg==="), "base64 of 5 characters is cut short");
    EXPECT_EQ(base64_refusal("Z==="), "'=' in column 2 is no base64 digit");
    EXPECT_EQ(base64_refusal("===="), "'=' in column 1 is no base64 digit");
    EXPECT_EQ(base64_refusal("Zg==Zg=="), "'=' in column 3 is no base64 digit");
    EXPECT_EQ(base64_refusal("QR=="), "base64 that ends within a byte");  // QQ== is "A"
    EXPECT_EQ(base64_refusal("QUJ"), "base64 that ends within a byte");   // QUI is "AB"
    EXPECT_EQ(base64_refusal(std::string("\0AAA", 4)), R"('\x00' in column 1 is no base64 digit)");
}

}  // namespace seautils
