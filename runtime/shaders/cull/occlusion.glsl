// Occlusion test against the depth pyramid (hierarchical Z), and the views it was rendered from: set 1 of the
// culling pipelines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"

layout(set = kSetOcclusion, binding = kOcclusionViews, std140) uniform Occlusion
{
    OcclusionView last_view;    // view of the pyramid that the early phase reads, rendered by the last frame
    OcclusionView current_view; // view of the pyramid that the late phase reads, rendered by the early phase
};
layout(set = kSetOcclusion, binding = kOcclusionPyramid, std430) readonly buffer Pyramid { float pyramid[]; };

// True if everything in the box lies behind the depth in the pyramid.
bool isHidden(OcclusionView seen_from, Instance instance, vec3 box_min, vec3 box_max)
{
    PyramidBox box = pyramidBox(seen_from, instance, box_min, box_max);
    if (box.known == 0u)
        return false;
    for (uint y = box.y0; y <= box.y1; ++y)
        for (uint x = box.x0; x <= box.x1; ++x)
            if (box.depth >= pyramid[box.offset + y * box.stride + x])
                return false;
    return true;
}
