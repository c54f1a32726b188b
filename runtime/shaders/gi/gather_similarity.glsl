// Measures how well the light at the point of a tile stands for a surface (GI).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// Return 1 for a surface in the plane of a tile's point, next to 0 for another surface.
// point_normal  unit
// plane         distance of the point's plane from the eye
// position      of the surface, relative to the eye
// reach         metres that a tile covers at the surface
float gatherSimilarity(vec3 point_normal, float plane, vec3 position, vec3 normal, float reach)
{
    float off_plane = abs(dot(point_normal, position) - plane) / reach;
    float facing = max(dot(point_normal, normal), 0.0);
    float alike = facing * facing;
    alike *= alike;
    return alike / (1.0 + 16.0 * off_plane * off_plane);
}
