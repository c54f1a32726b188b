// Tests the brick march against an exhaustive slab test in doubles over all solid voxels.
//
// A float ray may be off by a rounding of its largest coordinate. Shrink and grow each voxel by that much:
// the march must hit a voxel if the exact ray hits the shrunk one, and may hit it if the ray hits the grown
// one. No voxel that must be hit may be missed or reported late. A reported voxel must be one that may be
// hit, entered by a face through which it may be entered, at that distance.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/brick_codes.h"
#include "tests/support/march_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

namespace hearth::test
{

using namespace shared;

namespace
{

using Point = std::array<double, 3>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ------------------------------------------------------------------------------------------------ the oracle

/// Interval of a ray inside a box, along one axis or along all axes together.
struct Chord
{
    double in = -kInfinity;
    double out = kInfinity;

    /// A ray that only touches does not hit.
    bool met() const { return in < out; }
};

class Oracle
{
public:
    Oracle(const MarchScene& scene, const MarchRay& ray)
        : scene_(scene),
          origin_{double{ray.origin.x}, double{ray.origin.y}, double{ray.origin.z}},
          direction_{double{ray.direction.x}, double{ray.direction.y}, double{ray.direction.z}},
          far_(double{ray.far})
    {
        double largest = 0;
        for (size_t axis = 0; axis < 3; ++axis)
        {
            inverse_[axis] = 1 / direction_[axis];
            largest = std::max({largest, std::abs(origin_[axis]), static_cast<double>(scene.voxels[axis])});
        }
        slack_ = largest * 0x1p-21;
        slack_t_ = slack_ / length();
    }

    double slack() const { return slack_t_; }
    double far() const { return far_; }

    /// Interval inside a voxel whose faces are `grown` farther out, starting at the ray's origin.
    Chord chord(const Cell& cell, double grown) const
    {
        Chord chord{0, kInfinity};
        for (size_t axis = 0; axis < 3; ++axis)
        {
            const Chord along = slab(axis, cell[axis] - grown, cell[axis] + 1 + grown);
            chord.in = std::max(chord.in, along.in);
            chord.out = std::min(chord.out, along.out);
        }
        return chord;
    }
    Chord mostChord(const Cell& cell) const { return chord(cell, slack_); }
    Chord leastChord(const Cell& cell) const { return chord(cell, -slack_); }

    /// Entry distance of the first voxel that must be hit; infinity without one.
    double firstThatMustBe() const
    {
        double first = kInfinity;
        for (const Cell& cell : scene_.solid)
        {
            const Chord least = leastChord(cell);
            first = least.met() ? std::min(first, least.in) : first;
        }
        return first;
    }

    /// True if a voxel that may be hit may be entered by this face.
    bool mayEnterBy(const Cell& cell, uint32_t face) const
    {
        if (face == kNoFace)
        {
            bool inside = true;
            for (size_t axis = 0; axis < 3; ++axis)
                inside = inside && origin_[axis] >= cell[axis] - slack_ &&
                         origin_[axis] <= cell[axis] + 1 + slack_;
            return inside;
        }
        const size_t through = face / 2;
        if (direction_[through] == 0 || (face % 2 == 0) != (direction_[through] > 0))
            return false;
        const auto entersAt = [&](size_t axis, double earlier)
        {
            const bool up = direction_[axis] > 0;
            const double plane = up ? cell[axis] - earlier : cell[axis] + 1 + earlier;
            return direction_[axis] == 0 ? -kInfinity : (plane - origin_[axis]) * inverse_[axis];
        };
        double last = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            last = std::max(last, entersAt(axis, slack_));
        return entersAt(through, -slack_) >= last;
    }

    /// Number of voxels that a ray crosses or touches on its path through the grid up to t.
    double cellsCrossed(double t) const
    {
        double in = 0, out = t;
        for (size_t axis = 0; axis < 3; ++axis)
        {
            const Chord along = slab(axis, 0, scene_.voxels[axis]);
            in = std::max(in, along.in);
            out = std::min(out, along.out);
        }
        double cells = 1;
        for (size_t axis = 0; axis < 3; ++axis)
        {
            const double from = origin_[axis] + in * direction_[axis];
            const double to = origin_[axis] + out * direction_[axis];
            cells +=
                std::floor(std::max(from, to) + 2 * slack_) - std::floor(std::min(from, to) - 2 * slack_);
        }
        return cells;
    }

private:
    double length() const { return std::hypot(direction_[0], direction_[1], direction_[2]); }

