// Lists the lights of the frame in one workgroup: those that every point gets, then those with a range that
// reach into the view. Both rise. Takes the marks of the last frame's pixels from the cells.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/cull/scan.glsl"
#include "runtime/shaders/light/light_buffer.glsl"

layout(local_size_x = kScanThreads) in;

layout(push_constant) uniform Push { LightListsPush push; };

// Number of the slab of a depth, counted over all cascades.
uint slabNumber(float depth)
{
    uint k = lightCascadeAt(depth);
    return lighting.cascades[k].first_slab + lightSlabAt(lighting.cascades[k], depth);
}

void main()
{
    uint first_row = lighting.first_list_word + kLightCountWords;
    uint unranged_count = 0u;
    for (uint first = 0u; first < lighting.light_count; first += kScanThreads)
    {
        uint row = first + gl_LocalInvocationIndex;
        bool is_listed = row < lighting.light_count && isUnrangedLight(lights[row]) && !isLightOff(lights[row]);
        uint total;
        uint place = unranged_count + exclusiveScan(is_listed ? 1u : 0u, total);
        if (is_listed)
            light_words[first_row + place] = row;
        unranged_count += total;
    }
    uint ranged = 0u;
    for (uint first = 0u; first < lighting.light_count; first += kScanThreads)
    {
        uint row = first + gl_LocalInvocationIndex;
        bool is_listed = row < lighting.light_count && !isUnrangedLight(lights[row]) && !isLightOff(lights[row]);
        CellLight light;
        if (is_listed)
        {
            light = makeCellLight(lighting.grid, lights[row]);
            is_listed = isLightInView(lighting.grid, light);
        }
        uint total;
        uint place = ranged + exclusiveScan(is_listed ? 1u : 0u, total);
        if (is_listed)
        {
            precise float nearest = max(light.center.z - light.radius, lighting.grid.z_near);
            precise float farthest = max(light.center.z + light.radius, lighting.grid.z_near);
            light.first_slab = slabNumber(nearest);
            light.last_slab = slabNumber(farthest);
            light_words[first_row + unranged_count + place] = row;
            cell_lights[lighting.first_in_view + place] = light;
        }
        ranged += total;
    }
    for (uint cell = gl_LocalInvocationIndex; push.marked_only != 0u && cell < lighting.list_count; cell += kScanThreads)
        light_words[lighting.first_cell_word + cell] = kUnmarkedCell;
    // passes that follow set the other counts or add to them
    uint word = gl_LocalInvocationIndex;
    if (word < kLightCountWords)
        light_words[lighting.first_list_word + word] = word == kCountUnranged ? unranged_count : word == kCountRanged ? ranged : 0u;
}
