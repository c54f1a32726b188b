// Measures the lists of many lights on the CPU, lights that a pixel evaluates beside those that reach it,
// milliseconds of assignment, and the cells of spots; then all light methods as the device draws them. Lists
// and cells are beside those of other engines, whose times are not taken: these are written to be right, not
// fast. `./dev bench many-lights` runs it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "runtime/frame/light_lists.h"
#include "runtime/pack/pack.h"
#include "runtime/viewer/camera_fit.h"
#include "tests/bench/aims.h"
#include "tests/bench/lights/light_peers.h"
#include "tests/bench/lights/method_figures.h"
#include "tests/bench/lights/plane_scene.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace
{

using namespace hearth;

constexpr uint32_t kWidth = 1280, kHeight = 720;
/// Every so many pixels each way are looked at.
constexpr uint32_t kStride = 8;
constexpr int kViews = 16;
constexpr int kRepeats = 15;

/// A light set and the names of its figures.
struct MeasuredSet
{
    const char* ratio;
    const char* time;
    bench::LightSet lights;
};
constexpr MeasuredSet kLightSets[] = {
    {"evaluated / reaching, 192 lights", "CPU assignment of 192 lights, ms", {192, 3, 12}},
    {"evaluated / reaching, 1024 lights", "CPU assignment of 1024 lights, ms", {1024, 2, 8}},
    {"evaluated / reaching, 4096 lights", "CPU assignment of 4096 lights, ms", {4096, 1, 5}},
};

/// A light set that the device draws, and the name of its figure.
struct DrawnSet
{
    const char* ratio;
    bench::LightSet lights;
};
constexpr DrawnSet kDrawnSets[] = {
    {"evaluated / reaching as drawn, 192 lights", {192, 3, 12}},
    {"evaluated / reaching as drawn, 1024 lights", {1024, 2, 8}},
};
constexpr int kDrawnViews = 4; ///< of kViews

/// Visible point of a pixel.
struct Point
{
    Float3 position;
    Float3 image; ///< pixel and depth
};

/// Distance along a unit ray to a ball, or infinity.
float meetBall(Float3 eye, Float3 ray, const bench::Ball& ball)
{
    const Float3 offset = ball.center - eye;
    const float along = dot(offset, ray);
    const float half2 = ball.radius * ball.radius - (dot(offset, offset) - along * along);
    const float nearest = along - std::sqrt(std::max(half2, 0.0f));
    return half2 < 0 || nearest <= 0 ? std::numeric_limits<float>::infinity() : nearest;
}

std::vector<Point> findPoints(const shared::LightGridView& view, const std::vector<bench::Ball>& balls)
{
    std::vector<Point> points;
    for (uint32_t y = kStride / 2; y < kHeight; y += kStride)
        for (uint32_t x = kStride / 2; x < kWidth; x += kStride)
        {
            const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
            const Float3 ray =
                normalizeOr(view.right * ((px - view.center_x) / view.pixels_per_u) +
                                view.down * ((py - view.center_y) / view.pixels_per_v) + view.forward,
                            {});
            float t = ray.y < 0 ? -view.eye.y / ray.y : std::numeric_limits<float>::infinity();
            if (std::abs(view.eye.x + ray.x * t) > bench::kHalfWidth ||
                view.eye.z + ray.z * t < -bench::kDepth)
                t = std::numeric_limits<float>::infinity();
            for (const bench::Ball& ball : balls)
                t = std::min(t, meetBall(view.eye, ray, ball));
            if (std::isinf(t))
                continue;
            points.push_back({view.eye + ray * t, {px, py, t * dot(ray, view.forward)}});
        }
    return points;
}

bool reaches(const shared::Light& light, Float3 point)
{
    const Float3 offset = point - light.position;
    return dot(offset, offset) < light.range * light.range;
}

/// Best time of several runs, since other programs disturb.
template <typename Work>
double measureMilliseconds(const Work& work)
{
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRepeats; ++i)
    {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        best = std::min(best, taken.count());
    }
    return best;
}

/// Lists of a grid, with room for everything.
struct Lists
{
    explicit Lists(size_t lights) : frame(lights), cells(shared::kMaxLightCells), indices(1u << 20) {}
    void assign(const shared::LightGridLayout& layout, std::span<const shared::Light> lights)
    {
        lister.assign(layout, lights, {&counts, frame, cells, indices});
    }
    uint32_t countAt(const shared::LightGridLayout& layout, Float3 image) const
    {
        const shared::LightCascade& cascade = layout.cascades[shared::lightCascadeAt(image.z)];
        return shared::lightCellCount(cells[shared::lightCellAt(cascade, image.x, image.y, image.z)]);
    }

