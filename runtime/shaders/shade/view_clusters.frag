// Debug views of the visible cluster's data: screen-space error, normal cone. One full-screen triangle for
// all materials; the depth test leaves out the sky.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/scene/shading_push.glsl"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/specialization.h"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

layout(set = kSetTables, binding = kTableFrame, std140) uniform Frame { FrameView view; };
layout(set = kSetTables, binding = kTableInstances, std430) readonly buffer Instances { Instance instances[]; };
layout(set = kSetTables, binding = kTableVisible, std430) readonly buffer Visible { VisibleCluster visible[]; };
layout(set = kSetTables, binding = kTableClusters, std430) readonly buffer Clusters { Cluster clusters[]; };
layout(set = kSetTables, binding = kTableGroups, std430) readonly buffer Groups { Group groups[]; };
#define HEARTH_VISIBILITY_SET kSetClusterAttachments
#include "runtime/shaders/scene/visibility_input.glsl"

layout(constant_id = kConstantComparesMaterial) const bool kComparesMaterial = false;

layout(early_fragment_tests) in;
layout(location = 0) out vec4 out_color;

// Screen-space error in pixels, as in the cut test (errorExceeds), relative to the error threshold.
float errorRatio(Instance instance, Cluster cluster)
{
    if (cluster.refined_group == kNoGroup || view.threshold <= 0.0)
        return 0.0;
    Group refined = groups[cluster.refined_group];
    ScreenError on_screen = screenError(view, instance, refined.sphere_center, refined.sphere_radius, refined.error);
    return on_screen.pixels_m / on_screen.distance / view.threshold;
}

// From blue for the source to yellow at the error threshold.
vec3 errorColor(float ratio) { return mix(vec3(0.1, 0.15, 0.5), vec3(1.0, 0.85, 0.1), clamp(ratio, 0.0, 1.0)); }

// Green if all triangles face the same way, up to yellow; red if there is no cone: cone culling never removes
// such clusters.
vec3 coneColor(Cluster cluster)
{
    uint cutoff = cluster.cone >> 16;
    if (cutoff == 65535u)
        return vec3(0.7, 0.1, 0.1);
    return mix(vec3(0.1, 0.7, 0.3), vec3(0.9, 0.8, 0.1), float(cutoff) / 65536.0);
}

void main()
{
    uint id = loadVisibility();
    if (kComparesMaterial && id == kVisibilitySky)
        discard;
    VisibleCluster slot = visible[id >> kTriangleBits];
    Cluster cluster = clusters[slot.cluster];
    vec3 color = push.debug_view == kViewCones ? coneColor(cluster)
                                          : errorColor(errorRatio(instances[slot.instance], cluster));
    out_color = vec4(imageColor(linearFromSrgb(color)), 1.0);
}
