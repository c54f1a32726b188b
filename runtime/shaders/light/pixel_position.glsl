// Place of the point that a pixel shows, by the depth of the scene: an input attachment. Needs `view`.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "runtime/shaders/scene/pixel_ray.glsl"

// bound for the stencil, so that nothing else may read it
layout(input_attachment_index = kInputDepth, set = kSetScene, binding = kAttachmentDepth)
    uniform subpassInput stored_depth;

float loadDepth() { return subpassLoad(stored_depth).x; }

// Point of the pixel at a depth, relative to the eye.
vec3 pixelPosition(vec2 pixel, float depth)
{
    PixelRay ray = pixelRay(pixel);
    vec3 parallel = ray.origin + ray.along * (view.clip_w.w - depth / view.depth_scale);
    vec3 position = ray.along * (view.z_near / depth);
    return mix(position, parallel, bvec3(isOrthographic(view))); // selects, as clipPosition
}
