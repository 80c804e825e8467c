#ifndef SEAUTILS_DCCL_CRYPTO_HPP
#define SEAUTILS_DCCL_CRYPTO_HPP

#include <cstddef>
#include <memory>
#include <string_view>

namespace seautils::dccl {

/// Encrypts and decrypts the bodies of messages: AES-256 in counter mode (NIST SP 800-38A).
///
/// The key is SHA-256 of the passphrase. The first counter block is the first 16 bytes of SHA-256
/// of the message's head, and counts up as a big-endian number of 128 bits. Nothing is
/// authenticated, and two messages with equal heads share their key stream: a time or a sequence
/// number belongs in the head. The key leaves memory with the object.
///
/// Not thread-safe, not even apply(); movable.
///
/// Check value: with passphrase "correct horse" and head f4 80 38 47 02, zeros become 8a 9e 9e 35 …
class Cipher {
public:
    explicit Cipher(std::string_view passphrase);
    ~Cipher();
    Cipher(Cipher&&) noexcept;
    Cipher& operator=(Cipher&&) noexcept;

    /// Turns a plain body into the encrypted one in place, and back.
    /// @param head  all bytes before the body, the identifier included; may be empty
    void apply(std::string_view head, char* body, std::size_t size) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace seautils::dccl

#endif  // SEAUTILS_DCCL_CRYPTO_HPP
