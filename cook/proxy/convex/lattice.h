// Lattice that a surface is snapped to, whose points floats store exactly.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/convex/hull.h"
#include "cook/proxy/surface/surface.h"
#include "formats/base/double3.h"

namespace hearth::proxy
{

class Lattice
{
public:
    /// Make the lattice of a surface with a box that is not empty: its longest side has between 2^17 and 2^18
    /// steps, fewer only where floats that far from the origin are no finer. A quarter of
    /// kMaxLatticeCoordinate, so that hulls have room to grow.
    explicit Lattice(const Surface& surface);

    /// Return the length of a step in metres, a power of two.
    double step() const { return step_; }

    /// Return a position in steps, not rounded.
    Double3 fromPosition(Float3 position) const { return (widen(position) * (1 / step_)) - origin_; }

    /// Return a lattice point's position, exactly.
    Float3 toPosition(LatticePoint point) const
    {
        return narrow((origin_ + Double3{double(point.x), double(point.y), double(point.z)}) * step_);
    }

private:
    double step_ = 0;
    Double3 origin_; ///< steps from the origin of space to that of the lattice, whole
};

/// Return the nearest lattice point.
inline LatticePoint roundToLattice(Double3 place)
{
    return {static_cast<int32_t>(std::lround(place.x)), static_cast<int32_t>(std::lround(place.y)),
            static_cast<int32_t>(std::lround(place.z))};
}

} // namespace hearth::proxy
