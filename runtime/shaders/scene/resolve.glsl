// Reconstructs the surface point of a pixel from the visibility buffer: barycentrics and their derivatives by
// homogeneous edge functions, without a division by w, so that triangles may cross the near plane. M. Olano,
// T. Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/record_values.h"
#include "runtime/shaders/scene/drawn_vertex.glsl"

struct Surface
{
    uint slot_number;
    VisibleCluster slot;
    Instance instance;
    ClusterDraw draw;
    DrawnPose pose;
    uint triangle;
    uint indices[3];   // indices of the vertices in their cluster
    uint vertices[3];  // addresses
    vec3 corners[3];   // relative to the eye
    vec3 position;     // relative to the eye
    vec3 weights;
    vec3 weights_dx;   // per pixel
    vec3 weights_dy;
    bool front;
    bool mirrored;
    float distance_w;  // along the view direction
};

bool isMirrored(Instance instance) { return (instance.flags & kInstanceMirrored) != 0u; }

Surface resolveSurface(uint id, vec2 pixel)
{
    Surface s;
    s.slot_number = id >> kTriangleBits;
    s.slot = visible[s.slot_number];
    s.triangle = id & ((1u << kTriangleBits) - 1u);
    s.instance = instances[s.slot.instance];
    s.draw = cluster_draws[s.slot.cluster];
    s.pose = drawnPose(s.slot.instance, s.slot_number);

    vec2 ndc = pixel * 2.0 / vec2(view.width, view.height) - 1.0;
    vec2 p[3]; // clip positions with the pixel moved to the origin: small numbers, little cancellation
    float w[3];
    for (uint i = 0u; i < 3u; ++i)
    {
        s.indices[i] = cornerVertex(s.draw, s.triangle, i);
        s.vertices[i] = vertexAddress(s.draw, s.indices[i]);
        s.corners[i] = drawnPosition(s.instance, s.draw, s.pose, s.indices[i], view.eye);
        vec4 clip = clipPosition(view, s.corners[i]);
        p[i] = clip.xy - ndc * clip.w;
        w[i] = clip.w;
    }
    vec3 edges = vec3(p[1].x * p[2].y - p[2].x * p[1].y, p[2].x * p[0].y - p[0].x * p[2].y,
                      p[0].x * p[1].y - p[1].x * p[0].y);
    // derivatives of the edge functions by the ndc of the pixel
    vec3 edges_dx = vec3(p[1].y * w[2] - p[2].y * w[1], p[2].y * w[0] - p[0].y * w[2], p[0].y * w[1] - p[1].y * w[0]);
    vec3 edges_dy = vec3(p[2].x * w[1] - p[1].x * w[2], p[0].x * w[2] - p[2].x * w[0], p[1].x * w[0] - p[0].x * w[1]);
    float sum = edges.x + edges.y + edges.z;
    float inverse = sum != 0.0 ? 1.0 / sum : 0.0;
    vec3 weights = sum != 0.0 ? edges * inverse : vec3(1.0 / 3.0);
    s.weights_dx = (edges_dx - weights * (edges_dx.x + edges_dx.y + edges_dx.z)) * inverse * (2.0 / view.width);
    s.weights_dy = (edges_dy - weights * (edges_dy.x + edges_dy.y + edges_dy.z)) * inverse * (2.0 / view.height);
    // vertices are snapped to 1/256 pixel: the sample may lie just outside of the exact triangle, or far
    // outside of a sliver
    weights = max(weights, vec3(0.0));
    s.weights = weights / (weights.x + weights.y + weights.z);
    s.position = s.corners[0] * s.weights.x + s.corners[1] * s.weights.y + s.corners[2] * s.weights.z;
    float distance_w = w[0] * s.weights.x + w[1] * s.weights.y + w[2] * s.weights.z;
    s.distance_w = mix(distance_w, dot(view.clip_w.xyz, s.position), isOrthographic(view)); // as clipPosition
    s.mirrored = isMirrored(s.instance);
    // y points down, so a counter-clockwise triangle has a negative area
    s.front = (sum < 0.0) != s.mirrored;
    return s;
}

