// Parts in which the light of a specular lobe is looked up in the image of a sky. One source for C++ and GLSL.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#ifndef HEARTH_SHARED_SKY_LOBE_H
#define HEARTH_SHARED_SKY_LOBE_H

#include "formats/gpu_shared/precision.h"

// The mips of a probe are lobes seen along the normal, about the mirror direction. Seen from aside, a lobe is
// narrower across, its tail leans towards the normal, and masking takes what grazes the surface. So a lobe is
//     (1 - wide) mip(roughness', axis) + wide ((1 - even) diffuse + even mean),
// where diffuse is the mean by the cosine to the normal, and mean that over all directions. The four numbers
// were fitted to lobes of GGX with height-correlated masking, as harmonics of degree 12 with weights
// 1 / sqrt(1 + l^2): the rms error of roughness .25 to .8 is .01 to .19 of the lobe, seen at cosines of 1 to
// .1; one mip about the lobe's mean direction has .02 to .39 (tests/formats/sky_lobe_test.cpp).

HEARTH_SHARED_BEGIN

struct SkyLobe
{
    Half turn;      ///< axis: (1 - turn) mirror direction + turn normal
    Half roughness; ///< of the mip
    Half wide;      ///< share of the wide part, [0, 1]
    Half even;      ///< share of the mean over all directions in the wide part
};

/// Return the parts of a lobe.
HEARTH_FUNCTION SkyLobe skyLobe(Half roughness, Half n_dot_v)
{
    Half alpha = roughness * roughness;
    Half aside = 1.0f - n_dot_v;
    Half rest = 1.0f - alpha;
    SkyLobe lobe;
    lobe.turn = min(alpha * aside * (0.5f + 0.8f * aside), 0.35f);
    lobe.roughness = roughness * (1.0f - 0.3f * aside) * (1.0f - 0.25f * alpha * alpha);
    lobe.wide =
        min(alpha * alpha * (3.0f - 2.0f * alpha) + 1.6f * aside * aside * aside * alpha * rest * rest, 1.0f);
    lobe.even = 0.25f * alpha * alpha * alpha * (0.27f + 0.45f * aside * aside);
    return lobe;
}

HEARTH_SHARED_END

#endif
