// Surface of a pixel as lights need it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_LIT_SURFACE_GLSL
#define HEARTH_LIT_SURFACE_GLSL

struct LitSurface
{
    vec3 normal; // unit, world axes, towards the visible side
    vec3 flat_normal; // the same of the triangle
    mediump vec3 base; // colour
    mediump float metallic;
    float roughness; // perceptual, above 0
    float error; // metres, bounds the distance of the triangle to the source
    bool receives; // baked lamps have been counted already: ReceivedLight::is_known
};

#endif
