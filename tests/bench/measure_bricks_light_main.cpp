// hearth_measure_bricks_light: compares the global illumination gathered from bricks with path tracing of the
// real geometry, and holds the error against the aim of "light".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/emission.h"
#include "cook/command_line/command_line.h"
#include "cook/tools/open_part.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "runtime/frame/frame.h"
#include "tests/bench/aims.h"
#include "tests/bench/light_plot.h"
#include "tests/reference/png_image.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <tbb/parallel_for.h>

namespace
{

using namespace hearth;
using namespace hearth::bench;
using namespace hearth::reference;
using reference::Double3;

constexpr uint32_t kFaceRays = 16;
constexpr double kAimVoxel = 0.1; ///< metres; voxels of this size have an aim

struct Arguments
{
    std::vector<std::string> scenes;
    std::vector<double> sizes{1, 0.5, 0.2, 0.1, 0.05};
    uint32_t points = 4000, paths = 2048, gather_rays = 4096;
    std::string plot;
    double image_voxel = 0; ///< metres; 0: no images
    uint32_t image_paths = 256;
};

std::string getName(const std::string& prefix)
{
    return prefix.substr(prefix.find_last_of('/') + 1);
}

Result<formats::PackView> openPack(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(path));
    return formats::PackView::read(std::move(reader));
}

Result<bricks::BrickTables> cookBricks(const bricks::StaticScene& scene, double voxel_size)
{
    bricks::GridSettings settings;
    settings.voxel_size = voxel_size;
    settings.memory = uint64_t{4} << 30;
    HEARTH_ASSIGN_OR_RETURN(bricks::CookedGrid grid, bricks::cookGrid(scene, settings));
    HEARTH_TRY(bricks::traceEmission(scene, grid));
    return std::move(grid.tables);
}

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Result<LightCurve::Size> measureSize(const bricks::StaticScene& scene, const shared::SceneLighting& lighting,
                                     const std::vector<LitPoint>& points, double voxel_size,
                                     uint32_t gather_rays)
{
    const auto start = std::chrono::steady_clock::now();
    HEARTH_ASSIGN_OR_RETURN(const bricks::BrickTables tables, cookBricks(scene, voxel_size));
    const BrickGather gather(bricks::makeBrickView(tables), lighting, kFaceRays);
    std::vector<Double3> gathered(points.size());
    tbb::parallel_for(size_t{0}, points.size(),
                      [&](size_t i)
                      { gathered[i] = gather.at(points[i].seen, gather_rays, static_cast<uint32_t>(i)); });
    const LightCurve::Size size{voxel_size, lightError(points, gathered, true),
                                lightError(points, gathered, false)};
    std::printf(
        "  %5.3f m %9zu faces   %6.1f %% %8.1f %% %+8.1f %%   %6.1f +- %.1f %% of all points   %5.1f s\n",
        voxel_size, tables.albedo.size(), 100 * size.away.whole, 100 * size.away.indirect,
        100 * size.away.bias, 100 * size.all.whole, 100 * size.all.uncertainty, secondsSince(start));
    return size;
}

/// Camera of the comparison: the scene's first camera, or one above a corner of the scene.
shared::Camera readCamera(const formats::PackView& pack)
{
    shared::Camera camera;
    if (!pack.cameras().empty())
    {
        const formats::CameraRecord& record = pack.cameras()[0];
        camera.position = transformPoint(record.world_from_camera, {0, 0, 0});
        camera.target = transformPoint(record.world_from_camera, {0, 0, -1});
        camera.y_fov_rad = record.y_fov_rad;
        return camera;
    }
    Box3 box;
    for (const formats::InstanceRecord& instance : pack.instances())
        for (const Float3 corner :
             {pack.meshes()[instance.mesh].box_min, pack.meshes()[instance.mesh].box_max})
            box.add(transformPoint(instance.world_from_object, corner));
    const Float3 size = box.max - box.min;
    camera.position = box.center() + Float3{0.25f * size.x, 0.9f * size.y, 0.4f * size.z};
    camera.target = box.center() - Float3{0, 0.3f * size.y, 0};
    camera.y_fov_rad = 0.8f;
    return camera;
}

