// Loads the surface of a pixel that normals.glsl has stored. Include behind surface_lights.glsl. Shaders that
// include it define its layout: normal_texel.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/light/pixel_position.glsl"
#include "runtime/shaders/prepass/normal_texel.glsl"

#ifdef HEARTH_SAMPLED
layout(set = kSetScene, binding = kAttachmentSurfaces) uniform NormalTexture stored_normals;

NormalTexel loadTexel() { return NormalTexel(texelFetch(stored_normals, ivec2(gl_FragCoord.xy), 0)); }
#else
layout(input_attachment_index = kInputSurfaces, set = kSetScene, binding = kAttachmentSurfaces)
    uniform NormalInput stored_normals;

NormalTexel loadTexel() { return NormalTexel(subpassLoad(stored_normals)); }
#endif

// Returns false, and leaves `surface` unset, if lights do not reach the pixel this way.
bool loadSurface(out PlacedSurface surface)
{
    NormalTexel texel = loadTexel();
    if (!isSurface(texel))
        return false;
#ifdef HEARTH_ENCODED_DEPTH
    float depth = mix(view.z_near / texel.x, (view.clip_w.w - texel.x) * view.depth_scale, isOrthographic(view));
#else
    float depth = loadDepth();
#endif
    StoredNormal stored = unpackNormal(texel);
    LitSurface lit = LitSurface(stored.normal, stored.flat_normal, vec3(0.0), 0.0, stored.roughness, stored.error,
                                stored.receives);
    surface = placedSurface(lit, pixelPosition(gl_FragCoord.xy, depth));
#ifdef HEARTH_JOINED_SUMS
    // the most that the level of detail allows
    float distance = mix(length(surface.position), 1.0, isOrthographic(view));
    surface.error = max(view.threshold, 0.0) * distance / (view.lod_scale * lodFactor(view, distance));
#endif
    return true;
}
