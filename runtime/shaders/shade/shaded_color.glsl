// Colour that shading writes: finished or, for frames with a final pass, scene-linear.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/shading_push.glsl"
#include "runtime/shaders/shade/stored_radiance.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

mediump vec3 behindFilter(mediump vec3 display)
{
    return photoFilter(display, vec3(push.filter_red, push.filter_green, push.filter_blue), push.filter_density);
}

vec3 shadedColor(vec3 radiance)
{
    if (kStored == kStoredDisplay)
        return toneMap(radiance);
    if (kStored == kStoredGraded)
        return behindFilter(toneMap(push.exposure * radiance));
    return storedRadiance(radiance);
}

// The same of an unlit colour, a display colour: it passes the tone curve as it is, unless the exposure
// changes it.
vec3 shadedUnlit(vec3 display)
{
    if (kStored == kStoredDisplay)
        return display;
    if (kStored == kStoredGraded)
        return behindFilter(push.exposure == 1.0 ? display : toneMap(push.exposure * radianceFromDisplay(display)));
    return storedRadiance(radianceFromDisplay(display));
}