/// Write irradiance side by side: by path tracing, by bricks, and their difference, red where bricks have
/// more and blue where they have less.
Status writeImage(const reference::ShadedScene& scene, const formats::PackView& pack,
                  const BrickGather& gather, uint32_t paths, double mean, const std::string& path)
{
    constexpr uint32_t kWidth = 320, kHeight = 214;
    const shared::Camera camera = readCamera(pack);
    const Double3 eye(camera.position), forward = normalize(Double3(camera.target) - eye);
    const Double3 right = normalize(cross(forward, {0, 1, 0})), up = cross(right, forward);
    const double slope = std::tan(double{camera.y_fov_rad} / 2);
    const auto shown = [&](double value)
    {
        return static_cast<uint8_t>(
            std::lround(255 * reference::srgbFromLinear(1 - std::exp(-0.7 * value / mean))));
    };
    reference::Image image(3 * kWidth, kHeight);
    const auto drawPixel = [&](uint32_t x, uint32_t y)
    {
        const double across = (2 * (x + 0.5) / kWidth - 1) * slope * kWidth / kHeight;
        const Double3 ray =
            normalize(forward + right * across + up * ((1 - 2 * (y + 0.5) / kHeight) * slope));
        const auto point = scene.nearest({eye, ray}, 0);
        if (!point)
            return;
        const uint32_t seed = y * kWidth + x;
        const reference::SurfaceLight truth = reference::traceSurfaceLight(scene, *point, paths, seed);
        const Double3 all = truth.direct + truth.indirect;
        const Double3 ours = truth.direct + gather.at({*point, -ray}, paths, seed);
        const double off = (ours.x + ours.y + ours.z - all.x - all.y - all.z) / 3;
        const Double3 values[] = {all, ours, {std::max(off, 0.0), 0, std::max(-off, 0.0)}};
        for (uint32_t i = 0; i < 3; ++i)
        {
            uint8_t* const pixel = image.at(size_t{i} * kWidth + x, y);
            pixel[0] = shown(values[i].x);
            pixel[1] = shown(values[i].y);
            pixel[2] = shown(values[i].z);
        }
    };
    tbb::parallel_for(0u, kHeight,
                      [&](uint32_t y)
                      {
                          for (uint32_t x = 0; x < kWidth; ++x)
                              drawPixel(x, y);
                      });
    return reference::writePng(path, image);
}

