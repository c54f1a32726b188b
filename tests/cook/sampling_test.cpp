// Tests low-discrepancy points: (t, m, s)-net property, independence of seeds, and integration error.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/sampling/hemisphere.h"
#include "cook/sampling/owen_sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hearth::sampling
{
namespace
{

constexpr double kPi = std::numbers::pi;

TEST(OwenSobol, putsOnePointIntoEachElementaryBoxOfEachBlock)
{
    for (uint64_t seed = 0; seed < 20; ++seed)
        for (uint32_t log_count = 0; log_count <= 10; ++log_count)
            for (const uint32_t block : {0u, 1u, 5u})
                for (uint32_t log_columns = 0; log_columns <= log_count; ++log_columns)
                {
                    const uint32_t count = 1u << log_count, log_rows = log_count - log_columns;
                    std::vector<int> hits(count);
                    for (uint32_t i = 0; i < count; ++i)
                    {
                        const SquarePoint p = owenSobol(block * count + i, deriveSeed(3, seed));
                        const uint64_t column = uint64_t{p.x} >> (32 - log_columns);
                        const uint64_t row = uint64_t{p.y} >> (32 - log_rows);
                        ++hits[column << log_rows | row];
                    }
                    ASSERT_EQ(hits, std::vector<int>(count, 1))
                        << "seed " << seed << ", " << count << " points";
                }
}

TEST(OwenSobol, isSobolsSequenceButForTheScramble)
{
    // second coordinate from its direction numbers 1, 3, 5, 15, 17, ...: each is the one before times x + 1
    for (uint32_t index = 0; index < 5000; ++index)
    {
        uint32_t expected = 0, direction = 1;
        for (uint32_t bit = 0; bit < 32; ++bit, direction ^= direction << 1)
            if ((index >> bit & 1) != 0)
                expected ^= direction;
        ASSERT_EQ(detail::secondReversed(index), expected) << index;
    }
}

TEST(OwenSobol, flipsABitByWhatTheHigherOnesAre)
{
    for (uint32_t seed = 0; seed < 50; ++seed)
        for (uint32_t bit = 0; bit < 31; ++bit)
        {
            const uint32_t low = (1u << bit) - 1, x = static_cast<uint32_t>(deriveSeed(seed, bit));
            const auto s = static_cast<uint32_t>(deriveSeed(7, seed));
            // bits are reversed: bits below `bit` must not depend on bits above it
            EXPECT_EQ(detail::scrambledReversed(x, s) & low, detail::scrambledReversed(x & low, s) & low);
            EXPECT_NE((detail::scrambledReversed(x, s) ^ detail::scrambledReversed(x ^ (low + 1), s)) >> bit &
                          1,
                      0u);
        }
}

TEST(OwenSobol, spreadsEachPointOverTheSquareAsSeedsChange)
{
    // chi-squared of 256 cells, 255 degrees of freedom: mean 255, deviation 22.6
    for (const uint32_t index : {0u, 1u, 17u, 63u})
    {
        std::vector<double> hits(256);
        for (uint64_t seed = 0; seed < 25600; ++seed)
        {
            const SquarePoint p = owenSobol(index, deriveSeed(11, seed));
            ++hits[p.x >> 28 << 4 | p.y >> 28];
        }
        double chi2 = 0;
        for (const double h : hits)
            chi2 += (h - 100) * (h - 100) / 100;
        EXPECT_LT(chi2, 255 + 5 * 22.6) << index;
    }
}

TEST(OwenSobol, hasSeedsThatHaveNothingToDoWithEachOther)
{
    // errors of one integral under neighbouring seeds: correlation of 4000 pairs, deviation 0.016
    std::vector<double> errors;
    for (uint64_t seed = 0; seed < 4001; ++seed)
    {
        double sum = 0;
        for (uint32_t i = 0; i < 64; ++i)
        {
            const Float2 p = unitPoint(owenSobol(i, deriveSeed(0, seed)));
            sum += p.x * p.x + p.y < 0.8f ? 1 : 0;
        }
        errors.push_back(sum);
    }
    double mean = 0, variance = 0, covariance = 0;
    for (const double e : errors)
        mean += e / 4001;
    for (size_t i = 0; i < 4000; ++i)
    {
        variance += (errors[i] - mean) * (errors[i] - mean);
        covariance += (errors[i] - mean) * (errors[i + 1] - mean);
    }
    EXPECT_GT(variance, 0);
    EXPECT_LT(std::abs(covariance / variance), 0.065);
}

TEST(OwenSobol, integratesSmoothFunctionsWithErrorOfPowerThreeHalves)
{
    // exp(x + y): with four times as many points the error N^-3/2 drops to an eighth; plain random points: to
    // a half
    const double exact = (std::numbers::e - 1) * (std::numbers::e - 1);
    const auto rms = [&](uint32_t count)
    {
        double squares = 0;
        for (uint64_t seed = 0; seed < 400; ++seed)
        {
            double sum = 0;
            for (uint32_t i = 0; i < count; ++i)
            {
                const SquarePoint p = owenSobol(i, deriveSeed(5, seed));
                sum += std::exp((p.x + 0.5) * 0x1p-32 + (p.y + 0.5) * 0x1p-32);
            }
            squares += (sum / count - exact) * (sum / count - exact);
        }
        return std::sqrt(squares / 400);
    };
    const double at16 = rms(16), at1024 = rms(1024);
    EXPECT_LT(at1024, at16 / 300); // 6.8e-5 of 0.0275
    EXPECT_LT(at1024, 1e-4);
}

TEST(ShuffleIndex, keepsBlocksTogether)
{
    for (uint64_t seed = 0; seed < 20; ++seed)
        for (uint32_t log_count = 0; log_count <= 8; ++log_count)
            for (const uint32_t block : {0u, 1u, 5u})
            {
                const uint32_t count = 1u << log_count;
                std::vector<int> hits(count);
                const uint32_t first = shuffleIndex(block * count, seed) / count;
                for (uint32_t i = 0; i < count; ++i)
                {
                    const uint32_t shuffled = shuffleIndex(block * count + i, seed);
                    ASSERT_EQ(shuffled / count, first);
                    ++hits[shuffled % count];
                }
                for (const int hit : hits)
                    ASSERT_EQ(hit, 1);
            }
}

/// Steps of one path that share an index: pairs of their coordinates fill the square, too.
TEST(ShuffleIndex, makesStepsIndependent)
{
    constexpr uint32_t kCount = 1 << 12, kCells = 8;
    const auto deviation = [&](const auto& point)
    {
        double most = 0;
        for (uint64_t seed = 0; seed < 10; ++seed)
        {
            std::vector<double> hits(kCells * kCells);
            for (uint32_t i = 0; i < kCount; ++i)
            {
                const auto cell = [&](uint64_t step)
                {
                    const float x = unitFloat(point(i, deriveSeed(seed, step)).x);
                    return static_cast<uint32_t>(x * kCells);
                };
                hits[cell(0) * kCells + cell(1)] += 1;
            }
            constexpr double kMean = double{kCount} / (kCells * kCells);
            for (const double hit : hits)
                most = std::max(most, std::abs(hit - kMean) / std::sqrt(kMean));
        }
        return most;
    };
    EXPECT_LT(deviation([](uint32_t i, uint64_t seed) { return shuffledOwenSobol(i, seed); }), 5);
    // without the shuffle, whole cells are empty
    EXPECT_GT(deviation([](uint32_t i, uint64_t seed) { return owenSobol(i, seed); }), 7.9);
}

TEST(UnitFloat, staysInsideTheUnit)
{
    EXPECT_GT(unitFloat(0), 0);
    EXPECT_LT(unitFloat(~0u), 1);
    EXPECT_EQ(unitFloat(0x80000000u), 0.5f + 0x1p-24f);
}

TEST(SineCosine, areThoseOfTheStandardLibrary)
{
    for (int i = 0; i <= 100000; ++i)
    {
        const float turns = static_cast<float>(i) / 100000;
        const SineCosine sc = sineCosine(turns);
        ASSERT_NEAR(sc.sine, std::sin(2 * kPi * double{turns}), 2e-7) << turns;
        ASSERT_NEAR(sc.cosine, std::cos(2 * kPi * double{turns}), 2e-7) << turns;
    }
}

TEST(FrameAround, isRightHandedWithAxesAtRightAngles)
{
    for (uint32_t i = 0; i < 2000; ++i)
    {
        Float3 n = hemisphereDirection(unitPoint(owenSobol(i, 1)));
        if (i % 2 == 1)
            n.z = -n.z;
        if (i < 2)
            n = {0, 0, i == 0 ? 1.0f : -1.0f};
        const Frame f = frameAround(n);
        EXPECT_NEAR(dot(f.x, f.y), 0, 4e-7);
        EXPECT_NEAR(dot(f.x, n), 0, 4e-7);
        EXPECT_NEAR(dot(f.y, n), 0, 4e-7);
        EXPECT_NEAR(dot(cross(f.x, f.y), n), 1, 1e-6);
    }
}

TEST(TrianglePoint, keepsAreas)
{
    // split the triangle into 16 equal ones by floor(4 * weight); 64^2 points fall into 16 x 16 boxes of each
    constexpr int kCount = 4096;
    std::vector<int> hits(32);
    double mean_u = 0, mean_v = 0;
    for (uint32_t i = 0; i < kCount; ++i)
    {
        const Float2 b = trianglePoint(unitPoint(owenSobol(i, 3)));
        ASSERT_GE(b.x, 0);
        ASSERT_GE(b.y, 0);
        ASSERT_LE(b.x + b.y, 1);
        mean_u += double{b.x} / kCount;
        mean_v += double{b.y} / kCount;
        const int column = static_cast<int>(b.x * 4), row = static_cast<int>(b.y * 4);
        const bool upper = b.x * 4 - static_cast<float>(column) + b.y * 4 - static_cast<float>(row) > 1;
        ++hits[static_cast<size_t>((column * 4 + row) * 2 + (upper ? 1 : 0))];
    }
    EXPECT_NEAR(mean_u, 1.0 / 3, 1e-4);
    EXPECT_NEAR(mean_v, 1.0 / 3, 1e-4);
    int cells = 0;
    for (const int h : hits)
        if (h > 0)
        {
            ++cells;
            EXPECT_NEAR(h, kCount / 16, 16);
        }
    EXPECT_EQ(cells, 16);
}

TEST(HemisphereDirections, areUnitAboveTheSurfaceAndThoseOfThePoints)
{
    const Frame frame = frameAround({0.6f, 0, -0.8f});
    std::vector<float> x(100), y(100), z(100);
    hemisphereDirections(28, 9, frame, x, y, z);
    for (uint32_t i = 0; i < 100; ++i)
    {
        const Float3 w{x[i], y[i], z[i]};
        EXPECT_NEAR(length(w), 1, 1e-6);
        const Float2 u = unitPoint(owenSobol(28 + i, 9));
        EXPECT_NEAR(dot(w, frame.z), u.x, 1e-6);
        EXPECT_EQ(w, frame.fromLocal(hemisphereDirection(u)));
    }
}

/// Owen's scramble by its definition: each node of the prefix tree flips its own coin.
SquarePoint slowOwenSobol(uint32_t index, uint64_t seed)
{
    const auto scrambled = [](uint32_t fraction, uint64_t tree)
    {
        uint32_t flips = 0;
        for (uint32_t bit = 0; bit < 32; ++bit)
        {
            const uint64_t node = (uint64_t{fraction} >> (31 - bit) >> 1) | uint64_t{1} << bit;
            flips |= static_cast<uint32_t>(deriveSeed(tree, node) & 1) << (31 - bit);
        }
        return fraction ^ flips;
    };
    return {scrambled(reverseBits(index), deriveSeed(seed, 0)),
            scrambled(reverseBits(detail::secondReversed(index)), deriveSeed(seed, 1))};
}

using Sequence = SquarePoint (*)(uint32_t index, uint64_t seed);

/// RMS error of ambient occlusion at points of a floor beside a wall and a sphere, for which the exact value
/// is known.
double occlusionError(Sequence points, uint32_t rays)
{
    double squares = 0;
    constexpr uint32_t kSeeds = 40, kPlaces = 10;
    for (uint32_t place = 0; place < kPlaces; ++place)
    {
        // the wall towards +x covers elevations up to phi; the sphere covers a cap on the other side
        const double phi = 0.12 * (place + 1), cap = 0.6 - 0.05 * place;
        const Float3 axis{-0.6f, 0, 0.8f};
        const double exact = (1 + std::cos(phi)) / 2 - double{axis.z} * std::sin(cap) * std::sin(cap);
        const auto tangent = static_cast<float>(std::tan(phi)),
                   cap_cosine = static_cast<float>(std::cos(cap));
        for (uint64_t seed = 0; seed < kSeeds; ++seed)
        {
            double seen = 0;
            for (uint32_t i = 0; i < rays; ++i)
            {
                const Float3 w = hemisphereDirection(unitPoint(points(i, deriveSeed(place, seed))));
                if (!(w.z < w.x * tangent) && !(dot(w, axis) > cap_cosine))
                    seen += double{w.z} * 2 / rays;
            }
            squares += (seen - exact) * (seen - exact);
        }
    }
    return std::sqrt(squares / (kSeeds * kPlaces));
}

TEST(OwenSobol, isAsGoodAsAScrambleWithACoinForEachNode)
{
    for (const uint32_t rays : {16u, 64u, 256u})
        EXPECT_LT(occlusionError(owenSobol, rays), 1.12 * occlusionError(slowOwenSobol, rays)) << rays;
}

TEST(OwenSobol, isFarBetterThanRandomDirections)
{
    // per octave the error drops as N^-0.75, for random points as N^-0.5; random points have 0.096 at N = 64
    EXPECT_LT(occlusionError(owenSobol, 64), 0.032);
    EXPECT_LT(occlusionError(owenSobol, 1024), 0.004);
}

} // namespace
} // namespace hearth::sampling