// Bound a UV gradient. A triangle seen edge-on has unbounded or undefined gradients; past 64 textures per
// pixel every mip is the last one.
vec2 boundedGradient(vec2 gradient)
{
    // this form of the test replaces NaN by the bound as well
    return vec2(abs(gradient.x) < 64.0 ? gradient.x : 64.0, abs(gradient.y) < 64.0 ? gradient.y : 64.0);
}

SurfaceUv surfaceUv(Surface s, uint set)
{
    vec2 a = vertexUv(s.draw, s.vertices[0], set);
    vec2 b = vertexUv(s.draw, s.vertices[1], set);
    vec2 c = vertexUv(s.draw, s.vertices[2], set);
    SurfaceUv r;
    r.uv = a * s.weights.x + b * s.weights.y + c * s.weights.z;
    // differences, so that large coordinates cancel exactly
    r.dx = boundedGradient((b - a) * s.weights_dx.y + (c - a) * s.weights_dx.z);
    r.dy = boundedGradient((b - a) * s.weights_dy.y + (c - a) * s.weights_dy.z);
    return r;
}

// Reads each UV set once, also if several textures use it.
SurfaceUvs surfaceUvs(Surface s)
{
    SurfaceUvs uvs;
    for (uint set = 0u; set < kUvSetCount; ++set)
    {
        uvs.sets[set] = SurfaceUv(vec2(0.0), vec2(0.0), vec2(0.0));
        if (usesUvSet(set))
            uvs.sets[set] = surfaceUv(s, set);
    }
    return uvs;
}

mediump vec3 surfaceColor(Surface s)
{
    return vertexColor(s.draw, s.vertices[0]).rgb * s.weights.x + vertexColor(s.draw, s.vertices[1]).rgb * s.weights.y +
           vertexColor(s.draw, s.vertices[2]).rgb * s.weights.z;
}

vec3 worldVector(Instance instance, vec3 v)
{
    return vec3(dot(instance.world_from_object_x.xyz, v), dot(instance.world_from_object_y.xyz, v),
                dot(instance.world_from_object_z.xyz, v));
}

// Normals transform by the cofactor matrix: the inverse transpose up to a positive factor once the mirror is
// taken out.
vec3 worldNormal(Instance instance, vec3 n)
{
    vec3 x = instance.world_from_object_x.xyz;
    vec3 y = instance.world_from_object_y.xyz;
    vec3 z = instance.world_from_object_z.xyz;
    vec3 r = vec3(dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n));
    return isMirrored(instance) ? -r : r;
}

bool isDeformed(Surface s) { return kDeformed != kDeformedNone && s.pose.row != 0u; }

vec3 geometricNormal(Surface s)
{
    vec3 n = cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]);
    return normalizeOr(s.mirrored ? -n : n, vec3(0.0, 1.0, 0.0));
}

// Interpolated vertex normal in world axes, on the front side.
vec3 smoothNormal(Surface s)
{
    vec3 flat_normal = geometricNormal(s);
    if ((s.draw.vertex_layout & kVertexNormal) == 0u)
        return flat_normal;
    vec3 n = vec3(0.0);
    if (isDeformed(s))
    {
        for (uint i = 0u; i < 3u; ++i)
            n += drawnNormal(s.draw, s.pose, s.indices[i]) * s.weights[i];
        return normalizeOr(n, flat_normal);
    }
    for (uint i = 0u; i < 3u; ++i)
        n += vertexNormal(s.draw, s.vertices[i]) * s.weights[i];
    return normalizeOr(worldNormal(s.instance, n), flat_normal);
}

// Compute tangent and bitangent (unit, world) from the vertex tangents, or else from the gradients of the UVs
// that the normal map uses.
void tangentFrame(Surface s, vec3 normal, uint uv_set, out vec3 tangent, out vec3 bitangent)
{
    vec3 t = vec3(0.0);
    float side = s.mirrored ? -1.0 : 1.0;
    if ((s.draw.vertex_layout & kVertexTangent) != 0u)
    {
        for (uint i = 0u; i < 3u; ++i)
        {
            vec4 at_vertex = vertexTangent(s.draw, s.vertices[i], vertexNormal(s.draw, s.vertices[i]));
            t += (isDeformed(s) ? drawnTangent(s.draw, s.pose, s.indices[i]) : at_vertex.xyz) * s.weights[i];
            if (i == 0u)
                side *= at_vertex.w;
        }
        if (!isDeformed(s))
            t = worldVector(s.instance, t);
    }
    else
    {
        vec2 a = vertexUv(s.draw, s.vertices[0], uv_set);
        vec2 u1 = vertexUv(s.draw, s.vertices[1], uv_set) - a;
        vec2 u2 = vertexUv(s.draw, s.vertices[2], uv_set) - a;
        float area = u1.x * u2.y - u2.x * u1.y;
        t = ((s.corners[1] - s.corners[0]) * u2.y - (s.corners[2] - s.corners[0]) * u1.y) * sign(area);
        // v points down in the texture, the bitangent points up: a chart that is not mirrored has a negative
        // area
        side *= area > 0.0 ? -1.0 : 1.0;
    }
    completeFrame(normal, t, side, tangent, bitangent);
}

