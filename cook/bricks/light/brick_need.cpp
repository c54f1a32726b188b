// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/brick_need.h"

#include "cook/bricks/light/sky_sight.h"
#include "formats/scene/asset_placement.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::bricks
{

namespace
{

bool areSourcesUnplaced(const StaticScene& scene)
{
    std::vector<Box3> boxes(scene.sources.size());
    for (const StaticInstance& instance : scene.instances)
        boxes[instance.source].add(instance.box);
    std::erase_if(boxes, [](const Box3& box) { return box.empty(); });
    return formats::areUnplaced(boxes);
}

Result<SkySight> measureSight(const StaticScene& scene, const GridSettings& settings)
{
    const double size = settings.voxel_size.value_or(firstVoxelSize(scene.box()));
    HEARTH_ASSIGN_OR_RETURN(const GridFrame frame, makeGridFrame(settings, scene.box(), size));
    HEARTH_ASSIGN_OR_RETURN(
        const RayScene rays,
        RayScene::build(scene, findCutClusters(scene, static_cast<float>(size * settings.error_share)),
                        frame));
    std::vector<Float3> cameras;
    for (const Float3 camera : scene.cameras)
        cameras.push_back((camera - frame.origin) / frame.voxel_size);
    return measureSkySight(rays, cameras);
}

} // namespace

Result<std::string> findReasonForNoBricks(const StaticScene& scene, const GridSettings& settings)
{
    if (scene.instances.empty())
        return std::string("all that it draws moves");
    if (areSourcesUnplaced(scene))
        return std::string("the assets stand in each other, as if never placed");
    HEARTH_ASSIGN_OR_RETURN(const SkySight sight, measureSight(scene, settings));
    if (sight.isEnclosed())
        return std::string();
    return fmt::format("{} of {} points on surfaces and {} of {} cameras see less than a tenth of the sky",
                       sight.dark_surface_points, sight.surface_points, sight.dark_cameras, sight.cameras);
}

} // namespace hearth::bricks
