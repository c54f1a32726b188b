// Tightens the box of a cluster by branch and bound over pose regions, in which the motions of joints are
// correlated.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

#include <memory>

namespace hearth::skinning
{

/// Branch-and-bound search for the box of a cluster in joint `main` over all regions of poses. Splits regions
/// in which a vertex may leave the box of the sampled poses, the worst first, until none is left or the work
/// is spent. The box is a valid bound at any time.
class BoxSearch
{
public:
    /// Start a search.
    /// box                a valid bound
    /// cluster, vertices  are not needed afterwards
    BoxSearch(const animation_bounds::Box3d& box, uint32_t main, const DeformedCluster& cluster,
              const Deformation& deformation, std::span<const MorphedVertex> vertices);
    BoxSearch(BoxSearch&&) noexcept;
    BoxSearch& operator=(BoxSearch&&) noexcept;
    ~BoxSearch();

    /// True if the box is so much larger than the box of a few poses that tightening it may pay.
    bool isLoose() const;

    /// Examine regions. May be called again, with more work.
    /// max_work  limit: one unit for each influence of a vertex along one axis, about 10 ns
    /// returns    the work done
    size_t run(size_t max_work);

    /// True if more work makes no difference, or after giveUp.
    bool done() const;

    /// End the search. The box stays.
    void giveUp();

    /// Return the volume of the box relative to that of the sampled poses' box.
    double relativeVolume() const;

    /// Return the current box, inside the initial one.
    animation_bounds::Box3d box() const;

private:
    class Regions;
    std::unique_ptr<Regions> regions_;
};

} // namespace hearth::skinning