// Transform the visibility moments of a vertex to world axes in the pose of its instance. The part along the
// normal follows the posed normal, the part across it follows the surface. The length stays.
vec3 posedMoment(Surface s, uint corner, vec3 normal, vec3 m1)
{
    float along = dot(normal, m1);
    vec3 across = m1 - normal * along;
    vec3 posed_normal = drawnNormal(s.draw, s.pose, s.indices[corner]);
    vec3 posed_tangential = transformVector(blendedJoints(s.draw, loadPose(s.pose.row), s.vertices[corner]), across);
    posed_tangential -= posed_normal * dot(posed_normal, posed_tangential);
    return posed_normal * along + normalizeOr(posed_tangential, vec3(0.0)) * length(across);
}

// Interpolate the sky visibility of the vertices. Visibility moments are linear in the light, so
// interpolation is valid.
VisibilityMoments surfaceSky(Surface s, vec3 normal)
{
    VisibilityMoments sky = openSky(normal);
    if (!kSkyVisibility || (s.draw.vertex_layout & kVertexVisibility) == 0u)
        return sky;
    sky = VisibilityMoments(0.0, vec3(0.0));
    for (uint i = 0u; i < 3u; ++i)
    {
        vec3 at_vertex = vertexNormal(s.draw, s.vertices[i]);
        VisibilityMoments moments = decodeVisibility(vertexVisibility(s.draw, s.vertices[i]), at_vertex);
        sky.m0 += moments.m0 * s.weights[i];
        sky.m1 += (isDeformed(s) ? posedMoment(s, i, at_vertex, moments.m1) : moments.m1) * s.weights[i];
    }
    if (!isDeformed(s))
        // transforms like a normal, so that what is open stays open; the length is a share of light, not a
        // distance
        sky.m1 = normalizeOr(worldNormal(s.instance, sky.m1), vec3(0.0)) * length(sky.m1);
    return sky;
}

// Bound in metres of the distance of the drawn triangle to the source.
float surfaceError(Surface s) { return s.draw.position_error * s.instance.scale_max; }

SurfacePoint surfacePoint(Surface s)
{
    SurfacePoint point;
    point.position = s.position;
    point.normal = smoothNormal(s);
    vec3 flat_normal = geometricNormal(s);
    point.flat_normal = s.front ? flat_normal : -flat_normal;
    point.error = surfaceError(s);
    point.tangent = point.bitangent = vec3(0.0);
    uint normal_map = hasTexture(kTextureNormal) ? kTextureNormal : kTextureClearcoatNormal;
#ifdef HEARTH_MATERIAL_FUNCTIONS
    bool has_frame = true;
    point.position_dx = s.corners[0] * s.weights_dx.x + s.corners[1] * s.weights_dx.y + s.corners[2] * s.weights_dx.z;
    point.position_dy = s.corners[0] * s.weights_dy.x + s.corners[1] * s.weights_dy.y + s.corners[2] * s.weights_dy.z;
#else
    bool has_frame = hasTexture(normal_map);
#endif
    if (has_frame)
        tangentFrame(s, point.normal, textureUvSet(normal_map), point.tangent, point.bitangent);
    point.color = surfaceColor(s);
    point.front = s.front;
    point.sky = surfaceSky(s, point.normal);
    point.instance = s.slot.instance;
    point.slot = s.slot_number;
    // the back of a sheet sees the mirror image of the sky that its front sees
    if (!s.front)
        point.sky.m1 -= point.normal * (2.0 * dot(point.normal, point.sky.m1));
    return point;
}
