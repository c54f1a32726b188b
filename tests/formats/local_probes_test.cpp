// Tests weights, parallax and the atlas of local probes beside plain loops over points and texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/local_probes.h"

#include "formats/texels/shared_exponent.h"

#include <gtest/gtest.h>

#include <random>

namespace hearth::shared
{
namespace
{

using formats::ProbeRecord;

LocalProbe makeProbe()
{
    LocalProbe probe{};
    probe.position = {1, 1, -0.5f};
    probe.irradiance_red = probe.irradiance_green = probe.irradiance_blue = 1;
    probe.box_min = {-2, 0, -2.5f};
    probe.box_max = {2, 3, 2.5f};
    probe.fade = 0.25f;
    probe.influence_min = {-2.25f, -0.25f, -2.75f};
    probe.influence_max = {2.25f, 3.25f, 2.75f};
    return probe;
}

Float3 randomPoint(std::mt19937& random, Float3 low, Float3 high)
{
    std::uniform_real_distribution<float> share(0, 1);
    const auto pick = [&](float a, float b) { return a + (b - a) * share(random); };
    return {pick(low.x, high.x), pick(low.y, high.y), pick(low.z, high.z)};
}

Float3 randomDirection(std::mt19937& random)
{
    for (;;)
        if (const Float3 p = randomPoint(random, {-1, -1, -1}, {1, 1, 1}); length(p) > 0.1f && length(p) < 1)
            return p / length(p);
}

/// Probe of the mips of two sides, 8 and 4, and one of the same with other colours.
struct Atlas
{
    std::vector<ProbeRecord> records;
    std::vector<uint32_t> texels;
    ProbeAtlas image;
};

Atlas makeAtlas()
{
    Atlas atlas;
    for (uint32_t number = 0; number < 2; ++number)
    {
        ProbeRecord record{};
        record.flags = formats::kProbeIsLocal;
        record.face_size = 8;
        record.mip_count = 3;
        record.texels = {static_cast<uint32_t>(atlas.texels.size()), 6 * (64 + 16 + 4)};
        for (uint32_t i = 0; i < record.texels.count; ++i)
            atlas.texels.push_back(16u << 27 | (number + 1) << 18 | i);
        atlas.records.push_back(record);
    }
    atlas.image = makeProbeAtlas(atlas.records, atlas.texels);
    return atlas;
}

/// Return the number of the texel of a probe in which a direction lies, by loops over all texels'
/// corners.
uint32_t findTexelSlowly(Float3 d, uint32_t side)
{
    const Float3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const Float3 rights[6] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
    const Float3 downs[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    for (uint32_t face = 0; face < 6; ++face)
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x)
            {
                const float depth = dot(d, axes[face]);
                const float a = dot(d, rights[face]) / depth, b = dot(d, downs[face]) / depth;
                const auto edge = [&](uint32_t i)
                { return 2 * static_cast<float>(i) / static_cast<float>(side) - 1; };
                if (depth > 0 && a >= edge(x) && a <= edge(x + 1) && b >= edge(y) && b <= edge(y + 1))
                    return (face * side + y) * side + x;
            }
    ADD_FAILURE();
    return 0;
}

} // namespace

TEST(LocalProbe, lightsNothingOutsideOfItsBoxOfInfluence)
{
    const LocalProbe probe = makeProbe();
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i)
    {
        const Float3 p = randomPoint(random, {-4, -2, -4}, {4, 5, 4});
        const float weight = localProbeWeight(probe, p);
        bool is_in_influence = true, is_in_box = true;
        for (int axis = 0; axis < 3; ++axis)
        {
            is_in_influence =
                is_in_influence && p[axis] > probe.influence_min[axis] && p[axis] < probe.influence_max[axis];
            is_in_box = is_in_box && p[axis] >= probe.box_min[axis] && p[axis] <= probe.box_max[axis];
        }
        ASSERT_EQ(weight > 0, is_in_influence);
        ASSERT_LE(weight, 1);
        if (is_in_box)
            ASSERT_NEAR(weight, 1, 1e-5f);
    }
    EXPECT_NEAR(localProbeWeight(probe, {0, 3.125f, 0}), 0.5f, 1e-5f);
}

TEST(LocalProbe, seesThePointWhereARayLeavesTheBox)
{
    const LocalProbe probe = makeProbe();
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i)
    {
        const Float3 p = randomPoint(random, probe.box_min, probe.box_max), d = randomDirection(random);
        Float3 at = p; // by steps
        const auto is_inside = [&](Float3 q)
        {
            return q.x > probe.box_min.x && q.x < probe.box_max.x && q.y > probe.box_min.y &&
                   q.y < probe.box_max.y && q.z > probe.box_min.z && q.z < probe.box_max.z;
        };
        for (int step = 1; is_inside(at); ++step)
            at = p + d * (0.002f * static_cast<float>(step));
        const Float3 found = probe.position + correctParallax(probe, p, d);
        ASSERT_LT(length(found - at), 0.004f);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
        Float3 along;
        along[axis] = -1;
        const Float3 found = probe.position + correctParallax(probe, {0.5f, 2, 1}, along);
        EXPECT_NEAR(found[axis], probe.box_min[axis], 1e-5f);
    }
}

