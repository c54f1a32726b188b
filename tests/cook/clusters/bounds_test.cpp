// Tests that boxes, spheres and cones contain all they claim to the last bit, at any coordinates.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/bounds.h"
#include "formats/codecs/vertex_codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace
{

using namespace hearth;

double distance(Float3 a, Float3 b)
{
    const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
    return std::sqrt(x * x + y * y + z * z);
}

class Bounds : public testing::Test
{
protected:
    std::vector<Float3> points(size_t count, float offset, float size)
    {
        std::uniform_real_distribution<float> coordinate(offset - size, offset + size);
        std::vector<Float3> made(count);
        for (Float3& p : made)
            p = {coordinate(random_), coordinate(random_), coordinate(random_)};
        return made;
    }

    std::mt19937 random_{7};
};

// A compiler that does not round the centre to floats before the radius is measured fails about once in 200
// times.
TEST_F(Bounds, sphereOfPointsHoldsThem)
{
    for (const auto& [offset, size] :
         {std::pair{0.0f, 1.0f}, {1000.0f, 0.1f}, {-3e6f, 10.0f}, {0.0f, 1e-20f}, {0.0f, 1e18f}})
        for (const size_t count : {1u, 2u, 3u, 97u})
            for (int i = 0; i < 500; ++i)
            {
                const auto inside = points(count, offset, size);
                const Sphere sphere = clusters::sphereOfPoints(inside);
                for (const Float3 p : inside)
                    ASSERT_LE(distance(p, sphere.center), sphere.radius)
                        << count << " points around " << offset << " within " << size;
            }
}

TEST_F(Bounds, sphereOfPointsIsNearTheSmallest)
{
    for (int i = 0; i < 100; ++i)
    {
        auto inside = points(200, 0, 1);
        for (Float3& p : inside)
        {
            const auto length = static_cast<float>(distance(p, {}));
            p = {p.x / length, p.y / length, p.z / length};
        }
        EXPECT_LT(clusters::sphereOfPoints(inside).radius, 1.05f) << "200 points on the unit sphere";
    }
}

TEST_F(Bounds, sphereOfSpheresHoldsThem)
{
    std::uniform_real_distribution<float> radius(0, 0.5f);
    for (int i = 0; i < 2000; ++i)
    {
        std::vector<Sphere> inside;
        for (const Float3 p : points(1 + static_cast<size_t>(i % 9), 3, 2))
            inside.push_back({p, radius(random_)});
        const Sphere around = clusters::sphereOfSpheres(inside, inside.front());
        for (const Sphere& sphere : inside)
            ASSERT_LE(distance(sphere.center, around.center) + sphere.radius, around.radius);
    }
}

/// An eye for which the cone test says "all triangles are back-facing" sees no front face.
TEST_F(Bounds, conesHideNothingThatFacesTheEye)
{
    std::uniform_real_distribution<float> away(-4, 4);
    size_t hidden = 0;
    for (int i = 0; i < 400; ++i)
    {
        // dome of triangles that roughly face up
        std::vector<Float3> places;
        const auto jitter = points(90, 0, 0.3f);
        for (size_t t = 0; t < 30; ++t)
        {
            const Float3 at = jitter[t * 3];
            places.push_back(at);
            places.push_back({at.x + 0.2f, at.y, at.z + jitter[t * 3 + 1].z * 0.5f});
            places.push_back({at.x, at.y + 0.2f, at.z + jitter[t * 3 + 2].z * 0.5f});
        }
        const Float3 middle = points(1, 0, 0.3f).front();
        const auto cone = clusters::computeNormalCone(places, middle);
        if (cone.cutoff >= 1)
            continue;
        const Float3 axis = formats::NormalCode<8>::decode(cone.axis);
        for (int e = 0; e < 200; ++e)
        {
            const Float3 eye{away(random_), away(random_), away(random_)};
            const double x = middle.x - cone.back * axis.x - eye.x, y = middle.y - cone.back * axis.y - eye.y,
                         z = middle.z - cone.back * axis.z - eye.z;
            const double along = (x * axis.x + y * axis.y + z * axis.z) / std::sqrt(x * x + y * y + z * z);
            if (along < cone.cutoff)
                continue;
            ++hidden;
            for (size_t t = 0; t < places.size(); t += 3)
            {
                const Float3 a = places[t], b = places[t + 1], c = places[t + 2];
                const double ux = double{b.x} - a.x, uy = double{b.y} - a.y, uz = double{b.z} - a.z;
                const double vx = double{c.x} - a.x, vy = double{c.y} - a.y, vz = double{c.z} - a.z;
                const double facing = (uy * vz - uz * vy) * (double{eye.x} - a.x) +
                                      (uz * vx - ux * vz) * (double{eye.y} - a.y) +
                                      (ux * vy - uy * vx) * (double{eye.z} - a.z);
                ASSERT_LE(facing, 0) << "dome " << i << ", triangle " << t / 3;
            }
        }
    }
    EXPECT_GT(hidden, 1000u) << "the cones must hide something, else this test shows nothing";
}

} // namespace
