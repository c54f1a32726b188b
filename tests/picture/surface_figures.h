// Measures light and occlusion on the surfaces that a picture shows, beside rays.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/picture/radiance_image.h"
#include "tests/reference/tracer/shaded_scene.h"

#include <optional>

namespace hearth::picture
{

/// Baked ambient occlusion beside rays.
struct OcclusionError
{
    double rms = 0;
    reference::Image traced; ///< grey, white where there is no surface
};

/// Surface points at the centres of an image's pixels.
class SeenSurfaces
{
public:
    /// scene  of the pack; must outlive the object
    SeenSurfaces(const reference::ShadedScene& scene, const formats::PackView& pack,
                 const shared::Camera& camera, uint32_t width, uint32_t height);

    /// Light of a picture over that of another on walls that no lamp reaches: the light of the sky and of
    /// other surfaces. Means over opaque, dull, vertical surfaces. None if the pictures show none.
    std::optional<double> compareWalls(const reference::Image& picture,
                                       const reference::Image& expected) const;

    /// Compare a picture of ambient occlusion, as `hearth-render --view ao` draws it, with rays about the
    /// shading normal, which unlit surfaces do not end. Meshes with joints or morph targets are left out:
    /// they move, and are baked alone. A squared difference is the product of the differences
    /// from either half of the rays, so that their noise does not count.
    /// rays  for each pixel, even
    OcclusionError measureOcclusion(const reference::Image& picture, uint32_t rays) const;

private:
    const reference::ShadedScene& scene_;
    uint32_t width_, height_;
    std::vector<bool> is_deformed_;                             ///< of each instance
    std::vector<std::optional<reference::ShadedPoint>> points_; ///< none: sky, unlit, or next to a silhouette
};

} // namespace hearth::picture
