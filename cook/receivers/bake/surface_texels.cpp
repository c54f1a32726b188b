// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/surface_texels.h"

#include "cook/receivers/bake/gather_table.h"

#include <algorithm>
#include <cmath>

namespace hearth::receivers
{

namespace
{

/// Least cosine between the normals of texels on the same surface.
constexpr float kSameSide = 0.8f;

} // namespace

SurfaceTexels::SurfaceTexels(const BakeScene& scene, const TexelDomain& domain)
{
    for (const DomainTexel& texel : domain.texels)
    {
        Element middle;
        middle.points.fill(texel.middle);
        const ReceivingPoint point = receivingPoint(scene, middle, 0, 0);
        places_.push_back({point.position, point.side});
    }
    std::vector<float> lengths;
    for (size_t i = 0; i + 1 < places_.size(); ++i)
        if (domain.texels[i + 1].y == domain.texels[i].y && domain.texels[i + 1].x == domain.texels[i].x + 1)
            lengths.push_back(length(places_[i + 1].position - places_[i].position));
    if (lengths.empty())
        return;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    texel_ = *middle;
}

bool SurfaceTexels::areNear(size_t a, size_t b, float distance) const
{
    const Float3 offset = places_[b].position - places_[a].position;
    const float reach = 2 * texel_ * (distance + 1);
    return dot(places_[a].normal, places_[b].normal) >= kSameSide && dot(offset, offset) <= reach * reach &&
           std::abs(dot(offset, places_[a].normal)) <= 0.25f * reach;
}

} // namespace hearth::receivers
