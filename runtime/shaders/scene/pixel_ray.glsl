// Points that a pixel shows, by their distance along the view. Needs `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"

// The points origin + distance * along, relative to the eye.
struct PixelRay
{
    vec3 origin;
    vec3 along; // of any length: 1 along the view's axis
};

// The rows need not be orthogonal: the image may be off-centre.
PixelRay pixelRay(vec2 pixel)
{
    vec2 ndc = pixel * 2.0 / vec2(view.width, view.height) - 1.0;
    vec3 x = view.clip_x.xyz, y = view.clip_y.xyz, w = view.clip_w.xyz;
    vec3 across = cross(x, y);
    vec2 place = ndc - vec2(view.clip_x.w, view.clip_y.w);
    vec3 origin = (cross(y, w) * place.x + cross(w, x) * place.y) / dot(across, w);
    vec3 along = (cross(y, w) * ndc.x + cross(w, x) * ndc.y + across) / dot(across, w);
    // selects, as clipPosition
    bvec3 parallel = bvec3(isOrthographic(view));
    return PixelRay(mix(vec3(0.0), origin, parallel), mix(along, w, parallel));
}
