// The sky of the frame, and the rows of its image in the buffer of lights. Needs `lighting` and
// `light_words`, which the including file declares before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/sky.h"

Sky sceneSky()
{
    return Sky(lighting.sky_zenith, lighting.sky_horizon, lighting.sky_ground, lighting.sky_image_row);
}

uint skyImageTexel(Sky sky, uint index) { return light_words[4u * sky.image + index]; }

float skyImageFactor(Sky sky) { return uintBitsToFloat(light_words[4u * sky.image + kSkyImageTexels + 3u]); }

// Number of the cube map's sharp mips.
uint skyImageSharpMips(Sky sky) { return light_words[4u * sky.image + kSkyImageTexels + 7u]; }

vec3 skyImageHarmonic(Sky sky, uint index)
{
    uint word = 4u * (sky.image + index) + kSkyImageTexels;
    return uintBitsToFloat(uvec3(light_words[word], light_words[word + 1u], light_words[word + 2u]));
}
