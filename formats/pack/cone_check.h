// Tests triangles against the normal cone of a cluster. Not for use outside formats/.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/pack/pack_check.h"

namespace hearth::formats::check
{

/// Normal cone of a cluster, prepared for the tests. All tests compare squares, so a triangle needs no root
/// and no division. Rounding moves neither bound by more than 1e-11, in units of a sine and of kApexSlack.
class ConeCheck
{
public:
    ConeCheck(const ClusterRecord& cluster, float grid_step) : axis_(widen(coneAxis(cluster)))
    {
        const double sine = coneCutoff(cluster) + kConeSlack;
        min_cosine2_ = (1 - sine * sine) * dot(axis_, axis_);
        const Box3 box = clusterBox(cluster, grid_step);
        const Double3 center = (widen(box.min) + widen(box.max)) * 0.5;
        const double back = coneBack(cluster, grid_step);
        apex_ = center - axis_ * (back / length(axis_));
        const double max_in_front = kApexSlack * (length(widen(box.max) - center) + back);
        max_in_front2_ = max_in_front * max_in_front;
    }

    /// True if a normal lies in the cone.
    /// normal   of any length > 0, whose square is length2
    bool containsNormal(Double3 normal, double length2) const
    {
        const double along = dot(normal, axis_);
        return along > 0 && along * along >= min_cosine2_ * length2;
    }

    /// True if the apex is not in front of the plane through `corner`; `normal` as above.
    bool isApexBehind(Double3 normal, double length2, Double3 corner) const
    {
        const double in_front = dot(normal, apex_ - corner);
        return in_front <= 0 || in_front * in_front <= max_in_front2_ * length2;
    }

private:
    Double3 axis_; ///< about unit length
    Double3 apex_;
    /// Times the squared length of the axis; below 0 for a cone wider than a half space.
    double min_cosine2_;
    double max_in_front2_; ///< square of a distance
};

} // namespace hearth::formats::check
