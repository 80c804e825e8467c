#include "seautils/dccl/crypto.hpp"

#include <cryptopp/aes.h>
#include <cryptopp/modes.h>
#include <cryptopp/sha.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace seautils::dccl {
namespace {

std::string bytes(std::string_view hex) {
    std::string out;
    for (; hex.size() >= 2; hex.remove_prefix(2)) {
        out += static_cast<char>(std::stoi(std::string(hex.substr(0, 2)), nullptr, 16));
    }
    return out;
}

std::string hex(std::string_view text) {
    std::string out;
    for (const char c : text) {
        out += "0123456789abcdef"[static_cast<unsigned char>(c) / 16];
        out += "0123456789abcdef"[static_cast<unsigned char>(c) % 16];
    }
    return out;
}

std::string applied(const Cipher& cipher, std::string_view head, std::string body) {
    cipher.apply(head, body.data(), body.size());
    return body;
}

// A vehicle's status that the reference library encoded: plain, then under four passphrases.
TEST(DcclCipher, BodiesOfTheReferenceLibrary) {
    const std::string head = bytes("f480384702");
    const std::string plain = bytes("39988dc485675e9407c71ae12d1b");
    const std::pair<const char*, const char*> cases[] = {
        {"correct horse", "b30613f11a2f29994bde80e50408"},
        {"x", "be020416a835a8845559adfe43ce"},
        {"κλειδί", "2e22b9537e4b2733d868c3bbfa4f"},
        {"a much longer pass phrase than thirty-two bytes of key material",
         "def58bfcd93750f645f5201320d6"}};
    for (const auto& [passphrase, body] : cases) {
        const Cipher cipher(passphrase);
        EXPECT_EQ(hex(applied(cipher, head, plain)), body) << passphrase;
        EXPECT_EQ(applied(cipher, head, bytes(body)), plain) << passphrase;
    }
}

// The other values were made with OpenSSL 3:
// K=$(printf 'correct horse' | sha256sum | cut -c1-64)
// IV=$(printf '\xf4\x80\x38\x47\x02' | sha256sum | cut -c1-32)
// head -c 5000 /dev/zero | openssl enc -aes-256-ctr -K $K -iv $IV | xxd -p
TEST(DcclCipher, CountsUpOverManyBlocks) {
    const std::string stream =
        applied(Cipher("correct horse"), bytes("f480384702"), std::string(5000, '\0'));
    EXPECT_EQ(hex(stream.substr(0, 48)),
              "8a9e9e359f48770d4c199a0429135a0e5fd86b371e0a7d95ce798a9007cdb51b"
              "e8a348ed3bf1a9eab3f7b61b9887f49b");
    EXPECT_EQ(hex(stream.substr(4984)), "7c3b49f76f75f6aee06bd02d1a09261c");
}

TEST(DcclCipher, EmptyTextsAreTexts) {
    EXPECT_EQ(hex(applied(Cipher(""), "", "seautils")), "97ee3efb3cf4f3dd");
    EXPECT_EQ(applied(Cipher(""), "", ""), "");
}

TEST(DcclCipher, EachBodyBeginsAnew) {
    const Cipher cipher("x");
    const std::string first = applied(cipher, "a", "some body");
    EXPECT_NE(applied(cipher, "b", "some body"), first);
    EXPECT_EQ(applied(cipher, "a", "some body"), first);
}

TEST(DcclCipher, Moves) {
    Cipher a("x");
    const std::string before = applied(a, "h", "body");
    Cipher b = std::move(a);
    EXPECT_EQ(applied(b, "h", "body"), before);
}

// The library that we stand on, as it is linked here.

TEST(DcclCipher, Sha256OfFips180) {
    CryptoPP::SHA256 sha;
    std::string digest(CryptoPP::SHA256::DIGESTSIZE, '\0');
    sha.CalculateDigest(reinterpret_cast<CryptoPP::byte*>(digest.data()),
                        reinterpret_cast<const CryptoPP::byte*>("abc"), 3);
    EXPECT_EQ(hex(digest), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(DcclCipher, CounterModeOfNistSp80038a) {  // F.5.5, CTR-AES256.Encrypt
    const std::string key =
        bytes("603deb1015ca71be2b73aef0857d77811f352c073b6108d72d9810a30914dff4");
    const std::string counter = bytes("f0f1f2f3f4f5f6f7f8f9fafbfcfdfeff");
    std::string text = bytes(
        "6bc1bee22e409f96e93d7e117393172aae2d8a571e03ac9c9eb76fac45af8e51"
        "30c81c46a35ce411e5fbc1191a0a52eff69f2445df4f9b17ad2b417be66c3710");
    CryptoPP::CTR_Mode<CryptoPP::AES>::Encryption mode(
        reinterpret_cast<const CryptoPP::byte*>(key.data()), key.size(),
        reinterpret_cast<const CryptoPP::byte*>(counter.data()));
    auto* data = reinterpret_cast<CryptoPP::byte*>(text.data());
    mode.ProcessData(data, data, text.size());
    EXPECT_EQ(hex(text),
              "601ec313775789a5b7a7f504bbf3d228f443e3ca4d62b59aca84e990cacaf5c5"
              "2b0930daa23de94ce87017ba2d84988ddfc9c58db67aada613c2dd08457941a6");
}

}  // namespace
}  // namespace seautils::dccl
