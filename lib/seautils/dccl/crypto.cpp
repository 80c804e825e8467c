#include "seautils/dccl/crypto.hpp"

#include <cryptopp/aes.h>
#include <cryptopp/modes.h>
#include <cryptopp/secblock.h>
#include <cryptopp/sha.h>

namespace seautils::dccl {

namespace {

using Digest = CryptoPP::FixedSizeSecBlock<CryptoPP::byte, CryptoPP::SHA256::DIGESTSIZE>;

const CryptoPP::byte* as_bytes(const char* text) {
    return reinterpret_cast<const CryptoPP::byte*>(text);
}

}  // namespace

/// What Crypto++ keeps of a key lies in its secure blocks, which are wiped when destroyed.
struct Cipher::Impl {
    CryptoPP::SHA256 sha;
    CryptoPP::CTR_Mode<CryptoPP::AES>::Encryption counter_mode;

    void digest(std::string_view text, Digest& out) {
        sha.CalculateDigest(out, as_bytes(text.data()), text.size());
    }
};

Cipher::Cipher(std::string_view passphrase) : impl_(std::make_unique<Impl>()) {
    Digest key;
    impl_->digest(passphrase, key);
    const CryptoPP::byte counter[CryptoPP::AES::BLOCKSIZE] = {};  // each body sets its own
    impl_->counter_mode.SetKeyWithIV(key, key.size(), counter, sizeof counter);
}

Cipher::~Cipher() = default;
Cipher::Cipher(Cipher&&) noexcept = default;
Cipher& Cipher::operator=(Cipher&&) noexcept = default;

void Cipher::apply(std::string_view head, char* body, std::size_t size) const {
    if (size == 0) return;
    Digest counter;
    impl_->digest(head, counter);
    impl_->counter_mode.Resynchronize(counter, CryptoPP::AES::BLOCKSIZE);
    auto* bytes = reinterpret_cast<CryptoPP::byte*>(body);
    impl_->counter_mode.ProcessData(bytes, bytes, size);
}

}  // namespace seautils::dccl
