// Tests the check of normal cones, which compares squares, against its definition by angles and distances.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/cone_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Amount by which a triangle exceeds a bound: accepted up to 0.
struct Beyond
{
    double sine; ///< of the angle between normal and axis; or the amount by which the normal faces backwards
    double in_front; ///< of the apex, over half the diagonal of the box + its distance from the centre
};

/// Definition in FORMAT.md.
Beyond beyond(const ClusterRecord& cluster, float grid_step, Double3 any_normal, Double3 corner)
{
    const double area = length(any_normal);
    const Double3 normal{any_normal.x / area, any_normal.y / area, any_normal.z / area};
    const Double3 axis = widen(coneAxis(cluster));
    const double sine = length(cross(normal, axis)) / length(axis);
    const Box3 box = clusterBox(cluster, grid_step);
    const Double3 center = (widen(box.min) + widen(box.max)) * 0.5;
    const double back = coneBack(cluster, grid_step);
    const double reach = length(widen(box.max) - center) + back;
    const Double3 apex = center - axis * (back / length(axis));
    return {std::max(sine - (coneCutoff(cluster) + kConeSlack), -dot(normal, axis)),
            dot(normal, apex - corner) / reach - kApexSlack};
}

/// Clusters of all sizes, and triangles whose normals and planes are near their bounds.
class RandomClusters
{
public:
    ClusterRecord cluster()
    {
        ClusterRecord cluster{};
        cluster.extent_shift =
            static_cast<uint8_t>(random_() % 3 == 0 ? random_() % (kMaxExtentShift + 1) : 0);
        for (int axis = 0; axis < 3; ++axis)
        {
            cluster.base[axis] = static_cast<int32_t>(random_() % 65536) - 32768;
            cluster.extent[axis] = static_cast<uint16_t>(1 + random_() % (random_() % 2 == 0 ? 100 : 65535));
        }
        const auto code = [&] { return static_cast<int32_t>(random_() % 255) - 127; };
        const int32_t x = code();
        cluster.cone_axis = static_cast<uint16_t>(NormalCode<8>::pack(x, code()));
        // narrow cones, cones near a half space, and arbitrary ones
        const auto kind = static_cast<uint32_t>(random_() % 4);
        const auto cutoff = static_cast<uint32_t>(random_() % (kind == 0 ? 50 : kNoCone));
        cluster.cone_cutoff = static_cast<uint16_t>(kind == 1 ? kNoCone - 1 - cutoff % 50 : cutoff);
        cluster.cone_back = static_cast<uint16_t>(random_() % (random_() % 2 == 0 ? 50 : 65536));
        return cluster;
    }

    /// Normal near the cone's angle from its axis.
    Double3 normal(const ClusterRecord& cluster)
    {
        const Double3 axis = widen(coneAxis(cluster));
        Double3 beside = cross(axis, direction());
        beside = beside * (1 / length(beside));
        const double sine = coneCutoff(cluster) + kConeSlack + offset();
        const double most = std::clamp(sine, 0.0, 1.0);
        const double side = random_() % 50 == 0 ? -1 : 1;
        const Double3 unit = axis * (side * std::sqrt(1 - most * most) / length(axis)) + beside * most;
        return unit * std::ldexp(1 + uniform(), static_cast<int>(random_() % 80) - 40);
    }

    /// Corner near the plane through the apex, or anywhere in the box.
    Double3 corner(const ClusterRecord& cluster, float grid_step, Double3 normal)
    {
        const Box3 box = clusterBox(cluster, grid_step);
        const Double3 low = widen(box.min), size = widen(box.max) - low;
        Double3 corner{low.x + size.x * uniform(), low.y + size.y * uniform(), low.z + size.z * uniform()};
        if (random_() % 2 == 0)
            return corner;
        const double now = beyond(cluster, grid_step, normal, corner).in_front;
        const double reach = length(size) * 0.5 + coneBack(cluster, grid_step);
        return corner + normal * ((now + offset()) * reach / length(normal));
    }

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

private:
    /// Offset of either sign, of magnitudes from 1e-14 to 1.
    double offset()
    {
        const double size = std::pow(10.0, -14 * uniform());
        return random_() % 2 == 0 ? size : -size;
    }

    Double3 direction() { return {uniform() - 0.5, uniform() - 0.5, uniform() - 0.5}; }

    std::mt19937 random_{1};
};

/// Numbers of accepted and rejected triangles, and of triangles close to the bound.
struct Counts
{
    uint32_t accepted = 0, refused = 0, close = 0;

    void add(double beyond, bool accepted_now)
    {
        constexpr double kRounding = 1e-11;
        (accepted_now ? accepted : refused) += 1;
        close += std::abs(beyond) < 1e-8 ? 1u : 0u;
        if (std::abs(beyond) > kRounding)
        {
            EXPECT_EQ(accepted_now, beyond < 0) << beyond;
        }
    }
};

} // namespace

TEST(ConeCheck, isTheDefinitionButForRounding)
{
    RandomClusters random;
    Counts cones, apexes;
    for (int i = 0; i < 20000; ++i)
    {
        const ClusterRecord cluster = random.cluster();
        const auto grid_step =
            static_cast<float>(std::ldexp(1.0, static_cast<int>(40 * random.uniform()) - 30));
        const check::ConeCheck check(cluster, grid_step);
        for (int t = 0; t < 8; ++t)
        {
            const Double3 normal = random.normal(cluster);
            const Double3 corner = random.corner(cluster, grid_step, normal);
            const Beyond expected = beyond(cluster, grid_step, normal, corner);
            cones.add(expected.sine, check.containsNormal(normal, dot(normal, normal)));
            apexes.add(expected.in_front, check.isApexBehind(normal, dot(normal, normal), corner));
        }
    }
    for (const Counts& counts : {cones, apexes})
    {
        EXPECT_GT(counts.accepted, 10000u);
        EXPECT_GT(counts.refused, 10000u);
        EXPECT_GT(counts.close, 1000u);
    }
}

TEST(ConeCheck, keepsItsBoundsOnTheFinestAndTheCoarsestGrid)
{
    // squares of squared lengths stay within the range of doubles
    ClusterRecord cluster{};
    std::fill(std::begin(cluster.extent), std::end(cluster.extent), uint16_t{1});
    cluster.cone_axis = static_cast<uint16_t>(NormalCode<8>::pack(0, 0));
    cluster.cone_cutoff = 6554; // a sine of 0.1
    for (const int exponent : {-149, 103})
    {
        const double step = std::ldexp(1.0, exponent);
        const check::ConeCheck check(cluster, static_cast<float>(step));
        for (const double sine : {0.0, 0.05, 0.0999, 0.1003, 0.5})
        {
            const Double3 normal = Double3{sine, 0, std::sqrt(1 - sine * sine)} * (step * step);
            EXPECT_EQ(check.containsNormal(normal, dot(normal, normal)), sine < 0.1002)
                << exponent << ", " << sine;
            const Double3 middle{step / 2, step / 2, step / 2};
            EXPECT_TRUE(check.isApexBehind(normal, dot(normal, normal), middle));
            EXPECT_FALSE(check.isApexBehind(normal, dot(normal, normal), {step / 2, step / 2, 0}));
        }
    }
}

} // namespace hearth::test
