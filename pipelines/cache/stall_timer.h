// Stall detection for cache servers: tells when a server has become slower than cooking without it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cstdint>

namespace hearth::cache
{

/// Minimum speed of a server that is worth waiting for. A cache hit saves running an action, which takes a
/// tenth of a second at least, and minutes for a large mesh.
struct Pace
{
    double behind_s = 5;             ///< maximum lag: covers a hiccup, or a disk that has to spin up
    double request_s = 0.25;         ///< allowance for each request
    double bytes_per_s = 256 * 1024; ///< of contents: throughput of a poor line to an office
    double connect_s = 3;            ///< connection timeout
};

/// Measures how far a server lags behind its minimum speed. Earlier speed earns no credit: a server that
/// stops responding is given up after `behind_s`.
class Patience
{
public:
    explicit Patience(const Pace& pace) : pace_(pace) {}

    /// Account for a wait of `seconds`, in which `requests` were answered and `bytes` received or sent.
    /// returns  false if the server has stalled
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
