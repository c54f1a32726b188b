// When a server has kept a cook waiting for so long that the cook is better off without it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cstdint>

namespace hearth::cache
{

/// What a server has to do to be worth its waiting. An action that is found need not run, which would take a tenth of a
/// second at least, and minutes for a large mesh.
struct Pace
{
    double behind_s = 5;     ///< that a server may lie behind: a hiccup, or a disk that has to spin up
    double request_s = 0.25; ///< a request
    double bytes_per_s = 256 * 1024; ///< of contents: what a poor line to an office carries
    double connect_s = 3;            ///< until a connection stands
};

/// Counts how far a server lies behind its pace. To have been fast buys nothing: a server that stops is given up after
/// `behind_s`, whatever it did before.
class Patience
{
public:
    explicit Patience(const Pace& pace) : pace_(pace) {}

    /// Seconds were waited, in which so many requests were answered and bytes came or went.
    /// returns  false where it is at an end
    bool spend(double seconds, uint64_t requests, uint64_t bytes)
    {
        const double earned =
            pace_.request_s * static_cast<double>(requests) + static_cast<double>(bytes) / pace_.bytes_per_s;
        behind_s_ = std::max(0.0, behind_s_ + seconds - earned);
        return behind_s_ <= pace_.behind_s;
    }

private:
    Pace pace_;
    double behind_s_ = 0;
};

} // namespace hearth::cache
