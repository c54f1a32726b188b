// Tone mapping from scene-linear radiance to display-linear colour.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// J. Hejl, R. Burgess-Dawson, "Filmic tonemapping", 2010. The result of the fit is for a 2.2 gamma display;
// the target encodes sRGB itself, so the gamma is taken out again.
vec3 toneMap(vec3 radiance)
{
    vec3 x = max(vec3(0.0), radiance - 0.004);
    vec3 display = (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
    return pow(display, vec3(2.2));
}

// Linear value that an sRGB target stores as `encoded`; for debug views of data.
vec3 linearFromSrgb(vec3 encoded)
{
    return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), greaterThan(encoded, vec3(0.04045)));
}
