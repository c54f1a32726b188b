// Occlusion culling by a hierarchical Z-buffer: a pyramid of farthest depths, and the texels that cover a
// box. One source for C++ and GLSL, as decisions.h. N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer
// visibility", 1993. See runtime/gpu/README.md.
//
// Texel x of level k holds the smallest depth (reversed: the farthest) of pixels [x << k, (x + 1) << k);
// pixels beyond the edge of the frame are left out. So any size is reduced exactly, and shifts find the texel
// of a pixel. Level 0 is the depth buffer itself. The buffer of the pyramid starts with level 1 and ends with
// the level of a single texel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_OCCLUSION_H
#define HEARTH_SHARED_OCCLUSION_H

#include "formats/gpu_shared/decisions.h"

HEARTH_SHARED_BEGIN

/// Pixels by which a box is enlarged: vertices snap to 1/256, and pixel coordinates up to 16384 round to
/// 1/512.
HEARTH_CONSTANT float kPixelMargin = 0.015625f;

/// Relative margin of depth. A rasteriser rounds depth a few times, so it may come out nearer than the
/// nearest corner's by this much; of an orthographic view by this part of the range.
HEARTH_CONSTANT float kDepthMargin = 1.52587890625e-5f;

/// Side in pixels of the square that a workgroup of the pyramid pass reduces, by that many levels.
HEARTH_CONSTANT uint kPyramidTilePixels = 32;
HEARTH_CONSTANT uint kPyramidTileLevels = 5;

HEARTH_FUNCTION uint pyramidSize(uint pixels, uint level)
{
    return (pixels + (1u << level) - 1u) >> level;
}

/// Return the number of pyramid levels of a frame, from level 1 on.
HEARTH_FUNCTION uint pyramidLevels(uint width, uint height)
{
    uint level = 1u;
    while (pyramidSize(width, level) > 1u || pyramidSize(height, level) > 1u)
        ++level;
    return level;
}

/// Return the index of the first texel of a level. For the level after the last one: the size of the pyramid.
HEARTH_FUNCTION uint pyramidOffset(uint width, uint height, uint level)
{
    uint offset = 0u;
    for (uint k = 1u; k < level; ++k)
        offset += pyramidSize(width, k) * pyramidSize(height, k);
    return offset;
}

/// Texels beyond one that a box may cover each way: it is tested in the finest level where it covers no more.
/// Larger values find more occlusion and cost more. runtime/gpu/README.md, "Occlusion", has the measurements.
HEARTH_CONSTANT uint kMaxPyramidBoxTexels = 7;

/// Texels of a pyramid that cover a box on the screen: (x0, y0) to (x1, y1) of one level.
struct PyramidBox
{
    uint x0;
    uint y0;
    uint x1;
    uint y1;
    uint offset; ///< texel (0, 0) of the level
    uint stride; ///< texels in a row
    float depth; ///< upper bound of the depth of the box (reversed: the nearest point)
    uint known;  ///< 0: the box reaches the near plane or lies off the screen
};

