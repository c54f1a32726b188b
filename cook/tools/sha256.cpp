// By Nettle: its plain functions cost 0.3 ms of a program's start, where libcrypto costs 3 ms (fetching and configuration)
// and libgcrypt 0.5 ms (self-tests); all three use the processor's SHA instructions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/sha256.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <memory>
#include <nettle/sha2.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace hearth::tools
{

namespace
{

class Hash
{
public:
    Hash() { ::sha256_init(&state_); }

    void add(const void* bytes, size_t size)
    {
        ::sha256_update(&state_, size, static_cast<const uint8_t*>(bytes));
    }

    std::string hex()
    {
        std::array<uint8_t, SHA256_DIGEST_SIZE> digest;
        ::sha256_digest(&state_, digest.size(), digest.data());
        std::string text;
        for (const uint8_t byte : digest)
        {
            text += "0123456789abcdef"[byte >> 4];
            text += "0123456789abcdef"[byte & 15];
        }
        return text;
    }

private:
    sha256_ctx state_;
};

} // namespace

std::string sha256Of(std::span<const std::byte> bytes)
{
    Hash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hex();
}

std::string sha256Of(std::string_view text)
{
    return sha256Of(std::as_bytes(std::span(text)));
}

std::optional<std::string> sha256OfFile(const std::string& path)
{
    // without O_NONBLOCK the open of a pipe waits for a writer
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file < 0)
        return std::nullopt;
    struct stat info = {};
    bool readable = ::fstat(file, &info) == 0 && S_ISREG(info.st_mode);
    Hash hash;
    std::vector<std::byte> piece(std::clamp<size_t>(static_cast<size_t>(info.st_size) + 1, 4096, 1 << 18));
    while (readable)
    {
        const ssize_t size = ::read(file, piece.data(), piece.size());
        if (size < 0 && errno == EINTR)
            continue;
        if (size == 0)
            break;
        readable = size > 0;
        if (readable)
            hash.add(piece.data(), static_cast<size_t>(size));
    }
    ::close(file);
    return readable ? std::optional(hash.hex()) : std::nullopt;
}

bool isSha256(std::string_view text)
{
    return text.size() == 2 * SHA256_DIGEST_SIZE &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

} // namespace hearth::tools
