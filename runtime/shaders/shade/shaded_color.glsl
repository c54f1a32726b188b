// Colour that shading writes: finished or, for frames with a final pass and images of radiance, scene-linear.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/scene/shading_push.glsl"
#include "runtime/shaders/shade/image_color.glsl"
#include "runtime/shaders/shade/stored_radiance.glsl"
#include "runtime/shaders/shade/tonemap.glsl"

mediump vec3 behindFilter(mediump vec3 display)
{
    return photoFilter(display, vec3(push.filter_red, push.filter_green, push.filter_blue), push.filter_density);
}

vec3 shadedColor(vec3 radiance)
{
    if (kStored == kStoredDisplay)
        return imageColor(toneMap(radiance));
    if (kStored == kStoredGraded)
        return imageColor(behindFilter(toneMap(push.exposure * radiance)));
    return storedRadiance(kStoresExposed ? push.exposure * radiance : radiance);
}

// The same of an unlit colour, a display colour: it passes the tone curve as it is, unless the exposure
// changes it.
vec3 shadedUnlit(vec3 display)
{
    if (kStored == kStoredDisplay)
        return imageColor(display);
    if (kStored == kStoredGraded)
        return imageColor(behindFilter(push.exposure == 1.0 ? display : toneMap(push.exposure * radianceFromDisplay(display))));
    vec3 radiance = radianceFromDisplay(display);
    return storedRadiance(kStoresExposed ? push.exposure * radiance : radiance);
}