HEARTH_FUNCTION PyramidBox pyramidBox(HEARTH_IN(OcclusionView) view, HEARTH_IN(Instance) instance,
                                      Float3 box_min, Float3 box_max)
{
    PyramidBox result;
    result.x0 = 0u;
    result.y0 = 0u;
    result.x1 = 0u;
    result.y1 = 0u;
    result.offset = 0u;
    result.stride = 0u;
    result.depth = 0.0f;
    result.known = 0u;
    if (view.level_count == 0u)
        return result;

    HEARTH_PRECISE Float3 center = (box_min + box_max) * 0.5f;
    HEARTH_PRECISE Float3 half_size = (box_max - box_min) * 0.5f;
    HEARTH_PRECISE Float3 relative = toEyeRelative(instance, view.eye, center);
    Float3 row_x = row3(instance.world_from_object_x);
    Float3 row_y = row3(instance.world_from_object_y);
    Float3 row_z = row3(instance.world_from_object_z);
    // half edges of the box in world axes
    HEARTH_PRECISE Float3 edge_x = Float3(row_x.x, row_y.x, row_z.x) * half_size.x;
    HEARTH_PRECISE Float3 edge_y = Float3(row_x.y, row_y.y, row_z.y) * half_size.y;
    HEARTH_PRECISE Float3 edge_z = Float3(row_x.z, row_y.z, row_z.z) * half_size.z;
    // magnitude of the terms that rounding errors are relative to
    HEARTH_PRECISE Float3 reach = abs3(center) + half_size;
    HEARTH_PRECISE Float3 slack =
        Float3(dot3(abs3(row_x), reach) + abs(instance.world_from_object_x.w - view.eye.x),
               dot3(abs3(row_y), reach) + abs(instance.world_from_object_y.w - view.eye.y),
               dot3(abs3(row_z), reach) + abs(instance.world_from_object_z.w - view.eye.z)) *
        (2.0f * kRoundingSlack);
    Float3 clip_x = row3(view.clip_x);
    Float3 clip_y = row3(view.clip_y);
    Float3 clip_w = row3(view.clip_w);
    HEARTH_PRECISE float slack_x = dot3(abs3(clip_x), slack);
    HEARTH_PRECISE float slack_y = dot3(abs3(clip_y), slack);
    HEARTH_PRECISE float slack_w = dot3(abs3(clip_w), slack);

    float low_x = 0.0f, high_x = 0.0f, low_y = 0.0f, high_y = 0.0f, nearest = 0.0f;
    for (uint i = 0u; i < 8u; ++i)
    {
        float side_x = (i & 1u) != 0u ? 1.0f : -1.0f;
        float side_y = (i & 2u) != 0u ? 1.0f : -1.0f;
        float side_z = (i & 4u) != 0u ? 1.0f : -1.0f;
        HEARTH_PRECISE Float3 corner = ((relative + edge_x * side_x) + edge_y * side_y) + edge_z * side_z;
        HEARTH_PRECISE float w = dot3(clip_w, corner);
        HEARTH_PRECISE float w_low = w - slack_w;
        if (!(w_low > view.z_near))
            return result;
        HEARTH_PRECISE float x = dot3(clip_x, corner) / w;
        HEARTH_PRECISE float y = dot3(clip_y, corner) / w;
        HEARTH_PRECISE float off_x = (slack_x + abs(x) * slack_w) / w_low;
        HEARTH_PRECISE float off_y = (slack_y + abs(y) * slack_w) / w_low;
        if (view.depth_scale > 0.0f)
        {
            HEARTH_PRECISE float parallel_x = dot3(clip_x, corner) + view.clip_x.w;
            HEARTH_PRECISE float parallel_y = dot3(clip_y, corner) + view.clip_y.w;
            x = parallel_x;
            y = parallel_y;
            off_x = slack_x + abs(x) * kRoundingSlack;
            off_y = slack_y + abs(y) * kRoundingSlack;
        }
        HEARTH_PRECISE float x_low = x - off_x;
        HEARTH_PRECISE float x_high = x + off_x;
        HEARTH_PRECISE float y_low = y - off_y;
        HEARTH_PRECISE float y_high = y + off_y;
        bool first = i == 0u;
        low_x = first ? x_low : min(low_x, x_low);
        high_x = first ? x_high : max(high_x, x_high);
        low_y = first ? y_low : min(low_y, y_low);
        high_y = first ? y_high : max(high_y, y_high);
        nearest = first ? w_low : min(nearest, w_low);
    }

    float width = float(view.width);
    float height = float(view.height);
    HEARTH_PRECISE float left = (low_x * 0.5f + 0.5f) * width - kPixelMargin;
    HEARTH_PRECISE float right = (high_x * 0.5f + 0.5f) * width + kPixelMargin;
    HEARTH_PRECISE float top = (low_y * 0.5f + 0.5f) * height - kPixelMargin;
    HEARTH_PRECISE float bottom = (high_y * 0.5f + 0.5f) * height + kPixelMargin;
    if (!(left < width && right >= 0.0f && top < height && bottom >= 0.0f))
        return result;
    uint x0 = uint(floor(max(left, 0.0f)));
    uint y0 = uint(floor(max(top, 0.0f)));
    uint x1 = uint(floor(min(right, width - 1.0f)));
    uint y1 = uint(floor(min(bottom, height - 1.0f)));
    uint level = 1u;
    uint offset = 0u;
    while ((x1 >> level) - (x0 >> level) > kMaxPyramidBoxTexels ||
           (y1 >> level) - (y0 >> level) > kMaxPyramidBoxTexels)
    {
        offset += pyramidSize(view.width, level) * pyramidSize(view.height, level);
        ++level;
    }
    result.x0 = x0 >> level;
    result.y0 = y0 >> level;
    result.x1 = x1 >> level;
    result.y1 = y1 >> level;
    result.offset = offset;
    result.stride = pyramidSize(view.width, level);
    HEARTH_PRECISE float depth = (view.z_near / nearest) * (1.0f + kDepthMargin);
    if (view.depth_scale > 0.0f)
    {
        HEARTH_PRECISE float parallel_depth = (view.clip_w.w - nearest) * view.depth_scale + kDepthMargin;
        depth = parallel_depth;
    }
    result.depth = depth;
    result.known = 1u;
    return result;
}

HEARTH_SHARED_END

#endif
