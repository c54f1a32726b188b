// Gives each list of lights a place, in one workgroup: a prefix sum over the counts. A list that is too long
// or has no room becomes all lights of the frame, as has been the list of a cell that no pixel marks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/cull/scan.glsl"
#include "runtime/shaders/light/light_buffer.glsl"

layout(local_size_x = kScanThreads) in;

shared uint overflows, cells, indices;

void main()
{
    if (gl_LocalInvocationIndex == 0u)
        overflows = cells = indices = 0u;
    barrier();
    uint words = 0u;
    for (uint first = 0u; first < lighting.list_count; first += kScanThreads)
    {
        uint cell = first + gl_LocalInvocationIndex;
        uint at = lighting.first_cell_word + cell;
        bool is_cell = cell < lighting.list_count && light_words[at] != kUnmarkedCell;
        uint count = is_cell ? light_words[at] : 0u;
        uint total;
        uint offset = words + exclusiveScan(lightListWords(count), total);
        uint word = placeLightList(count, offset, lighting.index_words);
        if (is_cell)
            light_words[at] = word;
        words += total;
        if (count > 0u)
        {
            atomicAdd(cells, 1u);
            atomicAdd(indices, count);
            atomicAdd(overflows, lightCellCount(word) == kAllLights ? 1u : 0u);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
    {
        light_words[lighting.first_list_word + kCountIndexWords] = words;
        light_words[lighting.first_list_word + kCountOverflows] += overflows; // to slots without a list
        light_words[lighting.first_list_word + kCountCells] = cells;
        light_words[lighting.first_list_word + kCountIndices] = indices;
    }
}
