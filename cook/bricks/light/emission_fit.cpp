// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/emission_fit.h"

#include "formats/gpu_shared/brick_lighting.h"

#include <algorithm>
#include <numbers>

namespace hearth::bricks
{

using namespace shared;

namespace
{

/// Rays that measure how much of a face's light the source's own voxels take. Fewer for large sources, whose
/// faces are seen many at a time: the voxels of all sources have kMaxVoxelRays together.
constexpr size_t kMaxOpennessRays = 64, kMinOpennessRays = 8, kMaxVoxelRays = size_t{1} << 18;

/// Voxels behind the side of a voxel within which its surface lies.
constexpr float kSurfaceDepth = 2;

/// Least part of a face's light that reaches the air: bounds its radiance.
constexpr float kMinOpenness = 0.1f;

} // namespace

std::array<double, kFaces> splitAmongFaces(const LeavingLight& light, const Brick& brick)
{
    // mean cosines of such a face's light to its own axis and to the axes beside it
    constexpr double kAhead = 2.0 / 3, kBeside = 2 / (3 * std::numbers::pi);
    constexpr int kSweeps = 64;
    constexpr double kSquare = kAhead * kAhead + 4 * kBeside * kBeside;
    const auto cosine = [](uint32_t side, uint32_t face) {
        return side == face ? kAhead : side / 2 == face / 2 ? 0 : kBeside;
    };
    std::array<double, kFaces> parts{}, rest = light.moment;
    for (double& moment : rest)
        moment /= light.weight;
    double sum = 0;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
    {
        sum = 0;
        for (uint32_t face = 0; face < kFaces; ++face)
        {
            if (brickFace(brick, light.voxel.bit, face) == kNoFace)
                continue;
            double change = 0;
            for (uint32_t side = 0; side < kFaces; ++side)
                change += cosine(side, face) * rest[side] / kSquare;
            change = std::max(change, -parts[face]);
            parts[face] += change;
            sum += parts[face];
            for (uint32_t side = 0; side < kFaces; ++side)
                rest[side] -= cosine(side, face) * change;
        }
    }
    for (double& part : parts)
        part /= sum;
    return parts;
}

EmissionFit::EmissionFit(const RayScene& rays, const LeavingLights& lights, BrickTables& tables)
    : rays_(rays),
      lights_(lights),
      tables_(tables),
      masks_(tables.masks()),
      places_(faceLocations(masks_)),
      openness_rays_(static_cast<uint32_t>(std::clamp(
          kMaxVoxelRays / std::max<size_t>(lights.lights().size(), 1), kMinOpennessRays, kMaxOpennessRays)))
{
}

void EmissionFit::setEmission(const LeavingLight& light) const
{
    const Brick& brick = tables_.bricks[light.voxel.brick];
    const std::array<double, kFaces> parts = splitAmongFaces(light, brick);
    const float opacity = opacityAt(brick, light.voxel.bit);
    for (uint32_t side = 0; side < kFaces; ++side)
    {
        const uint32_t face = brickFace(brick, light.voxel.bit, side);
        if (face == kNoFace || parts[side] <= 0)
            continue;
        const float open = std::max(computeOpenness(face), kMinOpenness);
        // the face adds what it reflects of the light that it takes from itself
        const Float3 own = decodeAlbedo(tables_.albedo[face]) * computeSelfLight(face);
        tables_.emission[face] =
            encodeRadiance(narrow(light.flux * (parts[side] / (open * opacity))) * (Float3{1, 1, 1} - own));
    }
}

EmissionFit::MetSource EmissionFit::findSource(Float3 position, Float3 direction) const
{
    const BrickRay met = brickMarch(masks_, brickRayInVoxels(masks_.grid, position, direction, kSourceReach));
    return met.inside != 0 && lights_.has({met.brick, met.bit})
               ? MetSource{opacityAt(tables_.bricks[met.brick], met.bit), met.t}
               : MetSource{};
}

/// Return the part of a ray that ends in the source's steps: in a voxel of it, where no real surface is.
float EmissionFit::computeStepOpacity(Float3 position, Float3 direction, const MetSource& met) const
{
    return met.opacity > 0 && !rays_.occluded(position, direction, met.distance + kSurfaceDepth) ? met.opacity
                                                                                                 : 0;
}

float EmissionFit::opacityAt(const Brick& brick, uint32_t bit) const
{
    return static_cast<float>(tables_.opacity[brickVoxel(brick, bit)]) / 255.0f;
}

/// Return the part of a face's light that the source's own steps do not take, nor the source itself behind
/// the face.
float EmissionFit::computeOpenness(uint32_t face) const
{
    const auto [x, y, z, side] = places_[face];
    const Float3 axis = brickFaceAxis(side), middle = brickFaceMiddle(x, y, z, side);
    const Float3 normal = brickFaceNormal(decodeFaceNormal(tables_.normals[face]), side);
    const uint32_t seed = brickFaceSeed(x, y, z, side);
    float taken = 0;
    for (uint32_t i = 0; i < openness_rays_; ++i)
    {
        Float3 position = middle;
        position[(faceAxis(side) + 1) % 3] += brickRandomUnit(brickHash(seed + 2 * i)) - 0.5f;
        position[(faceAxis(side) + 2) % 3] += brickRandomUnit(brickHash(seed + 2 * i + 1)) - 0.5f;
        const Float3 direction = brickRayDirection(axis, i, openness_rays_, seed);
        const MetSource met = findSource(position, direction);
        taken += dot(direction, normal) <= 0 ? met.opacity : computeStepOpacity(position, direction, met);
    }
    return 1 - taken / static_cast<float>(openness_rays_);
}

/// Return the part of a face's own rays that end in the source's steps.
float EmissionFit::computeSelfLight(uint32_t face) const
{
    const BrickScene scene{masks_, {}, {}};
    const auto [x, y, z, side] = places_[face];
    const BrickStart start =
        brickFaceStart(scene, x, y, z, side, decodeFaceNormal(tables_.normals[face]),
                       brickFaceSurface(x, y, z, side, decodeFaceDepth(tables_.albedo[face])));
    const uint32_t seed = brickFaceSeed(x, y, z, side);
    float own = 0;
    for (uint32_t i = 0; i < openness_rays_; ++i)
    {
        const Float3 direction = brickRayDirection(start.normal, i, openness_rays_, seed);
        const Float3 origin = brickRayOrigin(scene, start, direction);
        own += computeStepOpacity(origin, direction, findSource(origin, direction));
    }
    return own / static_cast<float>(openness_rays_);
}

} // namespace hearth::bricks
