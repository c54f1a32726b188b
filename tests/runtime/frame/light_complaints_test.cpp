// Tests what users of other engines have complained about, each by the number of its report: lights that
// lists or culling lose, and limits that are reached without a word.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_boxes.h"
#include "formats/scene/scene_lighting.h"
#include "tests/runtime/frame/light_cases.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <optional>

namespace hearth::test
{

namespace
{

using shared::LightGridView;

constexpr double kDegree = std::numbers::pi / 180;

Float3 narrow3(Vector v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

LightCase lamp(Vector position, double range)
{
    formats::LightRecord record{};
    record.type = static_cast<uint32_t>(formats::LightType::point);
    record.color = {1, 1, 1};
    record.intensity = 1;
    record.range = static_cast<float>(range);
    record.world_from_light = Affine3{};
    const Float3 place = narrow3(position);
    record.world_from_light.m[0][3] = place.x;
    record.world_from_light.m[1][3] = place.y;
    record.world_from_light.m[2][3] = place.z;
    return {shared::lightFromRecord(record), 0};
}

/// half_angle  of the outer cone, radians
LightCase spot(Vector position, Float3 direction, double range, double half_angle)
{
    formats::LightRecord record{};
    record.type = static_cast<uint32_t>(formats::LightType::spot);
    record.color = {1, 1, 1};
    record.intensity = 1;
    record.range = static_cast<float>(range);
    record.inner_cone_rad = static_cast<float>(0.5 * half_angle);
    record.outer_cone_rad = static_cast<float>(half_angle);
    const Float3 place = narrow3(position);
    const float along[] = {direction.x, direction.y, direction.z}, origin[] = {place.x, place.y, place.z};
    for (size_t axis = 0; axis < 3; ++axis)
    {
        record.world_from_light.m[axis][2] = -along[axis];
        record.world_from_light.m[axis][3] = origin[axis];
    }
    return {shared::lightFromRecord(record), half_angle};
}

/// View of `width` x `height` pixels from an eye to a target.
/// half_height  of the image at distance 1; of an orthographic view, in metres
LightGridView look(Float3 eye, Float3 target, float width, float height, double half_height)
{
    LightGridView view;
    view.eye = eye;
    view.forward = normalizeOr(target - eye, {0, 0, -1});
    view.right = normalizeOr(cross(view.forward, {0, 1, 0}), {1, 0, 0});
    view.down = cross(view.forward, view.right);
    view.pixels_per_u = view.pixels_per_v = static_cast<float>(0.5 * double{height} / half_height);
    view.center_x = 0.5f * width;
    view.center_y = 0.5f * height;
    view.width = width;
    view.height = height;
    return view;
}

double halfHeight(double y_fov_degrees)
{
    return std::tan(0.5 * y_fov_degrees * kDegree);
}

/// Return the pixel and the depth at which a view shows a point.
std::optional<Float3> show(const LightGridView& view, Vector point)
{
    const Vector offset = point - widen3(view.eye);
    const double depth = dotProduct(offset, widen3(view.forward));
    if (depth < view.z_near)
        return std::nullopt;
    const double scale = view.is_orthographic ? 1 : depth;
    const double x = view.center_x + view.pixels_per_u * dotProduct(offset, widen3(view.right)) / scale;
    const double y = view.center_y + view.pixels_per_v * dotProduct(offset, widen3(view.down)) / scale;
    if (x < 0 || y < 0 || x > view.width || y > view.height)
        return std::nullopt;
    return narrow3({x, y, depth});
}

/// Return a point at a share of the range of a light from it, somewhere.
Vector placeAround(LightCases& cases, const LightCase& light, double share)
{
    const Float3 direction = cases.direction();
    const double distance = share * double{light.light.range};
    return {double{light.light.position.x} + distance * direction.x,
            double{light.light.position.y} + distance * direction.y,
            double{light.light.position.z} + distance * direction.z};
}

/// Return points in the ball of a light, half of them just within its surface.
std::vector<Vector> placesAround(LightCases& cases, const LightCase& light, int count)
{
    std::vector<Vector> points;
    for (int i = 0; i < count; ++i)
        points.push_back(placeAround(
            cases, light, i % 2 == 0 ? std::cbrt(cases.uniform(0, 1)) : 1 - cases.logUniform(1e-6, 0.01)));
    return points;
}

/// Lists of lights, which must hold each light that reaches a point in view.
class LightComplaints : public testing::Test
{
protected:
    /// Expect that the list of each point that the view shows holds all lights that reach it.
    void expectListed(const LightGridView& view, const std::vector<LightCase>& lights,
                      const std::vector<Vector>& points)
    {
        const shared::LightGridLayout layout = makeLightGrid(view);
        std::vector<shared::Light> records;
        for (const LightCase& light : lights)
            records.push_back(light.light);
        ListMemory memory(records.size());
        lists_.assign(layout, records, memory.view());
        ASSERT_EQ(memory.counts.overflows, 0u);
        indices_ += memory.counts.indices;
        for (const Vector& point : points)
        {
            const std::optional<Float3> image = show(view, point);
            if (!image)
                continue;
            const uint32_t cell = cellAt(layout, *image);
            ASSERT_LT(cell, layout.grid.cell_count);
            const std::vector<uint32_t> rows = memory.listLights(cell);
            for (uint32_t row = 0; row < lights.size(); ++row)
                if (isLit(lights[row].light, point, lights[row].outer_cone_rad))
                {
                    ++lit_pairs_;
                    ASSERT_TRUE(std::binary_search(rows.begin(), rows.end(), row))
                        << "light " << row << " at pixel " << image->x << ", " << image->y << ", depth "
                        << image->z;
                }
        }
    }

    LightCases cases_{7};
    shared::LightLists lists_; ///< of all views: it keeps its memory
    uint64_t lit_pairs_ = 0, indices_ = 0;
};

} // namespace

/// A lamp over a plane, 50 m away, whose light lost parts of its circle as the camera turned.
TEST_F(LightComplaints, filament3142LightsAreNotClippedAtAngles)
{
    for (const double range : {2.5, 12.0})
    {
        const std::vector<LightCase> lights{lamp({0, 2, 0}, range)};
        std::vector<Vector> points;
        for (int i = 0; i < 400; ++i)
        {
            const double angle = cases_.uniform(0, 2 * std::numbers::pi), away = cases_.uniform(0, range);
            points.push_back({away * std::cos(angle), 0, away * std::sin(angle)});
        }
        for (int turn = 0; turn < 360; turn += kSanitized ? 15 : 3)
            for (const double height : {0.3, 3.0, 20.0, 49.0})
            {
                const double along = std::sqrt(50.0 * 50.0 - height * height);
                const Float3 eye =
                    narrow3({along * std::cos(turn * kDegree), height, along * std::sin(turn * kDegree)});
                // the lamp is not in the middle of the image
                const Float3 target = narrow3({cases_.uniform(-9, 9), cases_.uniform(-4, 4), 0});
                expectListed(look(eye, target, 1280, 720, halfHeight(45)), lights, points);
            }
    }
    EXPECT_GT(lit_pairs_, kSanitized ? 20'000u : 100'000u);
}

/// Lights about 100 m away, which came and went from frame to frame as the camera moved.
TEST_F(LightComplaints, filament3141NoFlickerNear100Metres)
{
    std::vector<LightCase> lights;
    std::vector<Vector> points;
    for (int i = 0; i < 24; ++i)
    {
        const Vector position{cases_.uniform(-30, 30), cases_.uniform(1, 6), cases_.uniform(-115, -85)};
        lights.push_back(i % 2 == 0 ? lamp(position, cases_.uniform(1, 8))
                                    : spot(position, {0, -1, 0}, cases_.uniform(3, 8), 40 * kDegree));
        for (const Vector& point : placesAround(cases_, lights.back(), 100))
            points.push_back(point);
    }
    uint64_t last = 0;
    for (int frame = 0; frame < 300; ++frame)
    {
        const float z = 15 - 0.1f * static_cast<float>(frame);
        const uint64_t before = lit_pairs_;
        expectListed(look({0, 2, z}, {0, 2, z - 1}, 1280, 720, halfHeight(45)), lights, points);
        ASSERT_TRUE(last == 0 || lit_pairs_ - before >= last - 30) << "few points leave the view a frame";
        last = lit_pairs_ - before;
    }
    EXPECT_GT(lit_pairs_, 300'000u);
}

/// Lists that were short by one cell, on the left of each light.
TEST_F(LightComplaints, filament2402NoCellIsShort)
{
    for (size_t i = 0; i < trials(4000); ++i)
    {
        const LightGridView view = cases_.view();
        const shared::LightGridLayout layout = makeLightGrid(view);
        Float3 image;
        const std::vector<LightCase> lights{
            lamp(cases_.point(view, layout, image), cases_.logUniform(0.1, 50))};
        // where the ball ends to each side, as the eye sees it, and towards it
        const Vector center = widen3(lights[0].light.position), to_eye = widen3(view.eye) - center;
        const double range = 0.99999 * double{lights[0].light.range};
        const double distance = std::sqrt(dotProduct(to_eye, to_eye));
        std::vector<Vector> points;
        for (const Float3 side :
             {view.right, -view.right, view.down, -view.down, view.forward, -view.forward})
        {
            const Vector n = widen3(side);
            points.push_back({center.x + range * n.x, center.y + range * n.y, center.z + range * n.z});
            if (view.is_orthographic || distance <= range)
                continue;
            // the tangent from the eye that is farthest to that side
            const Vector e{to_eye.x / distance, to_eye.y / distance, to_eye.z / distance};
            const double toward = range / distance, off = dotProduct(n, e);
            Vector across{n.x - off * e.x, n.y - off * e.y, n.z - off * e.z};
            const double size = std::sqrt(dotProduct(across, across));
            if (size < 1e-3)
                continue;
            const double aside = std::sqrt(1 - toward * toward) / size;
            points.push_back({center.x + range * (toward * e.x + aside * across.x),
                              center.y + range * (toward * e.y + aside * across.y),
                              center.z + range * (toward * e.z + aside * across.z)});
        }
        expectListed(view, lights, points);
    }
    EXPECT_GT(lit_pairs_, kSanitized ? 250u : 5000u);
}

/// Spots so narrow that the test of a cell against their cone failed.
TEST_F(LightComplaints, filament4785NarrowConesAreListed)
{
    uint64_t of_balls = 0;
    for (size_t i = 0; i < trials(300); ++i)
    {
        const LightGridView view = look({0, 1.7f, 0}, {0, 1.7f, -1}, 1280, 720, halfHeight(60));
        const double half_angle = cases_.logUniform(0.02, 1) * kDegree, range = cases_.uniform(5, 40);
        const Vector position{cases_.uniform(-8, 8), cases_.uniform(0, 6), cases_.uniform(-25, -2)};
        const Float3 direction = cases_.direction();
        const LightCase light = spot(position, direction, range, half_angle);
        std::vector<Vector> points;
        for (int p = 0; p < 200; ++p)
        {
            const double along = cases_.uniform(0, range);
            const Float3 across = normalizeOr(cross(direction, cases_.direction()), {});
            const double aside = along * std::tan(half_angle) * cases_.uniform(0, 0.99);
            const auto place = [&](float base, float d, float a)
            { return double{base} + along * double{d} + aside * double{a}; };
            const Float3 base = light.light.position;
            points.push_back({place(base.x, direction.x, across.x), place(base.y, direction.y, across.y),
                              place(base.z, direction.z, across.z)});
        }
        expectListed(view, {light}, points);
        const uint64_t of_spots = indices_;
        expectListed(view, {lamp(position, range)}, {});
        of_balls += indices_ - of_spots;
        indices_ = of_spots;
    }
    EXPECT_GT(lit_pairs_, kSanitized ? 500u : 10'000u);
    EXPECT_LT(20 * indices_, of_balls) << "few cells of the ball are the cone's";
}

/// Lights that orthographic cameras did not see.
TEST_F(LightComplaints, filament5318LightsAreThereInOrthographicViews)
{
    for (int i = 0; i < 300; ++i)
    {
        const Float3 eye = cases_.direction() * static_cast<float>(cases_.logUniform(0.5, 300));
        LightGridView view = look(eye, narrow3({cases_.uniform(-1, 1), cases_.uniform(-1, 1), 0}), 640, 480,
                                  cases_.logUniform(0.5, 50));
        view.is_orthographic = true;
        std::vector<LightCase> lights;
        std::vector<Vector> points;
        for (int l = 0; l < 8; ++l)
        {
            const Vector position{cases_.uniform(-3, 3), cases_.uniform(-3, 3), cases_.uniform(-3, 3)};
            const double range = cases_.logUniform(0.2, 20);
            lights.push_back(
                l % 2 == 0 ? lamp(position, range)
                           : spot(position, cases_.direction(), range, cases_.uniform(1, 90) * kDegree));
            for (const Vector& point : placesAround(cases_, lights.back(), 20))
                points.push_back(point);
        }
        expectListed(view, lights, points);
    }
    EXPECT_GT(lit_pairs_, 20'000u);
}

/// Spots of more than a hemisphere, whose cells were those of the opposite angle.
TEST_F(LightComplaints, godot48054ConesAbove90DegreesLightTheirCells)
{
    for (int i = 0; i < (kSanitized ? 30 : 300); ++i)
    {
        const LightCase light = spot({0, 1, 0}, cases_.direction(), cases_.uniform(1, 20),
                                     cases_.uniform(i % 2 == 0 ? 45 : 90, i % 2 == 0 ? 90 : 179) * kDegree);
        const Float3 eye = cases_.direction() * static_cast<float>(cases_.logUniform(0.5, 60));
        expectListed(look(eye, {0, 1, 0}, 800, 600, halfHeight(75)), {light},
                     placesAround(cases_, light, 300));
    }
    EXPECT_GT(lit_pairs_, kSanitized ? 1500u : 15'000u);
}

/// Wide spots, culled while what they light was still in view: in narrow images most of all.
TEST_F(LightComplaints, godot110367WideSpotsAreNotCulledEarly)
{
    for (const double half_angle : {60.0, 80.0, 89.9, 90.0, 120.0, 175.0})
        for (int turn = 0; turn < 360; turn += 5)
        {
            const LightCase light = spot({0, 3, 0}, {1, 0, 0}, 10, half_angle * kDegree);
            const Vector ahead{std::cos(turn * kDegree), 0, std::sin(turn * kDegree)};
            const Float3 eye = narrow3({cases_.uniform(-8, 8), cases_.uniform(0, 6), cases_.uniform(-8, 8)});
            expectListed(look(eye, eye + narrow3(ahead), 240, 960, halfHeight(40)), {light},
                         placesAround(cases_, light, kSanitized ? 200 : 4000));
        }
    EXPECT_GT(lit_pairs_, kSanitized ? 250u : 5000u);
}

/// Lights above the 512th, which were not there.
TEST_F(LightComplaints, godot56591LightsAbove512AreThere)
{
    std::vector<LightCase> lights;
    std::vector<Vector> points;
    for (uint32_t i = 0; i < shared::kMaxLights; ++i)
    {
        lights.push_back(lamp({0.5 * (i % 64) - 16, 0.5 * (i / 64) - 16, -40}, 0.3));
        points.push_back(placeAround(cases_, lights.back(), 0.5));
    }
    expectListed(look({0, 0, 0}, {0, 0, -1}, 1024, 1024, 0.5), lights, points);
    EXPECT_GE(lit_pairs_, shared::kMaxLights) << "each light reaches its point";
}

/// Lights of a mesh above the eighth, which were left out.
TEST_F(LightComplaints, godot80133MoreThan8LightsReachAMesh)
{
    const LightGridView view = look({0, 1, 6}, {0, 0, 0}, 640, 480, halfHeight(50));
    const shared::LightGridLayout layout = makeLightGrid(view);
    shared::Instance still{};
    still.world_from_object_x = {1, 0, 0, 0};
    still.world_from_object_y = {0, 1, 0, 0};
    still.world_from_object_z = {0, 0, 1, 0};
    const shared::LightBox box = lightBox(layout.grid, still, view.eye, {-1, -1, -1}, {1, 1, 1});
    std::vector<LightCase> lights;
    uint32_t reaching = 0, listed = 0;
    for (int i = 0; i < 300; ++i)
    {
        const Vector position{cases_.uniform(-4, 4), cases_.uniform(-4, 4), cases_.uniform(-4, 4)};
        lights.push_back(lamp(position, cases_.uniform(0.5, 3)));
        const auto beyond = [](double p) { return std::max(std::abs(p) - 1, 0.0); };
        const Vector gap{beyond(position.x), beyond(position.y), beyond(position.z)};
        const bool is_reached = std::sqrt(dotProduct(gap, gap)) < double{lights.back().light.range} - 1e-3;
        const bool is_listed = reachesBox(makeCellLight(layout.grid, lights.back().light), box);
        EXPECT_TRUE(is_listed || !is_reached) << i;
        reaching += is_reached ? 1 : 0;
        listed += is_listed ? 1 : 0;
    }
    EXPECT_GT(reaching, 80u);
    EXPECT_LE(listed, reaching + 15) << "the box as the eye sees it is larger, but not by much";
    // and the pixels of the mesh evaluate them by their cells
    std::vector<Vector> points;
    for (int i = 0; i < 200; ++i)
        points.push_back({cases_.uniform(-1, 1), cases_.uniform(-1, 1), 1});
    expectListed(view, lights, points);
    EXPECT_GT(lit_pairs_, points.size() * 9) << "more than eight for a point";
}

/// Lights of a cell above the 255th, where a count of 8 bits began anew.
TEST_F(LightComplaints, bevy3915MoreThan255LightsOfACell)
{
    for (const int count : {255, 256, 257, 511, 512, 1000})
    {
        std::vector<LightCase> lights;
        for (int i = 0; i < count; ++i)
            lights.push_back(lamp({cases_.uniform(-0.2, 0.2), cases_.uniform(-0.2, 0.2), -10}, 1));
        const uint64_t before = lit_pairs_;
        expectListed(look({0, 0, 0}, {0, 0, -1}, 640, 480, halfHeight(50)), lights, {{0, 0, -10}});
        EXPECT_EQ(lit_pairs_ - before, static_cast<uint64_t>(count));
    }
}

/// Lights of a camera above the 32nd, which were left out.
TEST_F(LightComplaints, unityUrpMoreThan32LightsOfACamera)
{
    const LightGridView view = look({0, 2, 0}, {0, 1, -10}, 640, 360, halfHeight(50));
    std::vector<shared::Light> lights;
    std::vector<uint32_t> suns, shown;
    for (uint32_t i = 0; i < 1000; ++i)
    {
        LightCase light =
            lamp({cases_.uniform(-40, 40), cases_.uniform(0, 9), cases_.uniform(-60, 20)}, 0.01);
        if (i % 25 == 0)
        {
            light.light.type = shared::kLightDirectional;
            suns.push_back(i);
        }
        else if (show(view, widen3(light.light.position)))
            shown.push_back(i);
        lights.push_back(light.light);
    }
    ListMemory memory(lights.size());
    lists_.assign(makeLightGrid(view), lights, memory.view());
    const auto begin = memory.frame.begin(), ranged = begin + memory.counts.unranged,
               end = ranged + memory.counts.ranged;
    EXPECT_EQ(std::vector<uint32_t>(begin, ranged), suns);
    EXPECT_GT(shown.size(), 100u);
    EXPECT_TRUE(std::includes(ranged, end, shown.begin(), shown.end()));
    EXPECT_LE(memory.counts.ranged, shown.size() + 10) << "those whose ball alone reaches into view";
}

/// A spot that went out as a camera of a small angle came closer to what it lights.
TEST_F(LightComplaints, playcanvas4795SpotsAreNotCulledEarly)
{
    const LightCase light = spot({1.5, 4, 1}, normalizeOr({-1.5f, -4, -1}, {}), 8, 25 * kDegree);
    const std::vector<Vector> points = [&]
    {
        std::vector<Vector> cube;
        for (int i = 0; i < 1000; ++i)
        {
            double place[3] = {cases_.uniform(-0.5, 0.5), cases_.uniform(-0.5, 0.5),
                               cases_.uniform(-0.5, 0.5)};
            place[i % 3] = i % 2 == 0 ? 0.5 : -0.5;
            cube.push_back({place[0], place[1], place[2]});
        }
        return cube;
    }();
    for (const double y_fov_degrees : {2.0, 10.0, 45.0})
        for (double distance = 40; distance > 0.55; distance *= 0.97)
        {
            const uint64_t before = lit_pairs_;
            const Float3 eye{0.1f, 0.2f, static_cast<float>(distance)};
            expectListed(look(eye, {0, 0, 0}, 640, 480, halfHeight(y_fov_degrees)), {light}, points);
            EXPECT_TRUE(lit_pairs_ > before || distance < 1.5) << distance;
        }
    EXPECT_GT(lit_pairs_, 20'000u);
}

} // namespace hearth::test
