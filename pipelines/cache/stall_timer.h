// Stall detection for cache servers: tells when a server has become slower than cooking without it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cstdint>

namespace hearth::cache
{

/// Minimum speed of a server that is worth waiting for. A cache hit saves running an action, which takes a
/// tenth of a second at least, and minutes for a large mesh.
struct StallLimits
{
    double max_lag_s = 5;              ///< maximum lag: covers a hiccup, or a disk that has to spin up
    double seconds_per_request = 0.25; ///< allowance for each request
    double bytes_per_s = 256 * 1024;   ///< of contents: throughput of a poor line to an office
    double connect_timeout_s = 3;      ///< connection timeout
};

/// Measures how far a server lags behind its minimum speed. Earlier speed earns no credit: a server that
/// stops responding is given up after `max_lag_s`.
class StallTimer
{
public:
    explicit StallTimer(const StallLimits& limits) : limits_(limits) {}

    /// Account for a wait of `seconds`, in which `requests` were answered and `bytes` received or sent.
    /// returns  false if the server has stalled
    bool addWait(double seconds, uint64_t requests, uint64_t bytes)
    {
        const double allowed_s = limits_.seconds_per_request * static_cast<double>(requests) +
                                 static_cast<double>(bytes) / limits_.bytes_per_s;
        lag_s_ = std::max(0.0, lag_s_ + seconds - allowed_s);
        return lag_s_ <= limits_.max_lag_s;
    }

private:
    StallLimits limits_;
    double lag_s_ = 0;
};

} // namespace hearth::cache
