// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/march_rays.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace hearth::test
{

using namespace shared;

namespace
{

MarchScene makeScene(Cell voxels, std::vector<Cell> solid)
{
    MarchScene scene{voxels, std::move(solid), {}};
    std::vector<uint8_t> filled(size_t{voxels[0]} * voxels[1] * voxels[2]);
    const auto at = [&](uint32_t x, uint32_t y, uint32_t z)
    { return x + size_t{voxels[0]} * (y + size_t{voxels[1]} * z); };
    for (const Cell& cell : scene.solid)
        filled[at(cell[0], cell[1], cell[2])] = 1;
    scene.model =
        brickModel(voxels, [&](uint32_t x, uint32_t y, uint32_t z) { return filled[at(x, y, z)] != 0; });
    return scene;
}

} // namespace

MarchScene randomScene(Cell voxels, uint32_t count, std::mt19937& random)
{
    std::vector<Cell> solid;
    while (solid.size() < count)
    {
        Cell cell{};
        for (size_t axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<uint32_t>(random() % voxels[axis]);
        const uint32_t block = random() % 8 == 0 ? 1 + static_cast<uint32_t>(random() % 3) : 1;
        for (uint32_t i = 0; i < block * block * block; ++i)
        {
            const Cell part{cell[0] + i % block, cell[1] + i / block % block, cell[2] + i / block / block};
            if (part[0] < voxels[0] && part[1] < voxels[1] && part[2] < voxels[2])
                solid.push_back(part);
        }
    }
    std::sort(solid.begin(), solid.end());
    solid.erase(std::unique(solid.begin(), solid.end()), solid.end());
    return makeScene(voxels, std::move(solid));
}

MarchRay MarchRays::next()
{
    MarchRay ray = make();
    if (random_() % 8 == 0)
        ray.far = static_cast<float>(uniform(0.1, 60));
    return ray;
}

MarchRay MarchRays::make()
{
    switch (random_() % 10)
    {
    case 0:
        return {inBox(0), direction()};
    case 1:
        return towards(inBox(40), inBox(0));
    case 2:
        return towards(inBox(20000), inBox(0));
    case 3: // from inside a solid voxel
        return {inVoxel(), direction()};
    case 4: // through corners, edges and the middles of faces exactly
        return {onLattice(), alongLattice()};
    case 5: // from a face, the ray along it or not
        return {onFace(), flattened(direction(), 0)};
    case 6: // along one plane or two, nearly or wholly
        return {random_() % 2 == 0 ? inBox(10) : onFace(), flattened(direction(), tiny())};
    case 7: // along an axis
        return {random_() % 2 == 0 ? inBox(3) : onLattice(), alongAxis()};
    case 8: // towards a corner or an edge's middle
        return towards(inBox(20), onLattice());
    default: // from one corner to another
        return towards(onLattice(), onLattice());
    }
}

double MarchRays::uniform(double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(random_);
}

Float3 MarchRays::inBox(double margin)
{
    Float3 p;
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = static_cast<float>(uniform(-margin, scene_.voxels[static_cast<size_t>(axis)] + margin));
    return p;
}

Cell MarchRays::solidVoxel()
{
    return scene_.solid[random_() % scene_.solid.size()];
}

Float3 MarchRays::inVoxel()
{
    const Cell cell = solidVoxel();
    Float3 p;
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = static_cast<float>(cell[static_cast<size_t>(axis)] + uniform(0, 1));
    return p;
}

Float3 MarchRays::onLattice()
{
    const Cell cell = solidVoxel();
    Float3 p;
    for (int axis = 0; axis < 3; ++axis)
        p[axis] = static_cast<float>(cell[static_cast<size_t>(axis)]) +
                  0.5f * static_cast<float>(random_() % 10) - 2;
    return p;
}

Float3 MarchRays::onFace()
{
    Float3 p = inVoxel();
    const int axis = static_cast<int>(random_() % 3);
    p[axis] = std::floor(p[axis]) + static_cast<float>(random_() % 2);
    return p;
}

Float3 MarchRays::direction()
{
    const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
            static_cast<float>(z)};
}

Float3 MarchRays::alongAxis()
{
    Float3 d{random_() % 2 == 0 ? 0.0f : -0.0f, random_() % 2 == 0 ? 0.0f : -0.0f, 0};
    d[static_cast<int>(random_() % 3)] = random_() % 2 == 0 ? 1.0f : -1.0f;
    return d;
}

Float3 MarchRays::alongLattice()
{
    Float3 d;
    for (int axis = 0; axis < 3; ++axis)
        d[axis] = static_cast<float>(random_() % 3) - 1;
    const float size = length(d);
    return size > 0 ? d / size : alongAxis();
}

float MarchRays::tiny()
{
    constexpr float kTiny[] = {1e-6f,  1e-12f, 1e-20f, 1e-30f,  1.1754944e-38f, 1e-42f,
                               1e-45f, 0.0f,   -1e-7f, -1e-25f, -1e-41f,        -0.0f};
    return kTiny[random_() % std::size(kTiny)];
}

Float3 MarchRays::flattened(Float3 d, float along)
{
    d[static_cast<int>(random_() % 3)] = along;
    const float size = length(d);
    return size > 1e-3f ? Float3{d.x / size, d.y / size, d.z / size} : alongAxis();
}

MarchRay MarchRays::towards(Float3 from, Float3 to)
{
    const Float3 d = to - from;
    const float size = length(d);
    return {from, size > 1e-3f ? d / size : alongAxis()};
}

} // namespace hearth::test