    shared::LightLists lister;
    shared::LightListCounts counts{};
    std::vector<uint32_t> frame, cells, indices;
};

/// A view and its visible points.
struct SeenView
{
    shared::LightGridView view;
    std::vector<Point> points;
};

struct Sums
{
    double pixels = 0, reaching = 0, evaluated = 0, milliseconds = 0;
    double in_view = 0, cells = 0, indices = 0;
    double peer_reaching = 0, peer_evaluated = 0; ///< within its slices
};

void addView(const SeenView& seen, const std::vector<shared::Light>& lights, Lists& lists, Sums& sums)
{
    const shared::LightGridLayout layout = shared::makeLightGrid(seen.view);
    bench::FroxelGrid froxels(seen.view);
    sums.milliseconds += measureMilliseconds([&] { lists.assign(layout, lights); });
    froxels.assign(lights);
    sums.in_view += lists.counts.ranged;
    sums.cells += lists.counts.cells;
    sums.indices += lists.counts.indices;
    for (const Point& point : seen.points)
    {
        const auto lit = static_cast<double>(std::count_if(lights.begin(), lights.end(),
                                                           [&](const shared::Light& light)
                                                           { return reaches(light, point.position); }));
        sums.pixels += 1;
        sums.reaching += lit;
        sums.evaluated += lists.countAt(layout, point.image);
        const size_t froxel = froxels.cellAt(point.image.x, point.image.y, point.image.z);
        if (froxel == bench::FroxelGrid::kNoCell)
            continue;
        sums.peer_reaching += lit;
        sums.peer_evaluated += static_cast<double>(froxels.count(froxel));
    }
}

void measureBalls(const std::vector<SeenView>& views, bench::Judgement& judgement)
{
    std::printf(
        "Lamps over a plane with %d balls, %zu views of %u x %u; lights a pixel, the rest for a view\n",
        bench::kBalls, views.size(), kWidth, kHeight);
    std::printf("  lights  in view  cells  indices  reaching  evaluated  ratio     ms   Filament's loop  "
                "ratio\n");
    for (const MeasuredSet& set : kLightSets)
    {
        const std::vector<shared::Light> lights = bench::makeLamps(set.lights);
        Lists lists(lights.size());
        Sums sums;
        for (const SeenView& seen : views)
            addView(seen, lights, lists, sums);
        const double count = static_cast<double>(views.size());
        std::printf("  %6u %8.0f %6.0f %8.0f %9.2f %10.2f %6.2f %6.2f %17.2f %6.2f\n", set.lights.count,
                    sums.in_view / count, sums.cells / count, sums.indices / count,
                    sums.reaching / sums.pixels, sums.evaluated / sums.pixels, sums.evaluated / sums.reaching,
                    sums.milliseconds / count, sums.peer_evaluated / sums.pixels,
                    sums.peer_evaluated / sums.peer_reaching);
        judgement.record(set.ratio, sums.evaluated / sums.reaching);
        judgement.record(set.time, sums.milliseconds / count);
    }
}

/// Corners of a cell in view space.
using Corners = std::array<Float3, 8>;

Corners makeCorners(Float4 edges, float begin, float end)
{
    Corners corners;
    for (size_t i = 0; i < corners.size(); ++i)
    {
        const float depth = i < 4 ? begin : end;
        corners[i] = {(i % 2 == 0 ? edges.x : edges.y) * depth, (i / 2 % 2 == 0 ? edges.z : edges.w) * depth,
                      depth};
    }
    return corners;
}

/// Sector of a cone that ends in a ball around its apex.
struct Sector
{
    Float3 apex, axis;
    float half_angle, range;

    /// Farthest point along a direction.
    Float3 support(Float3 direction) const
    {
        const Float3 n = normalizeOr(direction, axis);
        const float along = std::clamp(dot(n, axis), -1.0f, 1.0f);
        const float off = std::acos(along);
        if (off <= half_angle)
            return apex + n * range;
        if (off - half_angle >= 0.5f * std::numbers::pi_v<float>)
            return apex;
        const Float3 across = normalizeOr(n - axis * along, {});
        return apex + (axis * std::cos(half_angle) + across * std::sin(half_angle)) * range;
    }
};

/// True unless a plane parts a cell from a sector, which is convex up to 90 degrees. E. Gilbert, "An
/// iterative procedure for computing the minimum of a quadratic form on a convex set", 1966: the shortest
/// vector between both. What is not decided in the end, at less than a millimetre, counts as met.
bool meets(const Corners& cell, const Sector& sector)
{
    const auto supportCell = [&](Float3 direction)
    {
        return *std::max_element(cell.begin(), cell.end(),
                                 [&](Float3 a, Float3 b) { return dot(a, direction) < dot(b, direction); });
    };
    Float3 shortest = cell[0] - sector.apex;
    for (int i = 0; i < 2000; ++i)
    {
        const Float3 support = supportCell(-shortest) - sector.support(shortest);
        if (dot(shortest, support) > 1e-6f * dot(shortest, shortest))
            return false;
        const Float3 step = support - shortest;
        const float share = std::clamp(-dot(shortest, step) / std::max(dot(step, step), 1e-20f), 0.0f, 1.0f);
        shortest += step * share;
        if (dot(shortest, shortest) < 1e-6f)
            return true;
    }
    return true;
}

