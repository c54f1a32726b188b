// Encoding of the gathered light (GI) of a tile for shading: two texels of 128 bits. Needs
// formats/gpu_shared/gather.h and formats/gpu_shared/brick_codes.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/directions.glsl"

struct GatherTexels
{
    uvec4 mean;    // mean radiance and sky share as halves, normal, distance of the plane of the point
    // m1 / m0 along the two axes of axesAcross; the narrow and the wide specular lobe as R11G11B10F
    uvec4 lobes;
};

// Distance of the plane from the eye; infinite where nothing is known because the tile shows only sky.
const uint kNoPlane = 0x7F800000u;

// Encode m1 / m0 for each colour in 10 bits. The length of m1 is at most m0.
uint encodeShares(vec3 m1, vec3 m0)
{
    ivec3 code = ivec3(round(clamp(m1 / max(m0, vec3(1e-30)), vec3(-1.0), vec3(1.0)) * 511.0)) & 1023;
    return uint(code.r | code.g << 10 | code.b << 20);
}

mediump vec3 decodeShares(uint code)
{
    mediump vec3 shares = vec3(ivec3(code << 22, code << 12, code << 2) >> 22);
    return shares / 511.0;
}

GatherTexels encodeGatherTexels(GatherPoint point)
{
    const float most = 65000.0; // halves have infinities
    uint normal_code = packSnorm2x16(octahedralPoint(point.normal));
    vec3 normal = octahedralDirection(unpackSnorm2x16(normal_code));
    vec3 first, second;
    axesAcross(normal, first, second);
    vec4 mean = min(vec4(point.mean, point.sky), vec4(most));
    vec3 along_first = vec3(dot(first, point.red.xyz), dot(first, point.green.xyz), dot(first, point.blue.xyz));
    vec3 along_second = vec3(dot(second, point.red.xyz), dot(second, point.green.xyz), dot(second, point.blue.xyz));
    GatherTexels texels;
    texels.mean = uvec4(packHalf2x16(mean.xy), packHalf2x16(mean.zw), normal_code,
                        point.has_surface > 0.0 ? floatBitsToUint(dot(normal, point.position)) : kNoPlane);
    texels.lobes = uvec4(encodeShares(along_first, mean.rgb), encodeShares(along_second, mean.rgb),
                         encodeRadiance(vec3(point.red.w, point.green.w, point.blue.w)), encodeRadiance(point.wide));
    return texels;
}
