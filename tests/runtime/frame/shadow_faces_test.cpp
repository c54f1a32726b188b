// Tests which faces of point lights need maps, against points that are scattered in the view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/shadow_faces.h"

#include "tests/runtime/frame/shadow_cases.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using namespace shared;

struct Case
{
    Camera camera;
    FrameView view;
    Float3 light;
    float range;
};

Case makeRandomCase(std::mt19937& random)
{
    Case c;
    c.camera.position = randomUnit(random) * between(random, 0, 20);
    c.camera.target = c.camera.position + randomUnit(random);
    c.camera.y_fov_rad = between(random, 0.2f, 2.0f);
    c.view = makeFrameView(c.camera, 640, 360, 1, 1);
    c.light = c.camera.position + randomUnit(random) * between(random, 0, 15);
    c.range = random() % 4 == 0 ? 0 : between(random, 0.5f, 12);
    return c;
}

/// A point in the view, relative to the eye, moved by the error of its cluster.
Double3 chooseSeenPoint(const Case& c, std::mt19937& random)
{
    const Double3 forward = widen(row3(c.view.clip_w));
    const Double3 x = widen(row3(c.view.clip_x));
    const Double3 y = widen(row3(c.view.clip_y));
    const double distance = double{c.camera.z_near} * std::exp(double{between(random, 0, 9)});
    const double across = double{between(random, -1, 1)} / dot(x, x);
    const double down = double{between(random, -1, 1)} / dot(y, y);
    const Double3 point = (forward + x * across + y * down) * distance;
    const double error = length(point) / double{c.view.lod_scale};
    return point + widen(randomUnit(random)) * (error * double{between(random, 0, 1)});
}

/// A point that the light reaches, relative to the light; it may be out of view.
Double3 chooseLitPoint(const Case& c, std::mt19937& random)
{
    const float reach = c.range == 0 ? 30 : c.range;
    return widen(randomUnit(random)) * double{reach * std::cbrt(between(random, 0, 1))};
}

bool isInView(const Case& c, Double3 point)
{
    const double w = dot(widen(row3(c.view.clip_w)), point);
    return w > double{c.camera.z_near} && std::abs(dot(widen(row3(c.view.clip_x)), point)) < w &&
           std::abs(dot(widen(row3(c.view.clip_y)), point)) < w;
}

std::array<bool, 6> findNeededFaces(const Case& c, int points, std::mt19937& random)
{
    std::array<bool, 6> needed{};
    const Double3 from_light_to_eye = widen(c.camera.position) - widen(c.light);
    for (int i = 0; i < points; ++i)
    {
        const Double3 seen = chooseSeenPoint(c, random) + from_light_to_eye;
        if (c.range == 0 || length(seen) <= double{c.range})
            needed[pointFace(narrow(seen))] = true;
        const Double3 lit = chooseLitPoint(c, random);
        if (isInView(c, lit - from_light_to_eye))
            needed[pointFace(narrow(lit))] = true;
    }
    return needed;
}

} // namespace

TEST(ShadowFaces, haveMapsWhereAPointInViewMayLookThemUp)
{
    std::mt19937 random(21);
    uint32_t needed = 0, shown = 0;
    for (int i = 0; i < 400; ++i)
    {
        const Case c = makeRandomCase(random);
        const std::array<bool, 6> faces = findNeededFaces(c, 4000, random);
        for (uint32_t face = 0; face < 6; ++face)
        {
            const bool may_show = mayShowFace(c.view, makePointShadow(c.light, face, 0.05f), c.range);
            EXPECT_TRUE(may_show || !faces[face]) << "case " << i << ", face " << face;
            needed += faces[face];
            shown += may_show;
        }
    }
    // half of the 2400 faces have no point in view
    EXPECT_LT(needed, 1300u);
    EXPECT_LT(shown, needed * 6 / 5) << needed << " are needed";
}

TEST(ShadowFaces, allHaveMapsInAViewThatIsCoarse)
{
    const Camera camera{.position = {0, 0, 5}, .target = {0, 0, 0}};
    const ShadowLight behind = makePointShadow({0, 0, 20}, 4, 0.05f);
    EXPECT_FALSE(mayShowFace(makeFrameView(camera, 640, 360, 1, 1), behind, 3));
    EXPECT_TRUE(mayShowFace(makeFrameView(camera, 640, 360, 100, 1), behind, 3))
        << "points may be moved by metres";
}

} // namespace hearth::test