struct SpotCells
{
    double ball = 0, least_ball = 0, peer = 0, listed = 0, real = 0;
};

/// Count the cells of one spot by each test.
void addSpot(const shared::LightGridLayout& layout, const shared::Light& record, float half_angle,
             SpotCells& sum)
{
    const shared::CellLight light = makeCellLight(layout.grid, record);
    shared::CellLight whole = light;
    whole.center = light.apex;
    whole.radius = light.range;
    const float cosine = std::cos(half_angle);
    const Sector sector{light.apex, light.axis, half_angle, light.range};
    for (const shared::LightCascade& cascade : layout.cascades)
        for (uint32_t number = 0; number < cascade.slabs; ++number)
        {
            const shared::LightSlab slab = lightSlab(layout.grid, cascade, number);
            if (slab.end <= slab.begin || slab.end < whole.center.z - whole.radius ||
                slab.begin > whole.center.z + whole.radius)
                continue;
            for (uint32_t r = 0; r < cascade.rows; ++r)
            {
                const shared::LightRow row{lightRowEdge(layout.grid, cascade, r),
                                           lightRowEdge(layout.grid, cascade, r + 1)};
                const shared::LightColumns in_ball = ballColumns(layout.grid, cascade, whole, slab, row);
                const shared::LightColumns in_least = ballColumns(layout.grid, cascade, light, slab, row);
                const shared::LightColumns in_both = lightColumns(layout.grid, cascade, light, slab, row);
                sum.ball += std::max(in_ball.last - in_ball.first + 1, 0);
                sum.least_ball += std::max(in_least.last - in_least.first + 1, 0);
                for (int c = in_least.first; c <= in_least.last; ++c)
                {
                    const auto column = static_cast<uint32_t>(c);
                    const Float4 edges{lightColumnEdge(layout.grid, cascade, column),
                                       lightColumnEdge(layout.grid, cascade, column + 1), row.begin, row.end};
                    sum.listed += c >= in_both.first && c <= in_both.last &&
                                          reachesCell(layout.grid, light, slab, edges)
                                      ? 1
                                      : 0;
                    const float end = std::min(slab.end, light.center.z + light.radius);
                    const Corners corners = makeCorners(edges, slab.begin, end);
                    const Float3 middle = (corners.front() + corners.back()) * 0.5f;
                    sum.peer += bench::reachesBall(light.apex, light.axis, cosine, light.range, middle,
                                                   length(corners.back() - middle))
                                    ? 1
                                    : 0;
                    sum.real += meets(corners, sector) ? 1 : 0;
                }
            }
        }
}

void measureSpots(const shared::LightGridView& view, bench::Judgement& judgement)
{
    struct Angles
    {
        float low, high; ///< half-angles, degrees
    };
    constexpr Angles kAngles[] = {{5, 15}, {15, 30}, {30, 60}, {60, 90}};
    constexpr bench::LightSet kSpots{150, 2, 12};
    const shared::LightGridLayout layout = shared::makeLightGrid(view);
    std::printf("\nCells of %u spots\n", kSpots.count);
    std::printf("  half-angle   of ball   of least ball   ball against cone / real   seven planes / real\n");
    for (const Angles& angles : kAngles)
    {
        bench::Random random;
        SpotCells sum;
        for (uint32_t i = 0; i < kSpots.count; ++i)
        {
            shared::Light light = bench::makeLamp(random, kSpots);
            const float half_angle =
                random.uniform(angles.low, angles.high) * std::numbers::pi_v<float> / 180;
            light.type = shared::kLightSpot;
            light.position = {random.uniform(-20, 20), random.uniform(0, 4), -random.uniform(0, 40)};
            light.direction = random.direction();
            light.cone_scale = 1 / std::max(0.001f, 1 - std::cos(half_angle));
            light.cone_offset = -std::cos(half_angle) * light.cone_scale;
            addSpot(layout, light, half_angle, sum);
        }
        std::printf("  %3.0f to %2.0f %12.0f %15.0f %26.2f %21.3f\n", double{angles.low}, double{angles.high},
                    sum.ball, sum.least_ball, sum.peer / sum.real, sum.listed / sum.real);
        judgement.record("spot cells / real ones", sum.listed / sum.real);
    }
}

