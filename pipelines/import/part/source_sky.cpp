// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/source_sky.h"

#include "cook/probes/probe.h"
#include "pipelines/import/part/part_builder.h"

#include <tbb/parallel_for.h>

namespace hearth::import
{

using environment::Environment;
using environment::Layout;

namespace
{

/// Points of a texel along each side that turnSky takes the mean of.
constexpr uint32_t kPoints = 4;

/// Return the mean radiance of a texel of a turned cube.
Float3 averageTurned(const Environment& cube, const Affine3d& cube_from_world, uint32_t panel, uint32_t x,
                     uint32_t y)
{
    Double3 sum;
    for (uint32_t i = 0; i < kPoints * kPoints; ++i)
    {
        const environment::PanelPoint point{(x + (i % kPoints + 0.5) / kPoints) / cube.width,
                                            (y + (i / kPoints + 0.5) / kPoints) / cube.height};
        const Double3 direction = panelDirection(Layout::cube, panel, point);
        sum = sum + widen(cube.texels[findTexel(cube, transformVector(cube_from_world, direction))]);
    }
    return narrow(sum * (1.0 / (kPoints * kPoints)));
}

} // namespace

Environment turnSky(const SourceSky& sky)
{
    HEARTH_ASSERT(sky.cube.layout == Layout::cube);
    const std::optional<Affine3d> cube_from_world = inverted(sky.world_from_cube);
    HEARTH_ASSERT(cube_from_world.has_value());
    if (*cube_from_world == Affine3d{})
        return sky.cube;
    Environment turned{Layout::cube, sky.cube.width, sky.cube.height, {}};
    turned.texels.resize(sky.cube.texels.size());
    tbb::parallel_for(0u, 6 * turned.height,
                      [&](uint32_t row)
                      {
                          const uint32_t panel = row / turned.height, y = row % turned.height;
                          for (uint32_t x = 0; x < turned.width; ++x)
                              turned.texels[turned.index(panel, x, y)] =
                                  averageTurned(sky.cube, *cube_from_world, panel, x, y);
                      });
    return turned;
}

Status writeSky(PartBuilder& part, uint32_t max_size)
{
    if (!part.sky)
        return success();
    HEARTH_ASSIGN_OR_RETURN(probes::Probe probe, probes::cookProbe(turnSky(*part.sky), part.sourceName(),
                                                                   probes::kProbeSide, max_size));
    probe.record.flags = formats::kProbeIsSky;
    return part.addProbe(probe.record, probe.texels);
}

} // namespace hearth::import
