// Place that a pixel shows at a distance of one metre along the view. Needs `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// Return that place, relative to the eye: of all points with these clip coordinates, the one whose w is 1.
// The rows need not be orthogonal: the image may be off-centre.
vec3 pixelRay(vec2 pixel)
{
    vec2 ndc = pixel * 2.0 / vec2(view.width, view.height) - 1.0;
    vec3 x = view.clip_x.xyz, y = view.clip_y.xyz, w = view.clip_w.xyz;
    vec3 across = cross(x, y);
    return (cross(y, w) * ndc.x + cross(w, x) * ndc.y + across) / dot(across, w);
}
