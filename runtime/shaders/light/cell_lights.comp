// Finds the lights of each cell, or of each that a pixel has marked. A workgroup has 8 x 8 cells of a slab:
// it marks the lights that may meet them, then each thread tests the marked ones for its own cell. Runs
// twice: to count, and to write the indices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/push_constants.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/light/light_buffer.glsl"

const uint kBlockCells = 8u; // each way
layout(local_size_x = kBlockCells * kBlockCells) in;

layout(push_constant) uniform Push { LightListsPush push; };

shared uint marks[kMaxLights / 32u];
shared uint listed_cells;

uint cascadeOfSlab(uint slab)
{
    uint k = 0u;
    while (k + 1u < kLightCascades && lighting.cascades[k + 1u].first_slab <= slab)
        ++k;
    return k;
}

// Mark the lights whose bounds in the slab overlap the block.
// edges  of the block: least and greatest u, least and greatest v
void markLights(LightSlab slab, uint slab_number, vec4 edges, uint count)
{
    for (uint i = gl_LocalInvocationIndex; i < count; i += kBlockCells * kBlockCells)
    {
        CellLight light = lightInView(i);
        if (slab_number < light.first_slab || slab_number > light.last_slab)
            continue;
        vec4 bounds = lightBounds(lighting.grid, light, slab).edges;
        if (bounds.x <= bounds.y && bounds.x <= edges.y && bounds.y >= edges.x && bounds.z <= edges.w && bounds.w >= edges.z)
            atomicOr(marks[i >> 5], 1u << (i & 31u));
    }
}

// True if this run has to test the lights of a cell.
bool needsTests(uint word)
{
    if (push.writes != 0u)
        return lightCellCount(word) != 0u && lightCellCount(word) != kAllLights;
    return push.marked_only == 0u || word != kUnmarkedCell;
}

void main()
{
    uint count = lightCount(kCountRanged);
    uint slab_number = gl_WorkGroupID.z;
    uint k = cascadeOfSlab(slab_number);
    LightCascade cascade = lighting.cascades[k];
    uvec2 block = gl_WorkGroupID.xy * kBlockCells;
    if (block.x >= cascade.columns || block.y >= cascade.rows)
        return;
    for (uint i = gl_LocalInvocationIndex; i < kMaxLights / 32u; i += kBlockCells * kBlockCells)
        marks[i] = 0u;
    if (gl_LocalInvocationIndex == 0u)
        listed_cells = 0u;
    barrier();
    uint column = block.x + gl_LocalInvocationIndex % kBlockCells;
    uint row_number = block.y + gl_LocalInvocationIndex / kBlockCells;
    uint cell = lighting.first_cell_word + cascade.first_cell +
                ((slab_number - cascade.first_slab) * cascade.rows + row_number) * cascade.columns + column;
    bool is_listed = column < cascade.columns && row_number < cascade.rows && needsTests(light_words[cell]);
    if (is_listed)
        atomicAdd(listed_cells, 1u);
    barrier();
    if (listed_cells == 0u)
        return;
    LightSlab slab = lightSlab(lighting.grid, cascade, slab_number - cascade.first_slab);
    bool is_drawn = slab.end > slab.begin;
    if (is_drawn)
        markLights(slab, slab_number,
                   vec4(lightColumnEdge(lighting.grid, cascade, block.x),
                        lightColumnEdge(lighting.grid, cascade, min(block.x + kBlockCells, cascade.columns)),
                        lightRowEdge(lighting.grid, cascade, block.y),
                        lightRowEdge(lighting.grid, cascade, min(block.y + kBlockCells, cascade.rows))),
                   count);
    barrier();

    if (!is_listed)
        return;
    bool writes = push.writes != 0u;
    uint listed = writes ? light_words[cell] : 0u;
    uint word_at = lighting.first_index_word + lightCellOffset(listed);
    LightRow row = LightRow(lightRowEdge(lighting.grid, cascade, row_number), lightRowEdge(lighting.grid, cascade, row_number + 1u));
    vec4 edges = vec4(lightColumnEdge(lighting.grid, cascade, column), lightColumnEdge(lighting.grid, cascade, column + 1u), row.begin, row.end);
    uint found = 0u;
    uint pair = 0u;
    for (uint word = 0u; word < (count + 31u) / 32u; ++word)
        for (uint bits = marks[word]; bits != 0u; bits &= bits - 1u)
        {
            uint place = word * 32u + uint(findLSB(bits));
            CellLight light = lightInView(place);
            LightColumns columns = lightColumns(lighting.grid, cascade, light, slab, row);
            if (int(column) < columns.first || int(column) > columns.last || !reachesCell(lighting.grid, light, slab, edges))
                continue;
            pair = (found & 1u) == 0u ? place : pair | place << 16;
            if (writes && (found & 1u) != 0u)
                light_words[word_at + (found >> 1)] = pair;
            ++found;
        }
    if (!writes)
        light_words[cell] = found;
    else if ((found & 1u) != 0u)
        light_words[word_at + (found >> 1)] = pair;
}
