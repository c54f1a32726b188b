// The depth pyramid and the views that it is looked at from: set 1 of the culling pipelines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

layout(set = 1, binding = 0, std140) uniform Occlusion
{
    OcclusionView last_view;    // the pyramid before this frame's early phase is done: the early phase reads it
    OcclusionView current_view; // the pyramid of the early phase: the late phase reads it
};
layout(set = 1, binding = 1, std430) readonly buffer Pyramid { float pyramid[]; };

// Whether everything in the box lies behind what was drawn.
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
