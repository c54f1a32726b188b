// Estimates how much distant light the surroundings of surface points give back, by random walks from what
// occludes them to the sky. See cook/visibility/README.md, "Light of occluders".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/occluders.h"
#include "cook/visibility/rays/sample_points.h"
#include "formats/records/surroundings.h"

#include <limits>
#include <optional>
#include <span>

namespace hearth::visibility
{

struct TransferSettings
{
    uint32_t rays_per_point = 16; ///< best a power of two
    uint64_t seed = 0;
    float distance = std::numeric_limits<float>::infinity(); ///< metres: farther surfaces do not occlude
};

/// Surface point whose surroundings count.
struct TransferPoint
{
    SamplePoint point; ///< in the space of the occluders
    float weight = 1;  ///< area that it stands for
    Affine3 world_from_occluders;
};

/// Estimate the radiance transfer of points together. Rays by the cosine about the normals find occluders;
/// from each of these, paths scatter by the cosine, dimmed by the colours of the surfaces, until they leave
/// the scene. Radiance is fitted as a linear function of the direction, by least squares. Rays that first
/// meet the back of a surface that has only a front are inside of a solid, and do not count. The same for any
/// number of threads.
///
/// occluders  finished, with colours
/// returns    nothing if nothing occludes the points
std::optional<formats::RadianceTransferRecord> estimateTransfer(const Occluders& occluders,
                                                                std::span<const TransferPoint> points,
                                                                const TransferSettings& settings);

} // namespace hearth::visibility
