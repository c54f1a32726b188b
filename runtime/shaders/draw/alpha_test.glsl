// Alpha test by the cutoff. Blended surfaces are drawn with an ordered-dither pattern that covers a share
// alpha of the pixels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

// Thresholds 1/128, 3/128 ... 127/128, each once in 8x8 pixels. B. Bayer, "An optimum method for two-level
// rendition of continuous-tone pictures", 1973.
float ditherThreshold(uvec2 pixel)
{
    uint x = pixel.x ^ pixel.y;
    uint y = pixel.y;
    uint rank = (x & 1u) << 5 | (y & 1u) << 4 | (x & 2u) << 2 | (y & 2u) << 1 | (x & 4u) >> 1 | (y & 4u) >> 2;
    return (float(rank) + 0.5) / 64.0;
}

bool isHole(vec2 uv, float alpha)
{
    if ((material.textures & 1u) != 0u)
        alpha *= texture(base_color_texture, uv).a;
    float threshold =
        material.alpha_mode == kAlphaMask ? material.alpha_cutoff : ditherThreshold(uvec2(gl_FragCoord.xy));
    return alpha < threshold;
}
