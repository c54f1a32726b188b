// Value of a display-linear colour in the image that a frame shows: its format applies the sRGB curve, or the
// shader does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/specialization.h"

layout(constant_id = kConstantEncodes) const bool kEncodes = false;

vec3 imageColor(vec3 display)
{
    if (!kEncodes)
        return display;
    vec3 linear = clamp(display, 0.0, 1.0);
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(12.92 * linear, curve, greaterThan(linear, vec3(0.0031308)));
}
