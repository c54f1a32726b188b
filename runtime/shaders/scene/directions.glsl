// Small functions of directions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_DIRECTIONS_GLSL
#define HEARTH_DIRECTIONS_GLSL

// Return `v` normalized, or `fallback` if v is too short to have a direction.
vec3 normalizeOr(vec3 v, vec3 fallback)
{
    float len2 = dot(v, v);
    return len2 > 1e-30 ? v * inversesqrt(len2) : fallback;
}

// Cosine between normal and eye, clamped as the BRDF needs it.
float clampedCosine(vec3 normal, vec3 to_eye) { return clamp(abs(dot(normal, to_eye)), 1e-4, 1.0); }

// Point of the square [-1, 1]^2 to which a direction of any length is folded. Z. Cigolle et al., "A survey of
// efficient representations for independent unit vectors", 2014.
vec2 octahedralPoint(vec3 n)
{
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    return n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
}

// Unit direction of a point of that square.
vec3 octahedralDirection(vec2 p)
{
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
}

// Compute two unit vectors across a normal. T. Duff et al., "Building an orthonormal basis, revisited", 2017.
void axesAcross(vec3 n, out vec3 first, out vec3 second)
{
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    first = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    second = vec3(b, side + n.y * n.y * a, -n.y);
}

#endif
