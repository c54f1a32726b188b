// Follows light from emissive triangles through the real geometry to where it leaves the solid voxels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/light/ray_scene.h"
#include "cook/bricks/voxels/solid_grid.h"
#include "formats/gpu_shared/brick_march.h"

#include <unordered_map>

namespace hearth::bricks
{

/// Voxels along a path within which it may leave and enter the steps of its own surface.
inline constexpr float kSourceReach = 2;

/// Solid voxel: its brick and its bit there.
struct VoxelPlace
{
    uint32_t brick;
    uint32_t bit;
};

/// Light that leaves one voxel. Flux is in units of radiance times a voxel's side area times pi.
struct LeavingLight
{
    VoxelPlace voxel;
    Double3 flux;
    double weight = 0;                   ///< sum of the colours of the flux
    std::array<double, kFaces> moment{}; ///< sum of weights times cosines, where positive, to the sides' axes
};

/// Sums of light by voxel.
class LeavingLights
{
public:
    void add(const VoxelPlace& voxel, Float3 flux, Float3 direction);
    void add(const LeavingLight& light);

    const std::vector<LeavingLight>& lights() const { return lights_; } ///< in the order of their first light
    bool has(const VoxelPlace& voxel) const { return numbers_.contains(key(voxel)); }

private:
    static uint64_t key(const VoxelPlace& voxel) { return uint64_t{voxel.brick} << 6 | voxel.bit; }
    LeavingLight& at(const VoxelPlace& voxel);

    std::vector<LeavingLight> lights_;
    std::unordered_map<uint64_t, size_t> numbers_;
};

/// Sends out the light of clusters. Use from many threads.
class EmissionPaths
{
public:
    /// density  paths of an emissive surface, for each side area of a voxel
    EmissionPaths(const RayScene& rays, const shared::BrickMasks& masks, double density)
        : rays_(rays), masks_(masks), density_(density)
    {
    }

    /// Send out the light of a cluster's triangles, voxel by voxel: then a voxel's share of a large surface
    /// has no noise. A path ends where it leaves the voxels of its source: a voxel gets the light that a
    /// viewer at the path's end sees there. Before that, surfaces that the path meets reflect it.
    /// returns  the flux that is sent
    Double3 sendFrom(const formats::ClusterGeometry& geometry, const SurfaceMaterial& material,
                     const Affine3d& voxels_from_object, bool mirrored, uint32_t seed,
                     LeavingLights& lights) const;

private:
    struct Emitter;
    struct PathPoint;
    struct Exit;

    Double3 sendFrom(const Emitter& emitter, const Cell& cell, const Polygon& piece, uint32_t& seed,
                     LeavingLights& lights) const;
    void followPath(PathPoint from, Float3 direction, uint32_t seed, LeavingLights& lights) const;
    Exit findExit(Float3 position, Float3 direction, float far) const;

    const RayScene& rays_;
    shared::BrickMasks masks_;
    double density_;
};

} // namespace hearth::bricks
