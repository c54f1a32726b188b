// How much of a GGX lobe falls into a cone: the exact value, by deterministic quadrature.
// README.md of this folder has the derivation.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/records/specular.h"

#include <span>

namespace hearth::specular
{

/// E. Heitz, "Understanding the masking-shadowing function in microfacet-based BRDFs", JCGT 2014. The runtime's BRDF has the
/// height-correlated one.
using Masking = formats::SpecularMasking;

/// A lobe in the frame of its normal N = (0, 0, 1): the view is V = (-sin theta_o, 0, cos theta_o), its mirror
/// direction R = (sin theta_o, 0, cos theta_o).
struct Lobe
{
    double roughness = 1; ///< above 0, to 1; GGX alpha is its square
    double theta_o =
        0; ///< angle between view and normal in radians, 0 to pi / 2 included: the limit of grazing views
    Masking masking = Masking::correlated;
};

/// The directions within half_angle of a unit axis.
struct Cone
{
    Double3 axis{0, 0, 1};
    double half_angle = 0; ///< radians, 0 to pi
};

/// Points of the quadrature: of each piece of the outer integral, and of each interval of the inner one.
struct Fineness
{
    int outer = 32;
    int inner = 24;
};

/// S = int D G2 / (4 cos_o) dw over the cone above the horizon, as a share of the same integral over all directions above
/// the horizon. In [0, 1]. Fresnel is left out.
double occlusionOf(const Lobe& lobe, const Cone& cone, Fineness fineness = {});

/// The same for many cones about one axis: the lobe is integrated once. out  as long as half_angles
void occlusionsOf(const Lobe& lobe, const Double3& axis, std::span<const double> half_angles,
                  std::span<double> out, Fineness fineness = {});

} // namespace hearth::specular
