// Tests what spreading specks changes in a face of light, and what it keeps.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/specks.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace hearth::reflections
{
namespace
{

constexpr uint32_t kSide = 24;
using Face = std::vector<Float3>;

Face evenFace(Float3 light)
{
    return Face(size_t{kSide} * kSide, light);
}

double sum(const Face& face)
{
    double total = 0;
    for (const Float3& texel : face)
        total += double{texel.x};
    return total;
}

} // namespace

TEST(Specks, spreadOverTheTexelsAroundWithAllTheirLight)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> noise(0.8f, 1.2f);
    Face face = evenFace({});
    for (Float3& texel : face)
        texel = Float3{0.2f, 0.3f, 0.4f} * noise(random);
    const size_t inside = 10 * kSide + 11, corner = 0;
    for (const size_t speck : {inside, corner})
        face[speck] = {9, 7, 5};
    const double before = sum(face);
    spreadSpecks(face, kSide);
    EXPECT_NEAR(sum(face), before, 1e-4 * before);
    EXPECT_LT(face[inside].x, 0.7f);
    EXPECT_LT(face[corner].x, 0.9f) << "25 texels are around it";
    EXPECT_GT(face[inside + 4].x, 0.2f) << "it has a part of the speck";
    EXPECT_LT(face[inside + 6].x, 0.25f) << "it is out of reach";
}

TEST(Specks, leaveEvenLightAndBrightSurfacesAsTheyAre)
{
    Face face = evenFace({0.5f, 0.5f, 0.5f});
    const Face even = face;
    spreadSpecks(face, kSide);
    EXPECT_EQ(face, even);
    // a surface with a straight edge: more than a third about each of its texels
    for (size_t i = 0; i < face.size() / 2; ++i)
        face[i] = {20, 20, 20};
    const Face edge = face;
    spreadSpecks(face, kSide);
    EXPECT_EQ(face, edge);
}

TEST(Specks, needLightAround)
{
    Face face = evenFace({});
    face[5 * kSide + 5] = {3, 3, 3};
    const Face lone = face;
    spreadSpecks(face, kSide);
    EXPECT_EQ(face, lone) << "a texel of a surface in the sky is no speck";
}

} // namespace hearth::reflections
