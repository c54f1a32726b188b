// Tests the normals of the source behind rounded ones, and moments that are turned with a normal.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/scene/source_normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hearth::visibility
{
namespace
{

using formats::decodeNormal;
using formats::encodeNormal;
using formats::kVertexNormal;
using formats::kVertexNormal16;

constexpr float kStep = 0.25f;
constexpr float kFine = 1e-4f; ///< rounding to 2 x 16 bits, radians

Float3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return normalizeOr({normal(random), normal(random), normal(random)}, {0, 0, 1});
}

Float3 rounded(Float3 normal)
{
    return decodeNormal(kVertexNormal, encodeNormal(kVertexNormal, normal));
}

/// Return a direction with the same code, rotated a little.
Float3 neighbour(Float3 normal, std::mt19937& random)
{
    for (;;)
    {
        const Float3 other = normalizeOr(normal + randomDirection(random) * 0.004f, normal);
        if (rounded(other) == rounded(normal) && length(other - normal) > 0.002f)
            return other;
    }
}

TEST(SourceNormals, areFoundByTheGridPositionAndTheRoundedNormal)
{
    std::mt19937 random(1);
    std::vector<Float3> positions, on_grid, normals;
    for (int v = 0; v < 3000; ++v)
    {
        const auto coordinate = [&] { return static_cast<float>(static_cast<int>(random() % 41) - 20); };
        on_grid.push_back(Float3{coordinate(), coordinate(), coordinate()} * kStep);
        positions.push_back(on_grid.back() + randomDirection(random) * (kStep * 0.4f));
        normals.push_back(randomDirection(random));
    }
    // directions on edges of the octahedral square, which have two codes
    normals[0] = {0, 0, -1};
    normals[1] = normalizeOr({0.6f, 0, -0.8f}, {});
    normals[2] = normalizeOr({0, -0.6f, -0.8f}, {});
    const SourceNormals source(positions, normals, kVertexNormal, kStep);
    size_t improved = 0;
    for (size_t v = 0; v < positions.size(); ++v)
    {
        const Float3 found = source.find(on_grid[v], rounded(normals[v]));
        EXPECT_LT(length(found - normals[v]), kFine) << v;
        improved += length(rounded(normals[v]) - normals[v]) > 10 * kFine ? 1 : 0;
    }
    EXPECT_GT(improved, 2500u) << "rounding must be worth undoing";
}

TEST(SourceNormals, ofOnePlaceAreTheMean)
{
    std::mt19937 random(2);
    const Float3 first = randomDirection(random), second = neighbour(first, random);
    const SourceNormals source(std::vector<Float3>(2), std::vector{first, second}, kVertexNormal, kStep);
    EXPECT_LT(length(source.find({}, rounded(first)) - normalizeOr(first + second, {})), kFine);
}

TEST(SourceNormals, ofAVertexThatTheSourceLacksAreThoseWithItsCode)
{
    std::mt19937 random(3);
    const Float3 first = randomDirection(random), second = neighbour(first, random);
    const std::vector<Float3> positions{{1, 0, 0}, {2, 0, 0}};
    const SourceNormals source(positions, std::vector{first, second}, kVertexNormal, kStep);
    EXPECT_LT(length(source.find({1.5f, 0, 0}, rounded(first)) - normalizeOr(first + second, {})), kFine);
    const Float3 other = rounded(first * -1.0f);
    EXPECT_EQ(source.find({1, 0, 0}, other), other) << "a code that the source lacks";
}

TEST(SourceNormals, areNotKeptOfNormalsOf16Bits)
{
    const Float3 normal = normalizeOr({1, 2, 3}, {});
    const SourceNormals source(std::vector<Float3>(1), std::vector{normal}, kVertexNormal | kVertexNormal16,
                               kStep);
    EXPECT_EQ(source.find({}, {0, 0, 1}), (Float3{0, 0, 1}));
    EXPECT_EQ(SourceNormals({}, {}, kVertexNormal, 0).find({}, normal), normal) << "a mesh without vertices";
}

TEST(TurnWithNormal, keepsLengthsAndAnglesWithTheNormal)
{
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i)
    {
        const Float3 from = randomDirection(random), to = rounded(from);
        const Float3 v = randomDirection(random) * 3.0f, turned = turnWithNormal(v, from, to);
        EXPECT_NEAR(length(turned), length(v), 2e-6f);
        EXPECT_NEAR(dot(turned, to), dot(v, from), 3e-6f);
        EXPECT_LT(length(turned - v), 3 * 1.0001f * length(to - from)) << "no more than the normal";
        EXPECT_LT(length(turnWithNormal(from, from, to) - to), 5e-7f);
        EXPECT_EQ(turnWithNormal(v, from, from), v);
    }
}

} // namespace
} // namespace hearth::visibility
