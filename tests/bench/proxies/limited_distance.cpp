// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/proxies/limited_distance.h"

#include "formats/base/assert.h"
#include "tests/support/surfaces/cgal_distance.h"

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace hearth::bench
{

namespace
{

std::vector<uint32_t> takeEvery(std::span<const uint32_t> triangles, size_t stride)
{
    std::vector<uint32_t> taken;
    for (size_t t = 0; t < triangles.size(); t += 3 * stride)
        taken.insert(taken.end(), triangles.begin() + static_cast<ptrdiff_t>(t),
                     triangles.begin() + static_cast<ptrdiff_t>(t) + 3);
    return taken;
}

/// Run cgalDistance in a process of its own, which a limit ends. nullopt if it was ended.
std::optional<double> runLimited(const TriangleSurface& from, const TriangleSurface& to, double error,
                                 unsigned seconds)
{
    int ends[2];
    HEARTH_ASSERT(::pipe(ends) == 0);
    const pid_t process = ::fork();
    HEARTH_ASSERT(process >= 0);
    if (process == 0)
    {
        const rlimit limit{seconds, seconds};
        ::setrlimit(RLIMIT_CPU, &limit);
        const double distance = cgalDistance(from, to, error);
        const bool is_written = ::write(ends[1], &distance, sizeof(distance)) == sizeof(distance);
        ::_exit(is_written ? 0 : 1);
    }
    ::close(ends[1]);
    double distance = 0;
    const bool is_read = ::read(ends[0], &distance, sizeof(distance)) == sizeof(distance);
    ::close(ends[0]);
    int status = 0;
    ::waitpid(process, &status, 0);
    HEARTH_ASSERT(is_read ||
                  (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)));
    return is_read ? std::optional(distance) : std::nullopt;
}

} // namespace

std::optional<LimitedDistance> measureDistance(const TriangleSurface& from, const TriangleSurface& to,
                                               double error, unsigned seconds)
{
    for (size_t stride = 1; stride <= from.triangles.size() / 3; stride *= 10)
    {
        const std::vector<uint32_t> sample = takeEvery(from.triangles, stride);
        if (const auto distance = runLimited({from.positions, sample}, to, error, seconds))
            return LimitedDistance{*distance, stride};
    }
    return std::nullopt;
}

} // namespace hearth::bench
