// hearth-reference: path-traces a pack, slowly, and can measure another image's difference from the result.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "formats/pack/pack_check.h"
#include "formats/scene/animation.h"
#include "pipelines/environments/read_environment.h"
#include "runtime/pack/pose_player.h"
#include "tests/reference/flip.h"
#include "tests/reference/tracer/reference_renderer.h"

#include <cmath>
#include <cstdio>

namespace
{

using namespace hearth;
using namespace hearth::reference;

struct Arguments
{
    std::string pack, output, size = "512x512", compare, flip_map, sky;
    std::vector<float> camera;
    int scene_camera = -1;
    std::string animation;
    double seconds = 0;
    ReferenceOptions options;
};

Status readSize(const std::string& text, ReferenceOptions& options)
{
    if (std::sscanf(text.c_str(), "%ux%u", &options.width, &options.height) != 2 || options.width == 0 ||
        options.height == 0 || options.width > 16384 || options.height > 16384)
        return Error{Issue::usage, "", "", "--size wants WxH, not '" + text + "'"};
    return success();
}

Result<shared::Camera> sceneCamera(const formats::PackView& view, size_t index)
{
    if (index >= view.cameras().size())
        return Error{Issue::usage, view.name(), "",
                     "there is no camera " + std::to_string(index) + "; the pack has " +
                         std::to_string(view.cameras().size())};
    const formats::CameraRecord& record = view.cameras()[index];
    shared::Camera camera;
    camera.position = transformPoint(record.world_from_camera, {0, 0, 0});
    camera.target = transformPoint(record.world_from_camera, {0, 0, -1});
    camera.up = transformVector(record.world_from_camera, {0, 1, 0});
    camera.y_fov_rad = record.y_fov_rad;
    camera.z_near = record.z_near;
    return camera;
}

shared::Camera givenCamera(const std::vector<float>& v)
{
    shared::Camera camera;
    camera.position = {v[0], v[1], v[2]};
    camera.target = {v[3], v[4], v[5]};
    camera.y_fov_rad = v[6] * 0.017453293f;
    camera.z_near = std::max(length(camera.target - camera.position) * 1e-3f, 1e-12f);
    return camera;
}

/// Root mean square of the differences of displayed values, 0 to 1.
double rmse(const Image& a, const Image& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i)
        sum += std::pow((a.rgb[i] - b.rgb[i]) / 255.0, 2);
    return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

Status compare(const Image& reference, const Arguments& arguments)
{
    HEARTH_ASSIGN_OR_RETURN(const Image test, readPng(arguments.compare));
    if (test.width != reference.width || test.height != reference.height)
        return Error{Issue::usage, arguments.compare, "", "the image has another size"};
    const FlipMap map = flip(reference, test);
    std::printf("FLIP %.6f\nRMSE %.6f\n", map.mean(), rmse(reference, test));
    return arguments.flip_map.empty() ? success() : writePng(arguments.flip_map, makeFlipImage(map));
}

Result<formats::ScenePose> readPose(const formats::PackView& view, const Arguments& arguments)
{
    const std::optional<uint32_t> clip = pack::findAnimation(view, arguments.animation);
    if (!clip)
        return Error{Issue::usage, arguments.pack, "", "there is no animation " + arguments.animation};
    const formats::AnimationTables tables = formats::animationTables(view);
    formats::ScenePose pose = formats::restPose(tables);
    formats::sampleAnimation(tables, tables.animations[*clip], arguments.seconds, pose);
    return pose;
}

Status run(Arguments& arguments)
{
    HEARTH_TRY(readSize(arguments.size, arguments.options));
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(arguments.pack));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView view, formats::PackView::read(std::move(reader)));
    if (arguments.camera.size() == 7)
        arguments.options.camera = givenCamera(arguments.camera);
    else
    {
        HEARTH_ASSIGN_OR_RETURN(arguments.options.camera,
                                sceneCamera(view, static_cast<size_t>(std::max(0, arguments.scene_camera))));
    }
    formats::ScenePose pose;
    if (!arguments.animation.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(pose, readPose(view, arguments));
        arguments.options.pose = &pose;
    }
    if (!arguments.sky.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(environment::Environment sky, environments::readEnvironment(arguments.sky));
        arguments.options.sky_map = std::make_shared<SkyMap>(std::move(sky));
    }
    HEARTH_ASSIGN_OR_RETURN(const Image image, renderReference(view, arguments.options));
    HEARTH_TRY(writePng(arguments.output, image));
    return arguments.compare.empty() ? success() : compare(image, arguments);
}

} // namespace

int main(int argc, char** argv)
{
    cli::CommandLine app(
        "Draws the finest level of a pack with rays: what hearth-render should draw.\n"
        "Example: hearth-reference scene.hearth -o scene.png --scene-camera 0 --size 640x360");
    Arguments arguments;
    app.addOption("PACK", arguments.pack, "pack to draw").required();
    app.addOption("-o,--output", arguments.output, "PNG to write").required();
    app.addOption("--size", arguments.size, "width x height");
    app.addOption("--camera", arguments.camera, "px,py,pz,tx,ty,tz,fovdeg").delimiter(',').expected(7);
    app.addOption("--scene-camera", arguments.scene_camera, "the pack's camera of that number (default 0)");
    app.addOption("--animation", arguments.animation, "in the pose of a clip, by its name or number");
    app.addOption("--time", arguments.seconds, "of the clip, seconds");
    app.addOption("--samples-per-side", arguments.options.samples_per_side, "rays per pixel: its square")
        .range(1u, 64u);
    app.addFlag("--shadows", arguments.options.shadows, "shadows of the lights");
    app.addOption("--sky-rays", arguments.options.sky.rays,
                  "rays to the sky for each sample and lobe: what hides it counts (default 0: nothing does)");
    app.addOption("--bounces", arguments.options.sky.bounces,
                  "diffuse bounces of what hides the sky (default 0: it is black)");
    app.addOption("--paths", arguments.options.paths,
                  "paths of each pixel, with all light and shadows, in place of these rays");
    app.addOption("--sky", arguments.sky, "with --paths: image of the sky, in place of the pack's");
    app.addOption("--compare", arguments.compare, "print how far this PNG is from that, by FLIP and RMSE");
    app.addOption("--flip-map", arguments.flip_map, "write that difference as an image");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status status = run(arguments);
    return status.ok() ? 0 : reportFailure(status.error());
}
