// Stores what lights need of the surfaces of one material, ahead of its shading. Materials that are unlit or
// have layers are not drawn by it: those with layers are lit where they are shaded. Shaders that include it
// define the layout: normal_texel.glsl.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/decisions.h"
#include "formats/gpu_shared/shading.h"
#include "runtime/shaders/scene/scene.glsl"
#include "runtime/shaders/scene/material.glsl"
#include "runtime/shaders/scene/surface_point.glsl"
#include "runtime/shaders/scene/resolve.glsl"
#include "runtime/shaders/scene/visibility_input.glsl"
#include "runtime/shaders/scene/material_test.glsl"
#include "runtime/shaders/shade/material_values.glsl"
#include "runtime/shaders/prepass/normal_texel.glsl"
#include "runtime/shaders/scene/light_block.glsl"
#include "runtime/shaders/scene/receivers.glsl"

layout(early_fragment_tests) in;
layout(location = 0) out NormalTexel out_normal;

void main()
{
    uint id = loadVisibility();
    if (isForeign(id))
        discard;
    Surface s = resolveSurface(id, gl_FragCoord.xy);
    SurfacePoint point = surfacePoint(s);
    SurfaceUvs uvs = surfaceUvs(s);
    MaterialValues values = materialValues(point, uvs, material.base_color.rgb * point.color);
    StoredNormal stored = StoredNormal(values.normal, point.flat_normal, values.roughness, point.error,
                                       kReceivers && isReceiver(receiverRow(s.slot.instance), s));
    out_normal = packNormal(stored, dot(view.clip_w.xyz, point.position));
}
