// Page requests of rigid instances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#version 450
#extension GL_GOOGLE_include_directive : require
#include "formats/gpu_shared/decisions.h"
#include "runtime/shaders/cull/page_requests.glsl"

Group transformedGroup(uint instance, uint group) { return groups[group]; }

bool inFrustum(uint instance, uint cluster)
{
    return clusterInFrustum(view, instances[instance], states[instance], clusters[cluster]);
}

TexelReach findReach(uint instance, uint cluster)
{
    return clusterReach(view, instances[instance], states[instance], clusters[cluster]);
}