TEST(LocalProbe, factorIsTheLightOverTheProbesOwn)
{
    EXPECT_EQ(localProbeFactor(3, 0.5f), 6);
    EXPECT_EQ(localProbeFactor(3, 1.0f / 64), 48) << "no more than 16 times the light";
}

TEST(ProbeAtlas, hasTheTexelOfEachDirection)
{
    const Atlas atlas = makeAtlas();
    const LocalProbes probes = makeLocalProbes(atlas.records);
    ASSERT_EQ(probes.tables.size(), 2u);
    std::mt19937 random(3);
    for (int i = 0; i < 3000; ++i)
    {
        const Float3 d = randomDirection(random);
        const CubePlace place = findCubePlace(d * 3);
        uint32_t first = 0;
        for (uint32_t mip = 0; mip < 3; ++mip)
        {
            const uint32_t side = 8u >> mip;
            for (const uint32_t number : {0u, 1u})
            {
                const Float2 at = probeAtlasPoint(place, 8, mip, probes.tables[number].probe.atlas_row);
                const auto x = static_cast<size_t>(at.x), y = static_cast<size_t>(at.y);
                const uint32_t word = atlas.image.texels.at(y * atlas.image.width + x);
                ASSERT_EQ(word, 16u << 27 | (number + 1) << 18 | (first + findTexelSlowly(d, side)));
            }
            first += 6 * side * side;
        }
    }
}

TEST(ProbeAtlas, hasNoSeamsBetweenFaces)
{
    // a smooth colour of the direction, looked up on both sides of each edge
    ProbeRecord record{};
    record.flags = formats::kProbeIsLocal;
    record.face_size = 32;
    record.mip_count = 2;
    std::vector<uint32_t> texels;
    for (const uint32_t side : {32u, 16u})
        for (uint32_t i = 0; i < 6 * side * side; ++i)
        {
            const float a = (2 * static_cast<float>(i % side) + 1) / static_cast<float>(side) - 1;
            const float b = (2 * static_cast<float>(i / side % side) + 1) / static_cast<float>(side) - 1;
            const Float3 directions[6] = {{1, -b, -a}, {-1, -b, a}, {a, 1, b},
                                          {a, -1, -b}, {a, -b, 1},  {-a, -b, -1}};
            const Float3 d = directions[i / (side * side)];
            const Float3 unit = d / length(d);
            texels.push_back(formats::encodeSharedExponent({1.0 + unit.x, 1.0 + unit.y, 1.0 + unit.z}));
        }
    record.texels = {0, static_cast<uint32_t>(texels.size())};
    const ProbeAtlas atlas = makeProbeAtlas({&record, 1}, texels);
    const auto texel = [&](int x, int y)
    {
        return formats::decodeSharedExponent(
            atlas.texels.at(static_cast<size_t>(y) * atlas.width + static_cast<size_t>(x)));
    };
    std::mt19937 random(4);
    for (int i = 0; i < 20000; ++i)
    {
        const Float3 d = randomDirection(random);
        for (const uint32_t mip : {0u, 1u})
        {
            const Float2 at = probeAtlasPoint(findCubePlace(d), 32, mip, 0);
            const float left = std::floor(at.x - 0.5f), top = std::floor(at.y - 0.5f);
            const float u = at.x - 0.5f - left, v = at.y - 0.5f - top;
            const int x = static_cast<int>(left), y = static_cast<int>(top);
            for (size_t c = 0; c < 3; ++c)
            {
                const float found = (texel(x, y)[c] * (1 - u) + texel(x + 1, y)[c] * u) * (1 - v) +
                                    (texel(x, y + 1)[c] * (1 - u) + texel(x + 1, y + 1)[c] * u) * v;
                ASSERT_NEAR(found, 1 + d[static_cast<int>(c)], mip == 0 ? 0.05f : 0.1f);
            }
        }
    }
}

TEST(ProbeAtlas, isAtMostHalfAMebibyteAProbe)
{
    EXPECT_LE(4u * probeAtlasColumns(formats::kMaxLocalProbeSide, 6) *
                  probeAtlasRows(formats::kMaxLocalProbeSide),
              524288u);
    EXPECT_LE(kMaxLocalProbes * probeAtlasRows(formats::kMaxLocalProbeSide), 4096u) << "of every device";
}

} // namespace hearth::shared
