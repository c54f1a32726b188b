// Small grids of blocks and single voxels, and rays that march through them as no scene would ask: for the tests of marches.
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

/// A few blocks and many single voxels; about `count` in all.
MarchScene randomScene(Cell voxels, uint32_t count, std::mt19937& random);

/// In voxels from the grid's origin.
struct MarchRay
{
    Float3 origin;
    Float3 direction;
    float far = shared::kBrickInfinity;
};

/// From near and far, from inside, from faces, edges and corners, through them and along them, nearly or exactly; one of eight
/// ends before long.
class MarchRays
{
public:
    /// Both must outlive it.
    MarchRays(const MarchScene& scene, std::mt19937& random) : scene_(scene), random_(random) {}

    MarchRay next();

private:
    MarchRay make();
    double uniform(double low, double high);
    Float3 inBox(double margin);
    Cell solidVoxel();
    Float3 inVoxel();
    /// A multiple of a half, on or beside a solid voxel.
    Float3 onLattice();
    Float3 onFace();
    Float3 direction();
    Float3 alongAxis();
    /// Components alike: their planes are met at once.
    Float3 alongLattice();
    float tiny();
    Float3 flattened(Float3 d, float along);
    MarchRay towards(Float3 from, Float3 to);

    const MarchScene& scene_;
    std::mt19937& random_;
};

} // namespace hearth::test
