// Small grids of blocks and single voxels, and difficult rays through them, for tests of ray marching.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/brick_model.h"

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace hearth::test
{

using Cell = std::array<uint32_t, 3>;

struct MarchScene
{
    Cell voxels{};
    std::vector<Cell> solid; ///< sorted
    BrickModel model;
};

/// Make a grid of a few blocks and many single voxels; about `count` in all.
MarchScene randomScene(Cell voxels, uint32_t count, std::mt19937& random);

/// Ray in voxels from the grid's origin.
struct MarchRay
{
    Float3 origin;
    Float3 direction;
    float far = shared::kBrickInfinity;
};

/// Random rays from near and far, from inside, from faces, edges and corners, through them and along them,
/// nearly or exactly. One of eight has a short range.
class MarchRays
{
public:
    /// Both must outlive the object.
    MarchRays(const MarchScene& scene, std::mt19937& random) : scene_(scene), random_(random) {}

    MarchRay next();

private:
    MarchRay make();
    double uniform(double low, double high);
    Float3 inBox(double margin);
    Cell solidVoxel();
    Float3 inVoxel();
    /// Return a point whose coordinates are multiples of a half, on or beside a solid voxel.
    Float3 onLattice();
    Float3 onFace();
    Float3 direction();
    Float3 alongAxis();
    /// Return a direction with equal components: it crosses several planes at once.
    Float3 alongLattice();
    float tiny();
    Float3 flattened(Float3 d, float along);
    MarchRay towards(Float3 from, Float3 to);

    const MarchScene& scene_;
    std::mt19937& random_;
};

} // namespace hearth::test
