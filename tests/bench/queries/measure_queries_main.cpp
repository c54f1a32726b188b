// Measures rays against packs on one core: between random points of a scene's bounds, which no ray shares
// with the one before. `./dev bench runtime` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "runtime/pack/pack.h"
#include "runtime/pack/queries/scene_queries.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace hearth;

constexpr uint32_t kRays = 20000;
constexpr uint64_t kPageBytes = uint64_t{512} << 20; // all pages of most scenes

double measureSeconds(const auto& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<pack::Ray> makeRays(const Box3& box)
{
    std::mt19937 random(1);
    const auto between = [&](float low, float high)
    { return double{low} + (double{high} - double{low}) * (static_cast<double>(random()) / 4294967296.0); };
    const auto point = [&]
    {
        const double x = between(box.min.x, box.max.x), y = between(box.min.y, box.max.y);
        return Double3{x, y, between(box.min.z, box.max.z)};
    };
    std::vector<pack::Ray> rays(kRays);
    for (pack::Ray& ray : rays)
    {
        ray.origin = point();
        ray.direction = point() - ray.origin;
    }
    return rays;
}

struct CastResult
{
    double seconds = 0;
    uint32_t hits = 0;
};

Result<CastResult> castAll(pack::SceneQueries& queries, const std::vector<pack::Ray>& rays,
                           const pack::CastOptions& options)
{
    CastResult result;
    Status status = success();
    result.seconds = measureSeconds(
        [&]
        {
            for (const pack::Ray& ray : rays)
            {
                const auto found = queries.cast(ray, options);
                if (!found.ok())
                    status = found.error();
                else
                    result.hits += found->has_value();
            }
        });
    HEARTH_TRY(std::move(status));
    return result;
}

Status measure(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(path));
    std::optional<pack::SceneQueries> queries;
    const double creation = measureSeconds([&] { queries.emplace(pack.view(), kPageBytes); });
    const uint32_t instances = queries->states().count();
    const std::vector<pack::Ray> rays = makeRays(queries->bounds(0, instances));
    HEARTH_ASSIGN_OR_RETURN(const CastResult cold, castAll(*queries, rays, {}));
    HEARTH_ASSIGN_OR_RETURN(const CastResult nearest, castAll(*queries, rays, {}));
    HEARTH_ASSIGN_OR_RETURN(const CastResult any, castAll(*queries, rays, {.any_hit = true}));
    std::printf("%s: %u instances, %zu clusters, %zu pages\n", path.c_str(), instances,
                pack->clusters().size(), pack->pages().size());
    std::printf("create               %8.3f s\n", creation);
    std::printf("%u rays           %8.0f a second, %.0f %% hit; %.0f where pages are decoded first\n", kRays,
                kRays / nearest.seconds, 100.0 * nearest.hits / kRays, kRays / cold.seconds);
    std::printf("any hit              %8.0f a second\n", kRays / any.seconds);
    return success();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures rays against packs on the CPU.", "hearth_measure_queries");
    std::vector<std::string> paths;
    app.addOption("PACK", paths, "the packs").required();
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    for (const std::string& path : paths)
        if (const Status measured = measure(path); !measured.ok())
            return reportFailure(measured.error());
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_queries", [&] { return program(argc, argv); });
}