Result<LightCurve> measureScene(const std::string& prefix, const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(formats::PackView pack, openPack(prefix + ".hearth"));
    HEARTH_ASSIGN_OR_RETURN(reference::PackGeometry geometry, reference::PackGeometry::decode(pack));
    HEARTH_ASSIGN_OR_RETURN(reference::TextureSet textures, reference::TextureSet::load(pack));
    const reference::ShadedScene shaded(geometry, textures, nullptr);
    HEARTH_ASSIGN_OR_RETURN(formats::PackView import, tools::openPart(prefix + ".import.part"));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView clusters, tools::openPart(prefix + ".clusters.part"));
    HEARTH_ASSIGN_OR_RETURN(formats::PackView images, tools::openPart(prefix + ".textures.part"));
    std::vector<bricks::SourceParts> sources;
    sources.push_back({std::move(import), std::move(clusters), std::move(images)});
    HEARTH_ASSIGN_OR_RETURN(const bricks::StaticScene scene, bricks::collectStaticScene(sources));

    const auto start = std::chrono::steady_clock::now();
    const std::vector<LitPoint> points =
        litPoints(shaded, seenPoints(shaded, pack, arguments.points), arguments.paths);
    const auto near_lamps =
        std::count_if(points.begin(), points.end(), [](const LitPoint& p) { return p.near_lamp; });
    std::printf(
        "%s: %zu points, %zu of them within %.2f m of lamps; paths took %.1f s and have a noise of %.1f %%\n"
        "    voxel                   all light indirect     bias   of indirect\n",
        getName(prefix).c_str(), points.size(), static_cast<size_t>(near_lamps), kNearLamp,
        secondsSince(start), 100 * pathNoise(points));
    LightCurve curve{getName(prefix), {}};
    const shared::SceneLighting lighting = sharedLighting(shaded.lighting());
    for (const double voxel_size : arguments.sizes)
    {
        HEARTH_ASSIGN_OR_RETURN(const LightCurve::Size size,
                                measureSize(scene, lighting, points, voxel_size, arguments.gather_rays));
        curve.sizes.push_back(size);
    }
    if (arguments.image_voxel > 0)
    {
        HEARTH_ASSIGN_OR_RETURN(const bricks::BrickTables tables, cookBricks(scene, arguments.image_voxel));
        double mean = 0;
        for (const LitPoint& point : points)
            mean += length(point.truth.direct + point.truth.indirect) / std::sqrt(3.0);
        HEARTH_TRY(writeImage(shaded, pack, BrickGather(bricks::makeBrickView(tables), lighting, kFaceRays),
                              arguments.image_paths, mean / static_cast<double>(points.size()),
                              prefix + ".light.png"));
    }
    return curve;
}

/// Hold the scenes that have an aim against it.
/// returns  exit code: 1 if an aim is missed
int judge(const std::vector<LightCurve>& curves)
{
    Judgement judgement("light");
    for (const Aim& aim : kAims)
    {
        if (aim.bench != "light")
            continue;
        bool is_measured = false;
        for (const LightCurve& curve : curves)
            for (const LightCurve::Size& size : curve.sizes)
                if (size.voxel_size == kAimVoxel &&
                    aim.figure == "rms error at voxels of 0.1 m: " + curve.scene)
                {
                    judgement.record(aim.figure, size.all.whole);
                    is_measured = true;
                }
        if (!is_measured)
            judgement.leaveOut(aim.figure);
    }
    return judgement.finish();
}

/// returns  exit code: 1 if an aim is missed
Result<int> run(const Arguments& arguments)
{
    std::vector<LightCurve> curves;
    for (const std::string& prefix : arguments.scenes)
    {
        HEARTH_ASSIGN_OR_RETURN(LightCurve curve, measureScene(prefix, arguments));
        curves.push_back(std::move(curve));
    }
    if (!arguments.plot.empty())
        HEARTH_TRY(writeText(arguments.plot, lightPlot(curves)));
    return judge(curves);
}

int program(int argc, char** argv)
{
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // print each size's line as soon as it is complete
    cli::CommandLine app(
        "Holds the light that is gathered from bricks against paths through the real geometry.");
    Arguments arguments;
    app.addOption(
           "SCENES", arguments.scenes,
           "for each scene PREFIX: PREFIX.hearth and its PREFIX.import.part, .clusters.part, .textures.part")
        .required();
    app.addOption("--voxel-sizes", arguments.sizes, "metres").delimiter(',');
    app.addOption("--points", arguments.points, "of surfaces");
    app.addOption("--paths", arguments.paths, "of each point");
    app.addOption("--gather-rays", arguments.gather_rays, "of each point through the bricks");
    app.addOption("--plot", arguments.plot, "SVG file of the errors");
    app.addOption(
        "--image", arguments.image_voxel,
        "also write PREFIX.light.png at this voxel size: irradiance by paths, by bricks, their difference");
    app.addOption("--image-paths", arguments.image_paths,
                  "of each pixel, and rays of each through the bricks");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> end = run(arguments);
    return end.ok() ? *end : reportFailure(end.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_bricks_light", [&] { return program(argc, argv); });
}