/// Make the plane of squares of 5 m, so that its clusters are no larger, with its balls and lamps.
formats::PackView buildPlane(test::TestScene& scene, const std::vector<bench::Ball>& balls,
                             std::span<const shared::Light> lamps)
{
    constexpr float kSquare = 5;
    const uint32_t stone = scene.addMaterial(test::plainMaterial());
    const uint32_t square = scene.addMesh(test::withMaterial(test::makeQuad(kSquare, kSquare), stone));
    for (float x = -bench::kHalfWidth + kSquare / 2; x < bench::kHalfWidth; x += kSquare)
        for (float z = -kSquare / 2; z > -bench::kDepth; z -= kSquare)
            scene.addInstance(square, test::lying({x, 0, z}));
    const uint32_t ball = scene.addMesh(test::withMaterial(shapes::rock(8, 0), stone));
    for (const bench::Ball& placed : balls)
        scene.addInstance(ball, test::scaled(placed.radius, placed.center));
    for (const shared::Light& lamp : lamps)
    {
        formats::LightRecord record =
            test::light(formats::LightType::point, lamp.position, {0, -1, 0}, lamp.intensity.x);
        record.range = lamp.range;
        scene.addLight(record);
    }
    return scene.build();
}

/// Return a camera of a pack by its name.
Result<shared::Camera> findCamera(const formats::PackView& pack, std::string_view name)
{
    for (uint32_t i = 0; i < pack.cameras().size(); ++i)
        if (pack.text(pack.cameras()[i].name) == name)
            return viewer::sceneCamera(pack, i);
    return Error{Issue::usage, pack.name(), "", "the pack has no camera \"" + std::string(name) + "\""};
}

/// Measure all light methods as the device draws them: on the plane, and in the market.
/// market  a pack of `hearth-samples market --lights 192`; "": without
Status measureMethods(const std::vector<bench::Ball>& balls, std::span<const shared::Camera> views,
                      const std::string& market, bench::Judgement& judgement)
{
    constexpr VkExtent2D kDrawn{640, 360};
    HEARTH_ASSIGN_OR_RETURN(bench::MethodMeter meter, bench::MethodMeter::create());
    std::printf("\nLight methods, drawn by %s in %u x %u, best of several frames\n",
                meter.host().deviceName().c_str(), kDrawn.width, kDrawn.height);
    for (const DrawnSet& set : kDrawnSets)
    {
        test::TestScene plane;
        const formats::PackView pack = buildPlane(plane, balls, bench::makeLamps(set.lights));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<bench::MethodFigures> methods,
                                meter.measure(pack, views, kDrawn));
        std::printf("%u lamps over the plane, %zu views\n", set.lights.count, views.size());
        bench::printMethods(methods);
        const bench::MethodFigures& cells = methods[static_cast<size_t>(gpu::LightMethod::practical)];
        judgement.record(set.ratio, cells.evaluated / cells.reaching);
    }
    if (market.empty())
        return success();
    HEARTH_ASSIGN_OR_RETURN(const pack::Pack pack, pack::Pack::open(market));
    for (const auto& [name, what] :
         {std::pair{"thirty", "3 suns, 30 points and two characters"}, std::pair{"street", "its street"}})
    {
        HEARTH_ASSIGN_OR_RETURN(const shared::Camera camera, findCamera(pack.view(), name));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<bench::MethodFigures> methods,
                                meter.measure(pack.view(), {&camera, 1}, kDrawn));
        std::printf("The market of %zu lights, %s\n", pack.view().lights().size(), what);
        bench::printMethods(methods);
    }
    return success();
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const std::string& market)
{
    bench::Judgement judgement("many-lights");
    bench::Random random;
    const std::vector<bench::Ball> balls = bench::makeBalls(random);
    std::vector<shared::Camera> cameras;
    std::vector<SeenView> views;
    for (int i = 0; i < kViews; ++i)
    {
        cameras.push_back(bench::makeWalker(random));
        const shared::LightGridView view = bench::makeView(cameras.back(), kWidth, kHeight);
        views.push_back({view, findPoints(view, balls)});
    }
    measureBalls(views, judgement);
    measureSpots(bench::makeView({.position = {0, 1.7f, 5}, .target = {0, 1.7f, 4}}, kWidth, kHeight),
                 judgement);
    HEARTH_TRY(measureMethods(balls, std::span(cameras).first(kDrawnViews), market, judgement));
    return judgement.finish();
}

int program(int argc, char** argv)
{
    cli::CommandLine app("Measures the lists of many lights, and all light methods.");
    std::string market;
    app.addOption("--market", market, "pack of the sample market, which is drawn as well");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(market);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_many_lights", [&] { return program(argc, argv); });
}
