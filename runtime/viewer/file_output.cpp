// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/file_output.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::viewer
{

namespace
{

bool writeAll(int file, std::span<const std::byte> bytes)
{
    while (!bytes.empty())
    {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

float linearFromSrgb(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear)
{
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

} // namespace

Status writeFile(const std::string& path, std::span<const std::byte> bytes)
{
    std::string temporary = path + ".tmp-XXXXXX";
    const int file = ::mkstemp(temporary.data());
    if (file < 0)
        return Error{Issue::cannot_write, path, "", std::string("cannot create: ") + std::strerror(errno)};
    // mkstemp makes a private file; an output should have the permissions that the user's umask gives
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const bool written = writeAll(file, bytes) && ::fchmod(file, 0666 & ~mask) == 0 && ::fsync(file) == 0;
    const int reason = errno;
    ::close(file);
    if (written && ::rename(temporary.c_str(), path.c_str()) == 0)
        return success();
    const std::string detail = std::string("cannot write: ") + std::strerror(written ? errno : reason);
    ::unlink(temporary.c_str());
    return Error{Issue::cannot_write, path, "", detail};
}

std::vector<std::byte> downsampleSrgb(std::span<const std::byte> rgba, uint32_t width, uint32_t height)
{
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i)
        linear[i] = linearFromSrgb(static_cast<float>(i) / 255.0f);

    std::vector<std::byte> result(size_t{width / 2} * (height / 2) * 4);
    const auto at = [&](size_t x, size_t y, size_t c)
    { return std::to_integer<size_t>(rgba[(y * width + x) * 4 + c]); };
    for (size_t y = 0; y < height / 2; ++y)
        for (size_t x = 0; x < width / 2; ++x)
        {
            std::byte* pixel = &result[(y * (width / 2) + x) * 4];
            for (size_t c = 0; c < 3; ++c)
            {
                const float sum = linear[at(2 * x, 2 * y, c)] + linear[at(2 * x + 1, 2 * y, c)] +
                                  linear[at(2 * x, 2 * y + 1, c)] + linear[at(2 * x + 1, 2 * y + 1, c)];
                pixel[c] = static_cast<std::byte>(srgbFromLinear(sum * 0.25f) * 255.0f + 0.5f);
            }
            pixel[3] = std::byte{255};
        }
    return result;
}

} // namespace hearth::viewer
