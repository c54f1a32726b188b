// Tests which sources are left out of each other's occluders, against rays at the boxes themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/neighbours/neighbours.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace hearth::neighbours
{

namespace
{

/// Return the length of the part of a ray's parameter range in which it is in a box's slabs; negative: it
/// misses the box.
float overlapWithBox(Float3 origin, Float3 direction, const Box3& box)
{
    float first = 0, last = INFINITY;
    for (int axis = 0; axis < 3; ++axis)
    {
        const float a = (box.min[axis] - origin[axis]) / direction[axis];
        const float b = (box.max[axis] - origin[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return last - first;
}

/// Return the part of the ambient light at a point that a box occludes, by cosine-weighted rays.
double traceOcclusion(Float3 point, Float3 normal, const Box3& box, std::mt19937& random)
{
    constexpr int kRays = 1 << 15;
    std::uniform_real_distribution<float> uniform(0, 1);
    int hits = 0;
    for (int i = 0; i < kRays; ++i)
    {
        // a point on the unit sphere about the tip of the normal is in a cosine-weighted direction
        const float z = 2 * uniform(random) - 1, angle = 2 * std::numbers::pi_v<float> * uniform(random);
        const float r = std::sqrt(1 - z * z);
        const Float3 direction = normal + Float3{r * std::cos(angle), r * std::sin(angle), z};
        hits += overlapWithBox(point, direction, box) >= 0 ? 1 : 0;
    }
    return double{1} * hits / kRays;
}

Box3 randomBox(std::mt19937& random, float reach)
{
    std::uniform_real_distribution<float> place(-reach, reach), size(.1f, 3);
    const Float3 low{place(random), place(random), place(random)};
    return {low, low + Float3{size(random), size(random), size(random)}};
}

Box3 boxAt(Float3 low, Float3 size)
{
    return {low, low + size};
}

} // namespace

TEST(Neighbours, leaveOutWhatRaysHardlyMeet)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    int left_out = 0, listed = 0;
    double most_left_out = 0;
    for (int i = 0; i < 300; ++i)
    {
        const Box3 a = randomBox(random, 25), b = randomBox(random, 25);
        if (!findNeighbours(std::vector{a, b})[0].empty())
        {
            ++listed;
            continue;
        }
        ++left_out;
        const Float3 extent = a.max - a.min;
        const Float3 point = a.min + Float3{extent.x * uniform(random), extent.y * uniform(random),
                                            extent.z * uniform(random)};
        // facing it, a point sees the most of it
        const Float3 to_box = (b.min + b.max) * .5f - point;
        most_left_out =
            std::max(most_left_out, traceOcclusion(point, to_box * (1 / length(to_box)), b, random));
    }
    EXPECT_GT(left_out, 100);
    EXPECT_GT(listed, 30) << "otherwise the rule could be to leave all out";
    // one 256th, and three standard deviations of the rays
    EXPECT_LE(most_left_out, 1.0 / 256 + 3 * std::sqrt(1.0 / 256 / (1 << 15)));
    EXPECT_GE(most_left_out, 1.0 / 256 / 8) << "the rule keeps more than it has to";
}

TEST(Neighbours, areThoseThatAreNearForTheirSize)
{
    const std::vector<Box3> boxes{boxAt({0, 0, 0}, {1, 1, 1}), boxAt({20, 0, 0}, {1, 1, 1}),
                                  boxAt({60, 0, 0}, {30, 30, 30}), boxAt({21.5f, 0, 0}, {1, 1, 1}), Box3{}};
    EXPECT_EQ(findNeighbours(boxes), (Neighbours{{2}, {2, 3}, {}, {1, 2}, {}}))
        << "the large one is seen from afar, and sees none itself";
}

TEST(Neighbours, areNoneWhereNothingWasPlaced)
{
    const Box3 box = boxAt({-1, 0, -1}, {2, 2, 2});
    EXPECT_EQ(findNeighbours(std::vector{box, box, box}), Neighbours(3));
    // a floor below props stands in none of them
    EXPECT_EQ(findNeighbours(std::vector{boxAt({-5, -1, -5}, {10, 1, 10}), boxAt({2, 0, 2}, {1, 1, 1})}),
              (Neighbours{{1}, {0}}));
    EXPECT_EQ(findNeighbours({}), Neighbours());
}

TEST(Neighbours, areListedByLine)
{
    EXPECT_EQ(neighboursText({{1, 12}, {}, {0}}), "1 12\n\n0\n");
}

TEST(Neighbours, readTheBoxOfAnImport)
{
    const Result<Box3> box = parseBox(R"({"lit_box":{"min":[0,-1,2.5],"max":[1,1,1e10]}})", "a.json");
    ASSERT_TRUE(box.ok());
    EXPECT_EQ(box->min, (Float3{0, -1, 2.5f}));
    EXPECT_EQ(box->max, (Float3{1, 1, 1e10f}));
    EXPECT_TRUE(parseBox(R"({"lit_box":null})", "a.json")->empty());
    for (const char* text :
         {"", "{", "[]", "{}", R"({"lit_box":1})", R"({"lit_box":{"min":[0,0,0]}})",
          R"({"lit_box":{"min":[0,0],"max":[1,1,1]}})", R"({"lit_box":{"min":[0,0,0],"max":["a",1,1]}})"})
    {
        const Result<Box3> none = parseBox(text, "a.json");
        ASSERT_FALSE(none.ok()) << text;
        EXPECT_EQ(none.error().issue, Issue::json_syntax) << text;
        EXPECT_EQ(none.error().file, "a.json") << text;
    }
}

} // namespace hearth::neighbours
