// A tighter box of a cluster where joints that move together make much of what they could do apart impossible.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"

#include <memory>

namespace hearth::skinning
{

/// The box of the cluster in joint `main` over all regions of poses: those in which a vertex may get farther out than in
/// the poses that were looked at are cut in halves, the worst first, until none is left or the work is done. It holds in
/// any case.
class BoxSearch
{
public:
    /// box  that holds already
    /// cluster, vertices  are not needed afterwards
    BoxSearch(const motion::Box3d& box, uint32_t main, const DeformedCluster& cluster,
              const Deformation& deformation, std::span<const MorphedVertex> vertices);
    BoxSearch(BoxSearch&&) noexcept;
    BoxSearch& operator=(BoxSearch&&) noexcept;
    ~BoxSearch();

    /// Whether the box is so much larger than what the cluster reaches in a few poses that tightening it may pay.
    bool isLoose() const;

    /// Look at regions; may be called again, with more work.
    /// most_work  one for each influence of a vertex that is looked at, about 50 ns
    /// returns    how much was done
    size_t run(size_t most_work);

    /// Whether more work makes no difference.
    bool done() const;

    /// Inside of the one that held already.
    motion::Box3d box() const;

private:
    class Regions;
    std::unique_ptr<Regions> regions_;
};

} // namespace hearth::skinning
