// Loads the surface of a pixel that shading has stored. Include behind surface_lights.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/light/pixel_position.glsl"
#include "runtime/shaders/shade/surface_words.glsl"

#ifdef HEARTH_SAMPLED
layout(set = kSetScene, binding = kAttachmentSurfaces) uniform usampler2D stored_surfaces;

uvec4 loadWords() { return texelFetch(stored_surfaces, ivec2(gl_FragCoord.xy), 0); }
#else
layout(input_attachment_index = kInputSurfaces, set = kSetScene, binding = kAttachmentSurfaces)
    uniform usubpassInput stored_surfaces;

uvec4 loadWords() { return subpassLoad(stored_surfaces); }
#endif

// Returns false, and leaves `surface` unset, if lights do not reach the pixel this way.
bool loadSurface(out PlacedSurface surface)
{
    uvec4 words = loadWords();
    if (words == kNoSurface)
        return false;
    surface = placedSurface(unpackSurface(words), pixelPosition(gl_FragCoord.xy, loadDepth()));
    return true;
}
