// Encrypted messages through the codec: what is hidden, from whom, and what a wrong key does.
#include "dccl_bench.hpp"

#include <cryptopp/aes.h>
#include <cryptopp/modes.h>
#include <cryptopp/sha.h>

namespace seautils::dccl {
namespace {

const std::string fields =
    "required uint32 seq = 1 [(dccl.field) = { min: 0 max: 255 in_head: true }];"
    "optional string s = 2 [(dccl.field).max_length = 40];";

std::string sha256(const std::string& text) {
    std::string digest(32, '\0');
    CryptoPP::SHA256 sha;
    sha.CalculateDigest(reinterpret_cast<CryptoPP::byte*>(digest.data()),
                        reinterpret_cast<const CryptoPP::byte*>(text.data()), text.size());
    return digest;
}

/// AES-256 in counter mode made of single blocks: the counter is one big-endian number.
std::string crypted(const std::string& passphrase, const std::string& head, std::string body) {
    const std::string key = sha256(passphrase);
    std::string counter = sha256(head).substr(0, 16);
    const CryptoPP::AES::Encryption aes(reinterpret_cast<const CryptoPP::byte*>(key.data()), 32);
    for (std::size_t at = 0; at < body.size(); ++at) {
        CryptoPP::byte block[16];
        aes.ProcessBlock(reinterpret_cast<const CryptoPP::byte*>(counter.data()), block);
        body[at] = static_cast<char>(static_cast<CryptoPP::byte>(body[at]) ^ block[at % 16]);
        if (at % 16 != 15) continue;
        for (std::size_t k = 16; k-- > 0;) {
            counter[k] = static_cast<char>(counter[k] + 1);
            if (counter[k] != 0) break;
        }
    }
    return body;
}

TEST(DcclCodecCrypto, TheBodyAloneUnderTheHeadersHash) {
    Bench b(version4(fields));
    for (const std::size_t length : {0, 1, 14, 15, 16, 30, 40}) {
        const std::string text = "seq: 77 s: \"" + std::string(length, 'q') + "\"";
        b.options.passphrase.reset();
        const std::string plain = from_hex(b.encode(text));
        b.options.passphrase = "correct horse";
        const std::string sealed = from_hex(b.encode(text));
        EXPECT_EQ(sealed.substr(0, 2), plain.substr(0, 2));
        EXPECT_EQ(to_hex(sealed.substr(2)),
                  to_hex(crypted("correct horse", plain.substr(0, 2), plain.substr(2))));
        EXPECT_EQ(b.decode(to_hex(sealed)), b.message(text)->ShortDebugString());
    }
}

TEST(DcclCodecCrypto, WithoutAnIdentifierOrAHeaderTheNonceIsOfNothing) {
    Bench b(
        "message M { option (dccl.msg) = { omit_id: true max_bytes: 9 codec_version: 4 };"
        " required uint32 v = 1 [(dccl.field) = { min: 0 max: 1023 }]; }");
    b.options.passphrase = "nonce is empty";
    EXPECT_EQ(b.encode("v: 700"), to_hex(crypted("nonce is empty", "", from_hex("bc02"))));
    EXPECT_EQ(b.decode(b.encode("v: 700")), "v: 700");
}

TEST(DcclCodecCrypto, AnEmptyBodyStaysEmpty) {
    Bench b(
        version4("required uint32 seq = 1 [(dccl.field) = { min: 0 max: 255 in_head: true }];"));
    b.options.passphrase = "x";
    EXPECT_EQ(b.encode("seq: 5"), "0205");
    EXPECT_EQ(b.decode("0205"), "seq: 5");
}

TEST(DcclCodecCrypto, AWrongKeyGivesGarbageOrARefusalAndNeverTheText) {
    Bench b(version4(fields));
    b.options.passphrase = "right";
    const std::string text = "seq: 1 s: \"the quick brown fox jumps over it\"";
    const std::string sealed = b.encode(text);
    Codec codec([] {
        CodecOptions o;
        o.passphrase = "wrong";
        return o;
    }());
    codec.load(b.program());
    auto got = b.message("");
    try {
        codec.decode(from_hex(sealed), *got, *b.program());
        EXPECT_NE(got->ShortDebugString(), b.message(text)->ShortDebugString());
        EXPECT_EQ(got->ShortDebugString().substr(0, 7), "seq: 1 ") << "the header is in clear";
    } catch (const DataError&) {  // a length that the bytes do not have
    }
}

TEST(DcclCodecCrypto, AHeaderNeedsNoKey) {
    Bench b(version4(fields));
    b.options.passphrase = "right";
    const std::string sealed = b.encode("seq: 9 s: \"abc\"");
    b.options.passphrase.reset();
    b.options.header_only = true;
    EXPECT_EQ(b.decode(sealed.substr(0, 4)), "seq: 9");
}

TEST(DcclCodecCrypto, IdsThatAreLeftInClear) {
    Bench b(version4(fields));
    const std::string text = "seq: 9 s: \"abc\"";
    const std::string plain = b.encode(text);
    b.options.passphrase = "x";
    b.options.skip_crypto_ids = {1, 40};
    EXPECT_EQ(b.encode(text), plain);
    EXPECT_EQ(b.decode(plain), b.message(text)->ShortDebugString());
    b.options.skip_crypto_ids = {2, 40};
    EXPECT_NE(b.encode(text), plain);
    // The id that counts is the one on the wire.
    b.program_options.user_id = 2;
    Bench other(version4(fields), b.program_options);
    other.options = b.options;
    const std::string clear = other.encode(text);
    EXPECT_EQ(clear.substr(4), plain.substr(4));
}

TEST(DcclCodecCrypto, StreamsOfSealedMessages) {
    Bench b(version4(fields));
    b.options.passphrase = "x";
    std::string stream;
    for (int k = 0; k < 50; ++k) {
        stream += from_hex(b.encode("seq: " + std::to_string(k) + " s: \"" +
                                    std::string(static_cast<std::size_t>(k % 40), 'a') + "\""));
    }
    Codec codec(b.options);
    codec.load(b.program());
    for (int k = 0; k < 50; ++k) {
        auto got = b.message("");
        stream.erase(0, codec.decode(stream, *got, *b.program()).bytes);
        EXPECT_EQ(got->ShortDebugString(), "seq: " + std::to_string(k) + " s: \"" +
                                               std::string(static_cast<std::size_t>(k % 40), 'a') +
                                               "\"");
    }
    EXPECT_TRUE(stream.empty());
}

}  // namespace
}  // namespace seautils::dccl
