// Lists the lights that reach each slot of the visible list: those that meet its box, as culling bounds it.
// Workgroups take slots in turn. Shared by the passes over scenes without and with deformed meshes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/light_boxes.h"
#include "formats/gpu_shared/shading.h"
#define HEARTH_LIGHTS_SET kSetSceneLights
#include "runtime/shaders/light/light_buffer.glsl"
#include "runtime/shaders/light/area_lists.glsl"

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableStates, std430) readonly buffer States { InstanceState states[]; };
layout(set = kSetTables, binding = kTableClusters, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = kSetTables, binding = kTableCounters, std430) readonly buffer Counters { FrameCounters counters; };
layout(set = kSetTables, binding = kTableVisible, std430) readonly buffer Visible { VisibleCluster visible[]; };

LightBox box;

bool reachesArea(CellLight light)
{
    return reachesBox(light, box);
}

// Box of a cluster of a rigid instance.
LightBox rigidBox(VisibleCluster slot)
{
    float grid_step = states[slot.instance].grid_step;
    Cluster cluster = clusters[slot.cluster];
    return lightBox(lighting.grid, instances[slot.instance], view.eye, clusterBoxMin(cluster, grid_step),
                    clusterBoxMax(cluster, grid_step));
}

LightBox slotBox(VisibleCluster slot);

void main()
{
    uint room = lighting.list_count;
    uint drawn = counters.drawn_clusters - counters.dropped_clusters;
    for (uint slot = gl_WorkGroupID.x; slot < min(drawn, room); slot += gl_NumWorkGroups.x)
    {
        box = slotBox(visible[slot]);
        listArea(lighting.first_cell_word + slot);
        barrier(); // the marks of this slot may still be read
    }
    if (push.writes != 0u)
        return;
    // slots without a cluster have no lights; those without room for a list get all lights
    uint step = gl_NumWorkGroups.x * kScanThreads;
    for (uint slot = drawn + gl_WorkGroupID.x * kScanThreads + gl_LocalInvocationIndex; slot < room; slot += step)
        light_words[lighting.first_cell_word + slot] = 0u;
    if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u && drawn > room)
        light_words[lighting.first_list_word + kCountOverflows] = drawn - room;
}
