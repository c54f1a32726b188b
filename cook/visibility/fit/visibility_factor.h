// Fits how the surroundings of an instance change the visibility of its mesh. See
// formats/gpu_shared/instance_visibility.h, and cook/visibility/README.md, "Visibility of instances".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/mesh/moments.h"
#include "formats/gpu_shared/instance_visibility.h"

#include <array>
#include <span>

namespace hearth::visibility
{

/// Visibility at a point of an instance, in the world.
struct FactorSample
{
    Float3 normal;
    shared::VisibilityMoments mesh; ///< mean over the instances of the mesh
    std::array<Moments, 2> seen;    ///< of the instance, by two independent sets of rays
};

struct VisibilityFactor
{
    Float4 terms{0, 0, 0, 1};
    /// Mean square difference between ambient occlusion and what the instance sees, without the noise of
    /// rays: of the mesh's mean, and with the factor. May be below 0, where noise is all there is.
    double error_of_mean = 0, error_with_factor = 0;
};

/// Return ambient occlusion of moments, as far as they are possible.
double computeOcclusion(const shared::VisibilityMoments& moments, Float3 normal);

/// Fit the factor by least squares of all moments. Few or noisy samples keep it near 1.
VisibilityFactor fitFactor(std::span<const FactorSample> samples);

} // namespace hearth::visibility
