// Computes the share of a GGX lobe inside a cone: the exact value, by deterministic quadrature.
// Derivation: cook/specular/README.md, "Exact".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/records/specular.h"

#include <span>

namespace hearth::specular
{

/// Masking-shadowing function. E. Heitz, "Understanding the masking-shadowing function in microfacet-based
/// BRDFs", JCGT 2014. The runtime's BRDF has the height-correlated one.
using Masking = formats::SpecularMasking;

/// GGX lobe in the frame of its normal N = (0, 0, 1): the view is V = (-sin theta_o, 0, cos theta_o), its
/// mirror direction R = (sin theta_o, 0, cos theta_o).
struct Lobe
{
    double roughness = 1; ///< above 0, to 1; GGX alpha is its square
    /// Angle between view and normal in radians, 0 to pi / 2 included: the limit of grazing views.
    double theta_o = 0;
    Masking masking = Masking::correlated;
};

/// Cone of the directions within half_angle of a unit axis.
struct Cone
{
    Double3 axis{0, 0, 1};
    double half_angle = 0; ///< radians, 0 to pi
};

/// Number of quadrature points, in each piece of the outer integral and in each interval of the inner one.
struct QuadratureOrder
{
    int outer = 32;
    int inner = 24;
};

/// Compute S = int D G2 / (4 cos_o) dw over the cone above the horizon, as a share of the same integral over
/// all directions above the horizon. In [0, 1]. Fresnel is left out.
double computeOcclusion(const Lobe& lobe, const Cone& cone, QuadratureOrder order = {});

/// Compute the same for many cones about one axis, with one integration of the whole lobe.
/// out  as long as half_angles
void computeOcclusions(const Lobe& lobe, const Double3& axis, std::span<const double> half_angles,
                       std::span<double> out, QuadratureOrder order = {});

/// A lobe as a whole.
struct LobeMoments
{
    /// Share of constant light that is reflected after one scattering: f0 * scale + bias, with Schlick's
    /// Fresnel term of a reflectance f0 at normal incidence.
    double scale = 0, bias = 0;
    /// Mean of the directions of light, without the Fresnel term: between N and R, shorter the wider the
    /// lobe.
    Double3 mean{};
};

/// Integrate over all directions above the horizon.
LobeMoments computeMoments(const Lobe& lobe, QuadratureOrder order = {});

} // namespace hearth::specular
