// Traces the rays along which elements see each other. They are the same for all lights and bounces, so they
// are traced once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/bake/direct_light.h"
#include "cook/receivers/bake/elements.h"

#include <vector>

namespace hearth::receivers
{

inline constexpr uint32_t kPointRays = 16; ///< gather rays of a point
inline constexpr uint32_t kElementRays = kTexelPoints * kPointRays;

/// Return the place from which a point of an element receives light.
ReceivingPoint receivingPoint(const BakeScene& scene, const Element& element, size_t point, float offset);

/// Elements that the rays of each element meet, by cosine-weighted directions.
class GatherTable
{
public:
    /// Trace all rays. The table has the same values for any number of threads.
    GatherTable(const BakeScene& scene, const BakeRays& rays, const Elements& elements);

    /// Return a bit for each point of an element that is in the open. The rays of others mostly meet the
    /// backs of surfaces that have none: they are inside of walls, and have no light.
    uint32_t openPoints(size_t element) const { return open_[element]; }

    /// Return the elements that the rays of an element meet, those of a point together; kInvalidIndex: none.
    std::span<const uint32_t> hits(size_t element) const
    {
        return std::span(hits_).subspan(element * kElementRays, kElementRays);
    }

    /// Return the irradiance that the sky causes at an element without a bounce: pi times the mean over the
    /// open points' rays of the sky's radiance, 0 for rays that meet a triangle.
    Float3 skyIrradiance(size_t element) const { return sky_.empty() ? Float3{} : sky_[element]; }

private:
    struct TracedPoint
    {
        bool is_open = false;
        Float3 sky; ///< sum of its radiance over the rays that meet no triangle
    };
    TracedPoint tracePoint(const BakeScene& scene, const BakeRays& rays, const Elements& elements,
                           size_t element, size_t point);

    std::vector<uint32_t> hits_; ///< kElementRays of each element, those of a point together
    std::vector<uint8_t> open_;
    std::vector<Float3> sky_; ///< irradiance; empty without a sky
};

} // namespace hearth::receivers
