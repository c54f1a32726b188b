// Computes the emission of faces from the light that leaves their voxels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/grid/brick_tables.h"
#include "cook/bricks/grid/face_locations.h"
#include "cook/bricks/light/emission_paths.h"

namespace hearth::bricks
{

/// Split the light of a voxel among its faces, such that faces that shine evenly in all directions send it in
/// the directions that it has: least squares of the moments, without negative parts.
/// returns  parts, of sum 1; 0 for sides that are no faces
std::array<double, kFaces> splitAmongFaces(const LeavingLight& light, const shared::Brick& brick);

/// Sets the emission of faces. All arguments must outlive the object.
class EmissionFit
{
public:
    EmissionFit(const RayScene& rays, const LeavingLights& lights, BrickTables& tables);

    /// Set the emission of the faces of a voxel, such that the light reaches the air that leaves the voxel.
    void setEmission(const LeavingLight& light) const;

private:
    /// Voxel of the source that a ray meets within the source's reach.
    struct MetSource
    {
        float opacity = 0; ///< 0: none
        float distance = 0;
    };

    MetSource findSource(Float3 position, Float3 direction) const;
    float computeStepOpacity(Float3 position, Float3 direction, const MetSource& met) const;
    float computeOpenness(uint32_t face) const;
    float computeSelfLight(uint32_t face) const;
    float opacityAt(const shared::Brick& brick, uint32_t bit) const;

    const RayScene& rays_;
    const LeavingLights& lights_;
    BrickTables& tables_;
    shared::BrickMasks masks_;
    std::vector<FaceLocation> places_;
    uint32_t openness_rays_; ///< of each face
};

} // namespace hearth::bricks
