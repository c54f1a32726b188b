// Image with the tables of reflectance.h, sheen.h and sky.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHADING_TABLES_GLSL
#define HEARTH_SHADING_TABLES_GLSL

#include "formats/gpu_shared/bindings.h"
#include "formats/gpu_shared/reflectance.h"

layout(set = kSetScene, binding = kSceneShadingTables) uniform mediump sampler2D shading_tables;

const vec2 kShadingTablesSize = vec2(kShadingTablesWidth, kShadingTablesHeight);

#endif
