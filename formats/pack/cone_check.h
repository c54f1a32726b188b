// What the normal cone of a cluster asks of its triangles. Not for use outside formats/.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/codecs/cluster_bounds.h"
#include "formats/pack/pack_check.h"

namespace hearth::formats::check
{

/// In squares, with what is the cluster's worked out before: no root and no division for a triangle. Rounding moves neither
/// bound by more than 1e-11, of a sine and of what kApexSlack is measured in.
class ConeCheck
{
public:
    ConeCheck(const ClusterRecord& cluster, float grid_step) : axis_(widen(coneAxis(cluster)))
    {
        const double sine = coneCutoff(cluster) + kConeSlack;
        least_cosine2_ = (1 - sine * sine) * dot(axis_, axis_);
        const Box3 box = boxOf(cluster, grid_step);
        const Double3 center = (widen(box.min) + widen(box.max)) * 0.5;
        const double back = coneBack(cluster, grid_step);
        apex_ = center - axis_ * (back / length(axis_));
        const double most_in_front = kApexSlack * (length(widen(box.max) - center) + back);
        most_in_front2_ = most_in_front * most_in_front;
    }

    /// normal   of any length > 0, whose square is length2
    bool holds(Double3 normal, double length2) const
    {
        const double along = dot(normal, axis_);
        return along > 0 && along * along >= least_cosine2_ * length2;
    }

    /// Whether the apex is not in front of the plane through `corner`; `normal` as above.
    bool isBehind(Double3 normal, double length2, Double3 corner) const
    {
        const double in_front = dot(normal, apex_ - corner);
        return in_front <= 0 || in_front * in_front <= most_in_front2_ * length2;
    }

private:
    Double3 axis_; ///< of about unit length
    Double3 apex_;
    double
        least_cosine2_; ///< times the squared length of the axis; below 0 where the cone is a half space and more
    double most_in_front2_; ///< square of a distance
};

} // namespace hearth::formats::check
