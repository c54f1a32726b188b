// Measures wraps of 200,000 triangles: processor time, triangles, distances from the source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/open_part.h"
#include "cook/wrap/thread_time.h"
#include "cook/wrap/wrap_mesh.h"
#include "formats/base/program.h"
#include "tests/bench/aims.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace
{

using namespace hearth;
using mesh::SourceMesh;

SourceMesh named(SourceMesh mesh, const char* name)
{
    mesh.name = name;
    return mesh;
}

/// Copies of rocks that are pushed into each other.
SourceMesh makeKit()
{
    SourceMesh kit;
    for (uint32_t i = 0; i < 20; ++i)
    {
        SourceMesh rock = shapes::rock(29, 0.2f, i + 1);
        const auto along = static_cast<float>(i);
        for (Float3& position : rock.positions)
            position = position + Float3{0.7f * along, 0.3f * static_cast<float>(i % 3), 0};
        shapes::append(kit, rock);
    }
    return kit;
}

/// A torus whose outer half has square treads, two triangles wide: the source that took longest.
SourceMesh makeTyre()
{
    constexpr uint32_t kAround = 1000, kAcross = 100; // rings, and quads of a ring
    SourceMesh tyre;
    for (uint32_t ring = 0; ring < kAround; ++ring)
        for (uint32_t k = 0; k < kAcross; ++k)
        {
            const double along = 2 * std::numbers::pi * ring / kAround;
            const double across = 2 * std::numbers::pi * k / kAcross;
            const bool is_tread = std::cos(across) > 0 && ring / 4 % 2 == 0 && k / 4 % 2 == 0;
            const double radius = is_tread ? 0.4 : 0.3;
            const double from_axis = 1 + radius * std::cos(across);
            tyre.positions.push_back(narrow(
                {from_axis * std::cos(along), radius * std::sin(across), from_axis * std::sin(along)}));
            const auto vertex = [&](uint32_t rings, uint32_t steps)
            { return (ring + rings) % kAround * kAcross + (k + steps) % kAcross; };
            for (const uint32_t corner :
                 {vertex(0, 0), vertex(0, 1), vertex(1, 1), vertex(0, 0), vertex(1, 1), vertex(1, 0)})
                tyre.indices.push_back(corner);
        }
    tyre.triangle_materials.assign(tyre.triangleCount(), 0);
    return tyre;
}

/// Wrap a mesh and print a line of figures.
/// returns  processor seconds. errors: those of wrapMesh
Result<double> measure(const SourceMesh& mesh, const wrap::WrapOptions& options, const std::string& file,
                       uint32_t index)
{
    const double start = wrap::threadSeconds();
    HEARTH_ASSIGN_OR_RETURN(const SourceMesh wrap, wrap::wrapMesh(mesh, options, file, index));
    const double seconds = wrap::threadSeconds() - start;
    if (wrap.indices.empty())
    {
        std::printf("%-24s %8zu triangles: empty\n", mesh.name.c_str(), mesh.triangleCount());
        return seconds;
    }
    Float3 low = mesh.positions[mesh.indices.front()], high = low;
    for (const uint32_t vertex : mesh.indices)
    {
        low = min(low, mesh.positions[vertex]);
        high = max(high, mesh.positions[vertex]);
    }
    const double size = length(widen(high) - widen(low));
    const SurfaceDistance distance(mesh.positions, mesh.indices);
    double sum = 0;
    const auto points = evenlySpread(wrap.positions, wrap.indices, 20000);
    for (const SurfacePoint& point : points)
        sum += distance.to(valueAt(point, wrap.positions, wrap.indices));
    std::printf("%-24s %8zu triangles: %6.2f s of processor, %6zu triangles, mean distance %.4f, max %.4f of "
                "the diagonal\n",
                mesh.name.c_str(), mesh.triangleCount(), seconds, wrap.triangleCount(),
                sum / static_cast<double>(points.size()) / size,
                largestDistance(wrap.positions, wrap.indices, 20000, distance) / size);
    std::fflush(stdout);
    return seconds;
}

/// errors: those of openPart, readSourceMesh and wrapMesh
Status measurePart(const std::string& path, const wrap::WrapOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView part, tools::openPart(path));
    for (uint32_t i = 0; part.container().find(formats::kChunkSourceMesh, i) != nullptr; ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const SourceMesh mesh, mesh::readSourceMesh(part.container(), i));
        HEARTH_TRY(measure(mesh, options, path, i));
    }
    return success();
}

/// errors: those of wrapMesh
Status measureShapes(const wrap::WrapOptions& options, bench::Judgement& judgement)
{
    for (const SourceMesh& mesh :
         {named(shapes::rock(129, 0.3f), "rock"), named(shapes::blocks(129), "blocks"),
          named(shapes::terrain(316), "terrain"), named(makeKit(), "20 rocks in each other"),
          named(shapes::grid(316), "flat grid"), named(makeTyre(), "tyre")})
    {
        HEARTH_ASSIGN_OR_RETURN(const double seconds, measure(mesh, options, "bench", 0));
        judgement.record("s of processor for 200,000 triangles", seconds);
    }
    return success();
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app("Measures wraps of generated meshes, or of the meshes of import parts.");
    std::vector<std::string> parts;
    wrap::WrapOptions options;
    app.addOption("PARTS", parts, "import parts: their wraps are printed beside no aim");
    app.addOption("--alpha", options.alpha, "as hearth-wrap's").showDefault();
    app.addOption("--offset", options.offset, "as hearth-wrap's").showDefault();
    app.addOption("--error", options.error, "as hearth-wrap's").showDefault();
    app.addOption("--triangles", options.triangles, "as hearth-wrap's");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    for (const std::string& part : parts)
        if (const Status status = measurePart(part, options); !status.ok())
            reportFailure(status.error());
    if (!parts.empty())
        return 0;
    bench::Judgement judgement("wrap");
    if (const Status status = measureShapes(options, judgement); !status.ok())
        return reportFailure(status.error());
    return judgement.finish();
}
