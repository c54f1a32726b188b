// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/bake.h"

#include "cook/bricks/grid/brick_view.h"
#include "cook/bricks/grid/face_locations.h"
#include "cook/bricks/light/ray_scene.h"
#include "cook/bricks/light/scene_light.h"
#include "formats/gpu_shared/brick_lighting.h"

#include <algorithm>
#include <tbb/parallel_for.h>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Offset to either side of a triangle at which its voxel is looked up, in voxels: the triangle may lie in a
/// plane between two.
constexpr float kSurfaceOffset = 0.01f;

class LightBaker
{
public:
    LightBaker(const RayScene& rays, const BrickTables& tables, const Lighting& lighting)
        : rays_(rays),
          bricks_(makeBrickView(tables)),
          lighting_(lighting),
          sky_{lighting.sky_zenith, lighting.sky_horizon, lighting.sky_ground},
          places_(faceLocations(bricks_.masks)),
          faces_(places_.size())
    {
        for (size_t face = 0; face < faces_.size(); ++face)
            faces_[face] = encodeBrickLight(emission(face));
    }

    void sweep(uint32_t rays)
    {
        std::vector<BrickLight> next(faces_.size());
        tbb::parallel_for(size_t{0}, next.size(),
                          [&](size_t face) { next[face] = encodeBrickLight(outgoingRadiance(face, rays)); });
        faces_ = std::move(next);
    }

    std::vector<uint32_t> codes() const
    {
        std::vector<uint32_t> codes;
        for (const BrickLight& face : faces_)
            codes.push_back(face.code);
        return codes;
    }

private:
    BrickScene scene() const { return {bricks_.masks, bricks_.opacity, faces_}; }

    Float3 outgoingRadiance(size_t face, uint32_t rays) const
    {
        const auto [x, y, z, side] = places_[face];
        const BrickStart start =
            brickFaceStart(scene(), x, y, z, side, decodeFaceNormal(bricks_.normals[face]),
                           brickFaceSurface(x, y, z, side, decodeFaceDepth(bricks_.albedo[face])));
        const uint32_t seed = brickFaceSeed(x, y, z, side);
        Float3 irradiance;
        for (uint32_t i = 0; i < rays; ++i)
        {
            const Float3 direction = brickRayDirection(start.normal, i, rays, seed);
            irradiance += radianceAlong(brickRayOrigin(scene(), start, direction), direction) *
                          (1.0f / static_cast<float>(rays));
        }
        for (uint32_t i = 0; i < lighting_.light_count; ++i)
            irradiance += direct(start, lighting_.lights[i]);
        return brickOutgoingRadiance(emission(face), decodeAlbedo(bricks_.albedo[face]), irradiance);
    }

    /// Return the emission of a face, after exposure.
    Float3 emission(size_t face) const { return decodeRadiance(bricks_.emission[face]) * lighting_.exposure; }

    Float3 direct(const BrickStart& start, const Light& light) const
    {
        const BrickGrid& grid = bricks_.masks.grid;
        const Float3 lamp = (light.position - grid.origin) / grid.voxel_size;
        const BrickUnshadowedLight incident = brickUnshadowedLight(grid, start, light, lamp);
        if (incident.irradiance == Float3{} ||
            rays_.occluded(start.position, incident.direction, incident.distance_to_light))
            return {};
        return incident.irradiance *
               transmittance(start.position, incident.direction, incident.distance_to_light);
    }

    Float3 radianceAlong(Float3 position, Float3 direction) const
    {
        const std::optional<RayScene::Hit> hit = rays_.nearest(position, direction);
        const Float3 radiance = hit ? hitRadiance(*hit) : skyRadiance(sky_, direction);
        if (!rays_.hasHoles())
            return radiance;
        const float far = hit ? length(hit->position - position) : kBrickInfinity;
        return radiance * transmittance(position, direction, far) +
               translucentRadiance(position, direction, far);
    }

    /// Return the transmittance of surfaces with holes along a ray. Such surfaces fill no voxel completely.
    float transmittance(Float3 position, Float3 direction, float far) const
    {
        float through = 1;
        if (rays_.hasHoles())
            forEachTranslucentVoxel(position, direction, far,
                                    [&](const Brick&, const BrickRay&, float opacity)
                                    { through *= 1 - opacity; });
        return through;
    }

