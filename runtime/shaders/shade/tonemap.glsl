// Tone mapping from scene-linear radiance to display-linear colour, its inverse, and the photo filter.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/post.h"
#include "formats/gpu_shared/precision.h"

const float kToneBlack = 0.004; // radiance that is shown as black

// J. Hejl, R. Burgess-Dawson, "Filmic tonemapping", 2010. The result of the fit is for a 2.2 gamma display;
// the target encodes sRGB itself, so the gamma is taken out again.
vec3 toneMap(vec3 radiance)
{
    vec3 x = max(vec3(0.0), radiance - kToneBlack);
    vec3 display = (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
    return pow(display, vec3(2.2));
}

// Radiance that toneMap shows as a colour, at most kMaxUnlitRadiance.
vec3 radianceFromDisplay(vec3 display)
{
    // the curve is t = (6.2 x^2 + 0.5 x) / (6.2 x^2 + 1.7 x + 0.06): a quadratic equation for x
    vec3 t = pow(clamp(display, 0.0, 1.0), vec3(1.0 / 2.2));
    vec3 a = 6.2 * (1.0 - t);
    vec3 b = 0.5 - 1.7 * t;
    vec3 root = sqrt(b * b + 0.24 * a * t);
    // each form where it subtracts nothing; a is 0 for white alone
    vec3 x = mix((root - b) / max(2.0 * a, 1e-6), 0.12 * t / max(b + root, 1e-6), greaterThan(b, vec3(0.0)));
    return min(x + kToneBlack, kMaxUnlitRadiance);
}

float luminance(vec3 color) { return dot(color, kLuminanceWeights); }

// Colour behind a photo filter of this colour, as bright as before.
mediump vec3 photoFilter(mediump vec3 color, mediump vec3 filter_color, mediump float density)
{
    if (density == 0.0)
        return color;
    mediump vec3 filtered = color * (1.0 - density + density * filter_color);
    mediump float before = dot(color, kLuminanceWeights);
    mediump float after = dot(filtered, kLuminanceWeights);
    return after > 0.0 ? filtered * (before / after) : color;
}

// Linear value that an sRGB target stores as `encoded`; for debug views of data.
vec3 linearFromSrgb(vec3 encoded)
{
    return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), greaterThan(encoded, vec3(0.04045)));
}