    Chord slab(size_t axis, double low, double high) const
    {
        if (direction_[axis] == 0)
        {
            const bool inside = origin_[axis] > low && origin_[axis] < high;
            return inside ? Chord{} : Chord{kInfinity, -kInfinity};
        }
        const double a = (low - origin_[axis]) * inverse_[axis];
        const double b = (high - origin_[axis]) * inverse_[axis];
        return {std::min(a, b), std::max(a, b)};
    }

    const MarchScene& scene_;
    Point origin_;
    Point direction_;
    Point inverse_{};
    double far_;
    double slack_ = 0;   ///< voxels
    double slack_t_ = 0; ///< the same along the ray
};

Cell getCell(const BrickRay& ray)
{
    return {static_cast<uint32_t>(ray.x), static_cast<uint32_t>(ray.y), static_cast<uint32_t>(ray.z)};
}

/// Describe the error in the answer; nullopt if it is right.
std::optional<std::string> findFault(const MarchScene& scene, const MarchRay& ray, const BrickRay& found)
{
    const Oracle oracle(scene, ray);
    const double first = oracle.firstThatMustBe();
    const double end = found.inside ? double{found.start_t} + double{found.t} : oracle.far();
    if (found.steps > oracle.cellsCrossed(end + oracle.slack()))
        return "more steps than voxels crossed";
    if (!found.inside)
        return first < oracle.far() - oracle.slack() ? std::optional("misses a voxel") : std::nullopt;

    const Cell cell = getCell(found);
    if (!std::binary_search(scene.solid.begin(), scene.solid.end(), cell))
        return "the voxel is not solid";
    const Chord most = oracle.mostChord(cell), least = oracle.leastChord(cell);
    if (!most.met())
        return "the ray does not meet the voxel";
    if (first < most.in)
        return "comes late";
    const double t = double{found.start_t} + double{found.t};
    if (t < most.in - oracle.slack() || t > (least.met() ? least.in : most.out) + oracle.slack())
        return "enters the voxel elsewhere";
    if (t > oracle.far() + oracle.slack())
        return "goes too far";
    if (!oracle.mayEnterBy(cell, found.face))
        return "enters by another face";
    if (found.face == kNoFace && t != 0)
        return "starts inside, but not at once";
    return std::nullopt;
}

std::string describe(const MarchRay& ray, const BrickRay& found)
{
    std::ostringstream text;
    text.precision(9);
    text << "from " << ray.origin.x << " " << ray.origin.y << " " << ray.origin.z << " along "
         << ray.direction.x << " " << ray.direction.y << " " << ray.direction.z << " to " << ray.far
         << ": inside " << found.inside << " voxel " << found.x << " " << found.y << " " << found.z
         << " face " << int(found.face) << " t " << found.start_t << " + " << found.t << " steps "
         << found.steps;
    return text.str();
}

constexpr uint32_t kRays = 1000000;

} // namespace

TEST(BrickMarch, findsWhatAnExhaustiveSearchFinds)
{
    std::mt19937 random(1);
    constexpr Cell kGrids[] = {{40, 40, 40}, {5, 7, 9},    {64, 16, 32}, {1, 1, 1},
                               {100, 3, 50}, {17, 33, 15}, {4, 90, 4},   {23, 23, 23},
                               {48, 2, 2},   {31, 31, 65}, {16, 16, 16}, {12, 80, 30}};
    constexpr uint32_t kCounts[] = {1, 6, 25, 70, 150};
    constexpr uint32_t kScenes = 50;
    uint32_t hits = 0, ends = 0;
    for (uint32_t i = 0; i < kScenes; ++i)
    {
        const MarchScene scene =
            randomScene(kGrids[i % std::size(kGrids)], kCounts[i % std::size(kCounts)], random);
        const BrickMasks masks = scene.model.masks();
        MarchRays rays(scene, random);
        for (uint32_t r = 0; r < kRays / kScenes; ++r)
        {
            const MarchRay ray = rays.next();
            const BrickRay found =
                brickMarch(masks, brickRayInVoxels(masks.grid, ray.origin, ray.direction, ray.far));
            const auto fault = findFault(scene, ray, found);
            ASSERT_FALSE(fault) << *fault << " in scene " << i << ": " << describe(ray, found);
            hits += found.inside;
            ends += found.inside && found.face == kNoFace ? 1 : 0;
        }
    }
    // the rays must hit something often enough, and start inside often enough
    EXPECT_GT(hits, kRays / 4);
    EXPECT_GT(ends, kRays / 20);
}

TEST(BrickMarch, passesThroughAllThatTheRayMeets)
{
    std::mt19937 random(2);
    for (uint32_t i = 0; i < 20; ++i)
    {
        const MarchScene scene = randomScene({37, 20, 50}, 400, random);
        const BrickMasks masks = scene.model.masks();
        MarchRays rays(scene, random);
        for (uint32_t r = 0; r < 500; ++r)
        {
            const MarchRay ray = rays.next();
            const Oracle oracle(scene, ray);
            std::vector<Cell> met;
            float t = 0;
            for (BrickRay at =
                     brickMarch(masks, brickRayInVoxels(masks.grid, ray.origin, ray.direction, ray.far));
                 at.inside; at = brickMarch(masks, brickSkipVoxel(masks, at)))
            {
                met.push_back(getCell(at));
                EXPECT_TRUE(oracle.mostChord(met.back()).met()) << describe(ray, at);
                EXPECT_GE(at.t, t) << describe(ray, at);
                t = at.t;
                ASSERT_LE(met.size(), scene.solid.size());
            }
            std::sort(met.begin(), met.end());
            EXPECT_TRUE(std::adjacent_find(met.begin(), met.end()) == met.end());
            for (const Cell& cell : scene.solid)
            {
                const Chord least = oracle.leastChord(cell);
                const bool must_be = least.met() && least.in < oracle.far() - oracle.slack();
                EXPECT_TRUE(!must_be || std::binary_search(met.begin(), met.end(), cell))
                    << cell[0] << " " << cell[1] << " " << cell[2];
            }
        }
    }
}

TEST(BrickMarch, endsWhateverTheRayIs)
{
    std::mt19937 random(3);
    const MarchScene scene = randomScene({50, 20, 33}, 40, random);
    const BrickMasks masks = scene.model.masks();
    for (uint32_t i = 0; i < 100000; ++i)
    {
        MarchRay ray;
        for (int axis = 0; axis < 3; ++axis)
        {
            const float any = std::bit_cast<float>(static_cast<uint32_t>(random()));
            ray.direction[axis] = std::isfinite(any) ? any : 0;
            ray.origin[axis] = static_cast<float>(random() % 60) - 5;
        }
        const BrickRay found =
            brickMarch(masks, brickRayInVoxels(masks.grid, ray.origin, ray.direction, kBrickInfinity));
        ASSERT_LE(found.steps, 50u + 20 + 33) << describe(ray, found);
    }
}

TEST(BrickMarch, letsNothingThroughBetweenVoxelsWithACommonEdge)
{
    // a slanted wall without thickness: voxels x = y, neighbours share only an edge
    const BrickModel wall = brickModel({48, 48, 4}, [](uint32_t x, uint32_t y, uint32_t) { return x == y; });
    const BrickMasks masks = wall.masks();
    std::mt19937 random(4);
    const auto place = [&] { return 2 + static_cast<float>(random() % 177) * 0.25f; };
    for (uint32_t i = 0; i < 100000; ++i)
    {
        const float x = place(), y = place(), to_x = place(), to_y = place();
        const bool crosses = (x < y - 1 && to_x > to_y + 1) || (x > y + 1 && to_x < to_y - 1);
        if (!crosses)
            continue;
        const Float3 from{x, y, 2}, way{to_x - x, to_y - y, 0.25f * static_cast<float>(random() % 3)};
        const float size = length(way);
        const BrickRay found = brickMarch(masks, brickRayInVoxels(masks.grid, from, way / size, size));
        ASSERT_TRUE(found.inside) << describe({from, way / size, size}, found);
    }
}

namespace
{

BrickRay marchIn(const BrickModel& model, Float3 origin, Float3 direction, float far = kBrickInfinity)
{
    const BrickMasks masks = model.masks();
    return brickMarch(masks, brickRay(masks.grid, origin, direction, far));
}

} // namespace

TEST(BrickMarch, measuresInMetresFromTheGridsOrigin)
{
    BrickModel model = brickModel({20, 20, 20}, [](uint32_t x, uint32_t, uint32_t) { return x == 17; });
    model.grid.origin = {-8, 100, 4};
    model.grid.voxel_size = 0.5f;
    const BrickRay found = marchIn(model, {-10, 105, 8}, {1, 0, 0});
    ASSERT_TRUE(found.inside);
    EXPECT_EQ(getCell(found), (Cell{17, 10, 8}));
    EXPECT_EQ(found.face, 0u);
    EXPECT_EQ(brickDistance(model.masks().grid, found), 2 + 17 * 0.5f);
    EXPECT_TRUE(marchIn(model, {-10, 105, 8}, {1, 0, 0}, 10.51f).inside);
    EXPECT_FALSE(marchIn(model, {-10, 105, 8}, {1, 0, 0}, 10.5f).inside);
}

TEST(BrickMarch, takesAFaceForWhatLiesBehindIt)
{
    const BrickModel model =
        brickModel({8, 8, 8}, [](uint32_t x, uint32_t y, uint32_t z) { return x == 3 && y == 3 && z == 3; });
    // into the voxel: hits at once, by that face
    BrickRay found = marchIn(model, {3, 3.5f, 3.5f}, {1, 0, 0});
    EXPECT_TRUE(found.inside && found.face == 0 && found.t == 0);
    found = marchIn(model, {3.5f, 4, 3.5f}, {0, -1, 0});
    EXPECT_TRUE(found.inside && found.face == 3 && found.t == 0);
    // away from it: no hit
    EXPECT_FALSE(marchIn(model, {4, 3.5f, 3.5f}, {1, 0, 0}).inside);
    EXPECT_FALSE(marchIn(model, {3.5f, 3.5f, 3}, {0, 0, -1}).inside);
    // along it: hits the voxel above
    EXPECT_TRUE(marchIn(model, {3, 0, 3.5f}, {0, 1, 0}).inside);
    EXPECT_FALSE(marchIn(model, {4, 0, 3.5f}, {0, 1, 0}).inside);
    found = marchIn(model, {3.25f, 3.5f, 3.5f}, {1, 0, 0});
    EXPECT_TRUE(found.inside && found.face == kNoFace && found.t == 0);
}

TEST(BrickMarch, findsTheFaceOfAVoxel)
{
    std::mt19937 random(5);
    const MarchScene scene = randomScene({20, 20, 20}, 1500, random);
    const BrickMasks masks = scene.model.masks();
    uint32_t faces = 0, voxels = 0;
    for (const Brick& brick : masks.bricks)
        for (uint32_t face = 0; face < kVoxelFaces; ++face)
            for (uint32_t bit = 0; bit < 64; ++bit)
            {
                const bool is_solid = maskHas(brick.voxel_mask_low, brick.voxel_mask_high, bit);
                voxels += face == 0 && is_solid ? 1u : 0u;
                const uint32_t index = brickFace(brick, bit, face);
                if (index == kNoFace)
                    continue;
                // in order, none missing, with the normal of the face
                ASSERT_EQ(index, faces++);
                const Float3 normal = decodeFaceNormal(scene.model.normals[index]);
                EXPECT_EQ(normal[static_cast<int>(face / 2)], face % 2 != 0 ? 1 : -1);
                EXPECT_LT(brickVoxel(brick, bit), scene.solid.size());
            }
    EXPECT_EQ(faces, scene.model.albedo.size());
    EXPECT_EQ(voxels, scene.solid.size());
    EXPECT_EQ(brickFace(masks.bricks[0], 0, kNoFace), kNoFace);
}

} // namespace hearth::test