    Float3 translucentRadiance(Float3 position, Float3 direction, float far) const
    {
        Float3 radiance;
        float through = 1;
        forEachTranslucentVoxel(position, direction, far,
                                [&](const Brick& brick, const BrickRay& ray, float opacity)
                                {
                                    const uint32_t face = brickFace(brick, ray.bit, ray.face);
                                    if (face != kNoFace)
                                        radiance += decodeBrickLight(faces_[face]) * (through * opacity);
                                    through *= 1 - opacity;
                                });
        return radiance;
    }

    template <typename Visit>
    void forEachTranslucentVoxel(Float3 position, Float3 direction, float far, const Visit& visit) const
    {
        const BrickMasks& masks = bricks_.masks;
        for (BrickRay ray = brickMarch(masks, brickRayInVoxels(masks.grid, position, direction, far));
             ray.inside != 0; ray = brickMarch(masks, brickSkipVoxel(masks, ray)))
        {
            const Brick& brick = masks.bricks[ray.brick];
            const uint8_t opacity = bricks_.opacity[brickVoxel(brick, ray.bit)];
            if (opacity < 255)
                visit(brick, ray, static_cast<float>(opacity) / 255);
        }
    }

    /// Return the outgoing radiance at a hit: the mean over the faces of its voxel on the triangle's side,
    /// weighted by how much they face it. Uses the voxel just before or just behind the triangle. Returns 0
    /// where the grid has dropped both.
    Float3 hitRadiance(const RayScene::Hit& hit) const
    {
        for (const float beside : {-kSurfaceOffset, kSurfaceOffset})
        {
            const Float3 position = hit.position + hit.normal * beside;
            Float3 sum;
            float weights = 0;
            for (uint32_t side = 0; side < kVoxelFaces; ++side)
            {
                const float facing = dot(hit.normal, brickFaceAxis(side));
                const uint32_t face = facing > 0 ? faceAt(position, side) : kNoFace;
                if (face == kNoFace)
                    continue;
                sum += decodeBrickLight(faces_[face]) * (facing * facing);
                weights += facing * facing;
            }
            if (weights > 1e-4f)
                return sum / weights;
        }
        return {};
    }

    uint32_t faceAt(Float3 position, uint32_t side) const
    {
        const BrickMasks& masks = bricks_.masks;
        if (!(position.x >= 0 && position.y >= 0 && position.z >= 0 &&
              position.x < static_cast<float>(masks.grid.voxels_x) &&
              position.y < static_cast<float>(masks.grid.voxels_y) &&
              position.z < static_cast<float>(masks.grid.voxels_z)))
            return kNoFace;
        const auto x = static_cast<uint32_t>(position.x), y = static_cast<uint32_t>(position.y),
                   z = static_cast<uint32_t>(position.z);
        const uint32_t group =
            x / kGroupVoxels +
            brickGroupsAlongAxis(masks.grid.voxels_x) *
                (y / kGroupVoxels + brickGroupsAlongAxis(masks.grid.voxels_y) * (z / kGroupVoxels));
        const BrickGroup& record = masks.groups[group];
        const uint32_t bit = brickBit(x / kBrickVoxels, y / kBrickVoxels, z / kBrickVoxels);
        if (!maskHas(record.brick_mask_low, record.brick_mask_high, bit))
            return kNoFace;
        const Brick& brick = masks.bricks[record.first_brick +
                                          maskCountBelow(record.brick_mask_low, record.brick_mask_high, bit)];
        return brickFace(brick, brickBit(x, y, z), side);
    }

    const RayScene& rays_;
    BrickView bricks_;
    const Lighting& lighting_;
    Sky sky_;
    std::vector<FaceLocation> places_;
    std::vector<BrickLight> faces_;
};

} // namespace

Status bakeLight(const StaticScene& scene, const BakeSettings& settings, CookedGrid& grid)
{
    HEARTH_ASSERT(settings.rays > 0);
    HEARTH_ASSIGN_OR_RETURN(const RayScene rays,
                            RayScene::build(scene,
                                            findCutClusters(scene, static_cast<float>(grid.statistics.error)),
                                            grid.statistics.frame));
    const Lighting lighting = makeSceneLighting(scene);
    LightBaker baker(rays, grid.tables, lighting);
    for (uint32_t bounce = 0; bounce <= settings.bounces; ++bounce)
        baker.sweep(settings.rays);
    grid.tables.lighting = baker.codes();
    return success();
}

} // namespace hearth::bricks
