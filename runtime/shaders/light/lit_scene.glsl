// Frame and shadows of a scene as the shaders see them that light stored surfaces.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/records.h"
#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/shadow.h"

layout(set = kSetScene, binding = kSceneFrame, std140) uniform Frame { FrameView view; };

#ifdef HEARTH_SHADOWED
#include "runtime/shaders/shade/shadow.glsl"
#else
#include "runtime/shaders/shade/unshadowed.glsl"
#endif
