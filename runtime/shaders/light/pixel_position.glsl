// Place of the point that a pixel shows, by the depth of the scene: an input attachment. Needs `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

// bound for the stencil, so that nothing else may read it
layout(input_attachment_index = kInputDepth, set = kSetScene, binding = kAttachmentDepth)
    uniform subpassInput stored_depth;

float loadDepth() { return subpassLoad(stored_depth).x; }

// Point of the pixel at a depth, relative to the eye: of all with these clip coordinates, the one whose
// distance along the view is that of the depth.
vec3 pixelPosition(vec2 pixel, float depth)
{
    vec2 ndc = pixel * 2.0 / vec2(view.width, view.height) - 1.0;
    vec3 x = view.clip_x.xyz, y = view.clip_y.xyz, w = view.clip_w.xyz;
    vec3 across = cross(x, y);
    vec3 ray = cross(y, w) * ndc.x + cross(w, x) * ndc.y + across;
    return ray * (view.z_near / (depth * dot(across, w)));
}
