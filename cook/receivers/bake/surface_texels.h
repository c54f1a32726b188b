// Says which texels of an instance are neighbours on its surface, and not only in the atlas.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/bake_scene.h"
#include "cook/receivers/bake/texel_domain.h"

#include <vector>

namespace hearth::receivers
{

/// Places of the texels of an instance.
class SurfaceTexels
{
public:
    SurfaceTexels(const BakeScene& scene, const TexelDomain& domain);

    /// Return whether two texels are on the same surface: their normals are alike, and they are about as far
    /// from each other as their cells. Charts may lie side by side in the atlas by chance.
    /// a, b      numbers in the domain
    /// distance  between their cells, in texels
    bool areNear(size_t a, size_t b, float distance) const;

private:
    struct Place
    {
        Float3 position, normal;
    };

    std::vector<Place> places_;
    float texel_ = 0; ///< metres, the median of lengths between neighbours in a row
};

} // namespace hearth::receivers
