#include "seautils/dccl/murmur.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace seautils::dccl {
namespace {

#if defined(__GLIBCXX__) && defined(__LP64__)
TEST(DcclMurmur, IsTheStandardLibrarysHash) {
    std::string text;
    for (int size = 0; size < 300; ++size) {
        EXPECT_EQ(std_string_hash(text), std::hash<std::string>{}(text)) << size;
        text += static_cast<char>(size * 37 + 200);  // bytes above 127 too
    }
}
#endif

TEST(DcclMurmur, EmptyText) {  // fold(fold(seed) * m) by hand, with any calculator of 64 bits
    EXPECT_EQ(std_string_hash(""), 0x553e93901e462a6eU);
}

TEST(DcclMurmur, Comb) {
    EXPECT_EQ(comb(0, 0), 0x9e3779b9U);
    EXPECT_EQ(comb(4, 1), 4U ^ (1U + 0x9e3779b9U + 256U + 1U));
    EXPECT_EQ(comb(~std::uint64_t{0}, 0),
              ~(std::uint64_t{0x9e3779b9} - 64 + 0x3fffffffffffffffU));  // wraps
}

}  // namespace
}  // namespace seautils::dccl
