// Radiance as images hold it, whose formats have few bits: rounded to the nearest, since some devices cut the
// rest off, which darkens each level of bloom by another half a percent.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/specialization.h"

layout(constant_id = kConstantStored) const uint kStored = kStoredDisplay;
const bool kStoresExposed = kStored == kStoredExposedPacked || kStored == kStoredExposedHalf;

vec3 storedRadiance(vec3 radiance)
{
    // a pixel without a number would spread over the image
    vec3 known = mix(max(radiance, 0.0), vec3(0.0), isnan(radiance));
    if (kStored == kStoredHalf || kStored == kStoredExposedHalf)
        return min(known, 65504.0);
    // 6 bits of fraction for red and green, 5 for blue, of the 23 of a float
    uvec3 bits = floatBitsToUint(min(known, vec3(65024.0, 65024.0, 64512.0)));
    return uintBitsToFloat((bits + (uvec3(1u) << uvec3(16u, 16u, 17u))) & ~((uvec3(2u) << uvec3(16u, 16u, 17u)) - 1u));
}
