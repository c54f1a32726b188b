// Samples directions of a GGX lobe, for gathered reflections. One source for C++ and GLSL. See
// runtime/gpu/README.md.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_GATHER_LOBE_H
#define HEARTH_SHARED_GATHER_LOBE_H

#include "formats/gpu_shared/brick_rays.h"

HEARTH_SHARED_BEGIN

/// Sample of a lobe: a unit direction to the light, and its weight in the lobe. The weight is 0 below the
/// surface, and no ray is traced.
struct GatherLobeRay
{
    Float3 direction;
    float weight;
};

HEARTH_FUNCTION Float3 gatherNormalize(Float3 v)
{
    return v * (1.0f / sqrt(dot(v, v)));
}

/// Return Lambda of Smith's masking function: hidden microfacets for each one visible from a direction.
/// cosine  to the normal
HEARTH_FUNCTION float smithLambda(float cosine, float alpha)
{
    float cosine2 = max(cosine * cosine, 1e-8f);
    return 0.5f * (sqrt(1.0f + alpha * alpha * max(1.0f - cosine2, 0.0f) / cosine2) - 1.0f);
}

/// Return direction `index` of `count` of a GGX lobe, by sampling visible microfacet normals. The weight is
/// the fraction of light that other microfacets do not shadow. The weighted mean is the lobe's, without the
/// Fresnel factor.
/// source  J. Dupuy, A. Benyoub, "Sampling visible GGX normals with spherical caps", 2023; weights: E. Heitz,
///         "Understanding the masking-shadowing function in microfacet-based BRDFs", 2014
///
/// to_eye     unit; on the back of the surface it is taken along the surface
/// normal     unit
/// roughness  perceptual, > 0
/// seed       as for brickRayDirection
HEARTH_FUNCTION GatherLobeRay gatherLobeRay(Float3 to_eye, Float3 normal, float roughness, uint index,
                                            uint count, uint seed)
{
    const float least_cosine = 0.02f;
    float alpha = roughness * roughness;
    // T. Duff et al., "Building an orthonormal basis, revisited", 2017
    float side = normal.z < 0.0f ? -1.0f : 1.0f;
    float p = -1.0f / (side + normal.z);
    float q = normal.x * normal.y * p;
    Float3 first = Float3(1.0f + side * normal.x * normal.x * p, side * q, -side * normal.x);
    Float3 second = Float3(q, side + normal.y * normal.y * p, -normal.y);
    Float3 eye = gatherNormalize(
        Float3(dot(first, to_eye), dot(second, to_eye), max(dot(normal, to_eye), least_cosine)));
    // uniform over the disc, and so over the spherical cap that the eye sees in stretched space
    Float3 disc = brickRayDirection(Float3(0.0f, 0.0f, 1.0f), index, count, seed);
    float u = disc.x * disc.x + disc.y * disc.y;
    Float3 seen = gatherNormalize(Float3(alpha * eye.x, alpha * eye.y, eye.z));
    float up = (1.0f - u) * (1.0f + seen.z) - seen.z;
    float across = sqrt(max(1.0f - up * up, 0.0f) / max(u, 1e-12f));
    Float3 facet = gatherNormalize(Float3(alpha * (disc.x * across + seen.x),
                                          alpha * (disc.y * across + seen.y), max(up + seen.z, 1e-6f)));
    Float3 light = facet * (2.0f * dot(facet, eye)) - eye;
    GatherLobeRay ray;
    ray.direction = gatherNormalize(first * light.x + second * light.y + normal * light.z);
    float hidden_eye = smithLambda(eye.z, alpha);
    float hidden_light = smithLambda(light.z, alpha);
    ray.weight = light.z > 0.0f ? (1.0f + hidden_eye) / (1.0f + hidden_eye + hidden_light) : 0.0f;
    return ray;
}

HEARTH_SHARED_END

#endif
