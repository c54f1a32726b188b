// Comparison of a pixel's material with that of the area which is drawn, where no depth test does it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/shading_push.glsl"

layout(constant_id = kConstantComparesMaterial) const bool kComparesMaterial = false;

// True if another draw shades the pixel.
bool isForeign(uint id)
{
    if (!kComparesMaterial)
        return false;
    uint material = id == kVisibilitySky ? 0u : cluster_draws[visible[id >> kTriangleBits].cluster].material;
    return push.material == kEverySurface ? material == 0u : material != push.material;
}
