// Interpolates the gathered light (GI) at a pixel from the four tiles around it, weighted by plane and normal
// similarity (joint bilateral upsampling).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/brick_codes.h"
#include "formats/gpu_shared/gather.h"
#include "runtime/shaders/gi/gather_encoding.glsl"
#include "runtime/shaders/gi/gather_similarity.glsl"

layout(set = kSetAttachments, binding = kAttachmentGi) uniform usampler2D gathered;

struct GiSample
{
    vec3 diffuse; // irradiance / pi at the normal
    vec3 mirror;  // radiance from the mirror direction, blurred by the roughness of the surface
    float sky;    // cosine-weighted share of the sky that the bricks leave visible
    bool known;   // false: everything around is sky
};

// pixel     gl_FragCoord.xy
// position  relative to the eye
// normal    shading normal, unit
// roughness perceptual
GiSample sampleGi(vec2 pixel, vec3 position, vec3 normal, mediump float roughness)
{
    vec2 at = pixel / float(kGatherTilePixels) - 0.5;
    vec2 low = floor(at);
    ivec2 last = ivec2(gatherTiles(uint(view.width)), gatherTiles(uint(view.height))) - 1;
    // metres that a tile covers at that distance
    float reach = length(position) * float(kGatherTilePixels) / view.lod_scale;
    GiSample sum = GiSample(vec3(0.0), vec3(0.0), 0.0, false);
    float weights = 0.0;
    GatherLobeShares shares = gatherLobeShares(roughness);
    for (uint i = 0u; i < 4u; ++i)
    {
        vec2 corner = vec2(i & 1u, i >> 1);
        ivec2 tile = clamp(ivec2(low + corner), ivec2(0), last);
        uvec4 code = texelFetch(gathered, ivec2(tile.x * 2, tile.y), 0);
        if (code.w == kNoPlane)
            continue;
        vec2 bilinear = mix(1.0 - (at - low), at - low, corner);
        vec3 point_normal = octahedralDirection(unpackSnorm2x16(code.z));
        float alike = gatherSimilarity(point_normal, uintBitsToFloat(code.w), position, normal, reach);
        // where no tile is like the pixel the nearest ones count, rather than nothing
        float weight = (bilinear.x * bilinear.y + 1e-3) * (alike + 1e-3);

        vec4 mean = vec4(unpackHalf2x16(code.x), unpackHalf2x16(code.y));
        uvec4 lobes = texelFetch(gathered, ivec2(tile.x * 2 + 1, tile.y), 0);
        vec3 first, second;
        axesAcross(point_normal, first, second);
        // formats/gpu_shared/gather.h explains 8 / 3
        mediump float along_first = dot(first, normal);
        mediump float along_second = dot(second, normal);
        mediump vec3 bent = (decodeShares(lobes.x) * along_first + decodeShares(lobes.y) * along_second) * (8.0 / 3.0);
        mediump vec3 bend = max(1.0 + bent, vec3(0.0));
        vec3 diffuse = mean.rgb * bend;
        sum.diffuse += diffuse * weight;
        sum.mirror += (shares.sharp * decodeRadiance(lobes.z) + shares.wide * decodeRadiance(lobes.w) + shares.cosine * diffuse) * weight;
        sum.sky += mean.a * weight;
        weights += weight;
    }
    sum.known = weights > 0.0;
    float scale = sum.known ? 1.0 / weights : 0.0;
    sum.diffuse *= scale;
    sum.mirror *= scale;
    sum.sky *= scale;
    return sum;
}
