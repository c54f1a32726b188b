// Computes SHA-256 with libcrypto's plain functions. They add 1 ms to a program's start, the EVP interface
// 2.2 ms (it reads a configuration and fetches a provider); Nettle adds 0.6 ms and libgcrypt 0.9 ms, but are
// under the LGPL. All use the processor's SHA instructions and hash 1.3 GB/s and more.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
// the plain functions are deprecated, but start faster than EVP
#define OPENSSL_SUPPRESS_DEPRECATED
#include "cook/tools/sha256.h"

#include "formats/base/regular_file.h"

#include <algorithm>
#include <array>
#include <openssl/sha.h>
#include <vector>

namespace hearth::tools
{

namespace
{

class Sha256
{
public:
    Sha256() { ::SHA256_Init(&state_); }

    void add(const void* bytes, size_t size) { ::SHA256_Update(&state_, bytes, size); }

    std::string hex()
    {
        std::array<uint8_t, SHA256_DIGEST_LENGTH> digest;
        ::SHA256_Final(digest.data(), &state_);
        std::string text;
        for (const uint8_t byte : digest)
        {
            text += "0123456789abcdef"[byte >> 4];
            text += "0123456789abcdef"[byte & 15];
        }
        return text;
    }

private:
    SHA256_CTX state_;
};

} // namespace

std::string computeSha256(std::span<const std::byte> bytes)
{
    Sha256 hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hex();
}

std::string computeSha256(std::string_view text)
{
    return computeSha256(std::as_bytes(std::span(text)));
}

std::optional<std::string> computeFileSha256(const std::string& path)
{
    const RegularFile file(path);
    if (!file.isOpen())
        return std::nullopt;
    Sha256 hash;
    std::vector<std::byte> piece(std::clamp<size_t>(static_cast<size_t>(file.size()) + 1, 4096, 1 << 18));
    for (;;)
    {
        const ssize_t size = file.read(piece);
        if (size < 0)
            return std::nullopt;
        hash.add(piece.data(), static_cast<size_t>(size));
        if (static_cast<size_t>(size) < piece.size())
            return hash.hex();
    }
}

bool isSha256(std::string_view text)
{
    return text.size() == 2 * SHA256_DIGEST_LENGTH &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

} // namespace hearth::tools
