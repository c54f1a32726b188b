// Triangle of a shadow caster in a map of a light, of clusters and of proxies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

struct CasterTriangle
{
    vec3 points[3]; // relative to the light's origin, world axes: the drawn corner, then the others in order
    vec3 normal;    // unit
    vec3 middle;
    float nearest; // as for shadowFacing
};

CasterTriangle casterTriangle(ShadowLight light, vec3 points[3])
{
    CasterTriangle triangle;
    triangle.points = points;
    vec3 across = cross(points[1] - points[0], points[2] - points[0]);
    float area2 = dot(across, across);
    // a triangle without area is not drawn, so any normal will do
    triangle.normal = area2 > 0.0 ? across * inversesqrt(area2) : light.direction;
    triangle.middle = (points[0] + points[1] + points[2]) / 3.0;
    // no part of a triangle is nearer than its nearest corner minus its longest edge
    float nearest = min(length(points[0]), min(length(points[1]), length(points[2])));
    float longest = max(length(points[1] - points[0]),
                        max(length(points[2] - points[1]), length(points[0] - points[2])));
    triangle.nearest = max(nearest - longest, 0.0);
    return triangle;
}

// Clip position of the corner, moved away from the light by the error and by the slope-scaled offset of the
// triangle's own plane. Vertex normals would round off silhouettes in the map. offset_share: one value for
// the triangle, so that it stays flat.
vec4 casterClip(ShadowLight light, ShadowMap map, CasterTriangle triangle, float error, float offset_share)
{
    return shadowCasterClip(light, map, triangle.points[0], triangle.normal, triangle.nearest, error, offset_share);
}
