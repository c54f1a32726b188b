// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/options.h"

#include "formats/shared/shading.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace hearth::viewer
{

const char* const kRenderHelp =
    "Usage: hearth-render PACK -o IMAGE.png [options]\n"
    "Draw a pack without a window.\n"
    "\n"
    "  -o, --output FILE       the picture, PNG\n"
    "      --size WxH          pixels, default 1280x720\n"
    "      --camera PX,PY,PZ,TX,TY,TZ,FOV\n"
    "                          eye and target in metres, full vertical angle in degrees\n"
    "      --camera-path FILE  a picture for each line of FILE, written as for --camera: IMAGE-0000.png, "
    "...\n"
    "      --scene-camera N    the camera N of the pack, the first is 0\n"
    "      --fit               frame the whole scene (default)\n"
    "      --error-pixels E    largest error on the screen, default 1; 0 draws the source triangles\n"
    "      --lod-curve D:F,... factor F on the error at D metres, linear between; no factor may grow faster "
    "than\n"
    "                          the distance. Example: 0:1,50:1,500:0.4\n"
    "      --view VIEW         final, clusters, lod, triangles, materials, normals, depth, error (yellow: "
    "as\n"
    "                          large as allowed), cones (red: none), overdraw (white: 16) or shadow-maps "
    "(grey:\n"
    "                          none)\n"
    "      --shadows SETTINGS  off (default), on, or some of maps=N (16 at most), texels=N (1024), kernel=N "
    "(1:\n"
    "                          3x3), bias=B (2: how much coarser than the picture), splits=N (4), near=M, "
    "far=M\n"
    "                          (metres, where the splits begin and end; as the scene does). Example: "
    "texels=2048,bias=4\n"
    "      --shadow-sphere X,Y,Z,RADIUS[,LIGHT]\n"
    "                          finer shadows there, of all lights or of one; may be given several times\n"
    "      --shaded-area AREA  where each material is shaded: picture, tiles (64x64 pixels where it is "
    "seen), "
    "or\n"
    "                          automatic (default), which takes tiles in scenes of many materials; the "
    "picture\n"
    "                          stays the same\n"
    "      --samples N         1, or 4 for a smoother picture\n"
    "      --device NAME       part of the name of the graphics device\n"
    "      --budget BYTES      stream the geometry through so much memory, K, M or G behind the number for "
    "KiB, MiB, "
    "GiB;\n"
    "                          a picture waits for all that it wants, those of a camera path do not\n"
    "      --stats FILE        counts and times of the passes as JSON\n"
    "      --frames N          draw N times; the times are medians\n"
    "      --dump-visibility FILE\n"
    "                          what each pixel shows: \"HVIS\", then 32-bit words: width, height, slot "
    "count;\n"
    "                          instance and cluster of each slot; for each pixel slot * 128 + triangle or "
    "-1\n"
    "      --cull TESTS        all (default), none, or some of instances,frustum,cone,occlusion; the "
    "picture\n"
    "                          stays the same\n"
    "      --hzb START         the depths that occlusion culling starts a frame with: previous (default), "
    "none,\n"
    "                          or noise:SEED; the picture stays the same\n"
    "      --validate          run the Vulkan validation layer; any message is an error\n"
    "  -v, --verbose           say which device draws\n"
    "  -h, --help\n"
    "\n"
    "Example: hearth-render rock.hearth -o rock.png --size 1920x1080 --samples 4\n"
    "Exit codes: 0, 2 usage, 65 malformed pack, 66 missing, 70 no device or a defect, 73 cannot write, 74 "
    "I/O\n";

namespace
{

std::string quoted(std::string_view text)
{
    std::string result(1, '"');
    result.append(text);
    result += '"';
    return result;
}

Error usage(const std::string& detail)
{
    return {Issue::usage, "", "", detail};
}

Status parseSize(std::string_view text, RenderOptions& options)
{
    constexpr uint32_t kLargest = 16384;
    const auto parts = split(text, 'x');
    if (parts.size() == 2)
    {
        const auto width = parseNumber<uint32_t>(parts[0]);
        const auto height = parseNumber<uint32_t>(parts[1]);
        if (width && height && *width >= 1 && *height >= 1 && *width <= kLargest && *height <= kLargest)
        {
            options.width = *width;
            options.height = *height;
            return success();
        }
    }
    return usage("--size: " + quoted(text) + " is not WxH with sides of 1 to 16384");
}

Status parseCameraOption(std::string_view text, RenderOptions& options)
{
    options.camera = parseCamera(text);
    if (!options.camera)
        return usage("--camera: " + quoted(text) +
                     " is not PX,PY,PZ,TX,TY,TZ,FOV with eye and target apart and 1 to 170 degrees");
    return success();
}

Status parseSceneCamera(std::string_view text, RenderOptions& options)
{
    options.scene_camera = parseNumber<uint32_t>(text);
    if (!options.scene_camera)
        return usage("--scene-camera: " + quoted(text) + " is not the index of a camera");
    return success();
}

Status parseView(std::string_view text, RenderOptions& options)
{
    constexpr std::pair<std::string_view, uint32_t> kViews[] = {
        {"final", shared::kViewFinal},
        {"clusters", shared::kViewClusters},
        {"lod", shared::kViewLod},
        {"triangles", shared::kViewTriangles},
        {"normals", shared::kViewNormals},
        {"depth", shared::kViewDepth},
        {"materials", shared::kViewMaterials},
        {"error", shared::kViewError},
        {"cones", shared::kViewCones},
        {"overdraw", shared::kViewOverdraw},
        {"shadow-maps", shared::kViewShadowMaps},
    };
    for (const auto& [name, view] : kViews)
        if (text == name)
        {
            options.view = view;
            return success();
        }
    return usage("--view: " + quoted(text) +
                 " is none of final, clusters, lod, triangles, materials, normals, depth, "
                 "error, cones, overdraw, shadow-maps");
}

Status parseShadedArea(std::string_view text, RenderOptions& options)
{
    constexpr std::pair<std::string_view, gpu::ShadedArea> kAreas[] = {
        {"automatic", gpu::ShadedArea::automatic},
        {"picture", gpu::ShadedArea::wholePicture},
        {"tiles", gpu::ShadedArea::tiles},
    };
    for (const auto& [name, area] : kAreas)
        if (text == name)
        {
            options.shaded_area = area;
            return success();
        }
    return usage("--shaded-area: " + quoted(text) + " is none of automatic, picture, tiles");
}

Status parseCull(std::string_view text, RenderOptions& options)
{
    constexpr std::pair<std::string_view, uint32_t> kTests[] = {{"instances", shared::kCullInstances},
                                                                {"frustum", shared::kCullFrustum},
                                                                {"cone", shared::kCullCone},
                                                                {"occlusion", shared::kCullOcclusion}};
    options.cull_flags = text == "all" ? shared::kCullEverything : 0;
    if (text == "all" || text == "none")
        return success();
    for (const std::string_view part : split(text, ','))
    {
        const auto* const test = std::find_if(std::begin(kTests), std::end(kTests),
                                              [&](const auto& known) { return known.first == part; });
        if (test == std::end(kTests))
            return usage("--cull: " + quoted(part) +
                         " is neither all nor none nor one of instances, frustum, cone, occlusion");
        options.cull_flags |= test->second;
    }
    return success();
}

Status parsePyramid(std::string_view text, RenderOptions& options)
{
    constexpr std::string_view kNoise = "noise:";
    if (text == "previous")
        options.pyramid = PyramidStart::previous;
    else if (text == "none")
        options.pyramid = PyramidStart::none;
    else if (const auto seed = parseNumber<uint32_t>(text.substr(std::min(text.size(), kNoise.size())));
             text.starts_with(kNoise) && seed)
    {
        options.pyramid = PyramidStart::noise;
        options.noise_seed = *seed;
    }
    else
        return usage("--hzb: " + quoted(text) + " is none of previous, none, noise:SEED");
    return success();
}

Status parseErrorPixels(std::string_view text, RenderOptions& options)
{
    const auto number = parseNumber<float>(text);
    if (!number || *number < 0)
        return usage("--error-pixels: " + quoted(text) + " is not a number from 0");
    options.error_pixels = *number;
    return success();
}

Status parseLodCurve(std::string_view text, RenderOptions& options)
{
    options.lod_curve.clear();
    for (const std::string_view part : split(text, ','))
    {
        const auto knot = split(part, ':');
        const auto distance = parseNumber<float>(knot.front());
        const auto factor = parseNumber<float>(knot.back());
        if (knot.size() != 2 || !distance || !factor)
            return usage("--lod-curve: " + quoted(part) + " is not DISTANCE:FACTOR");
        options.lod_curve.push_back({*distance, *factor});
    }
    shared::FrameView scratch{};
    if (const Status set = setLodCurve(scratch, options.lod_curve); !set.ok())
        return usage("--lod-curve: " + set.error().detail);
    return success();
}

Status parseSamples(std::string_view text, RenderOptions& options)
{
    if (text != "1" && text != "4")
        return usage("--samples: " + quoted(text) + " is neither 1 nor 4");
    options.samples = text == "4" ? 4 : 1;
    return success();
}

Status parseBudget(std::string_view text, RenderOptions& options)
{
    constexpr std::pair<char, uint32_t> kUnits[] = {{'K', 10}, {'M', 20}, {'G', 30}};
    std::string_view digits = text;
    uint32_t shift = 0;
    for (const auto& [unit, bits] : kUnits)
        if (text.ends_with(unit))
        {
            digits.remove_suffix(1);
            shift = bits;
        }
    const auto number = parseNumber<uint64_t>(digits);
    if (!number || *number == 0 || *number > (uint64_t{1} << 40 >> shift))
        return usage("--budget: " + quoted(text) + " is not a number of bytes from 1 to 1024G");
    options.geometry_budget = *number << shift;
    return success();
}

Status parseFrames(std::string_view text, RenderOptions& options)
{
    const auto number = parseNumber<uint32_t>(text);
    if (!number || *number < 1 || *number > 10000)
        return usage("--frames: " + quoted(text) + " is not a number from 1 to 10000");
    options.frames = *number;
    return success();
}

template <Status (*kParse)(std::string_view, ShadowSettings&)>
Status parseForShadows(std::string_view text, RenderOptions& options)
{
    return kParse(text, options.shadows);
}

template <std::string RenderOptions::*kMember>
Status parseText(std::string_view text, RenderOptions& options)
{
    options.*kMember = text;
    return success();
}

struct ValueOption
{
    std::string_view name;
    Status (*parse)(std::string_view value, RenderOptions& options);
};

constexpr ValueOption kValueOptions[] = {
    {"-o", parseText<&RenderOptions::output>},
    {"--output", parseText<&RenderOptions::output>},
    {"--size", parseSize},
    {"--camera", parseCameraOption},
    {"--camera-path", parseText<&RenderOptions::camera_path>},
    {"--scene-camera", parseSceneCamera},
    {"--error-pixels", parseErrorPixels},
    {"--lod-curve", parseLodCurve},
    {"--view", parseView},
    {"--shadows", parseForShadows<parseShadows>},
    {"--shadow-sphere", parseForShadows<parseShadowSphere>},
    {"--shaded-area", parseShadedArea},
    {"--samples", parseSamples},
    {"--device", parseText<&RenderOptions::device>},
    {"--stats", parseText<&RenderOptions::stats>},
    {"--frames", parseFrames},
    {"--dump-visibility", parseText<&RenderOptions::visibility>},
    {"--budget", parseBudget},
    {"--cull", parseCull},
    {"--hzb", parsePyramid},
};

const ValueOption* findValueOption(std::string_view name)
{
    for (const ValueOption& option : kValueOptions)
        if (option.name == name)
            return &option;
    return nullptr;
}

/// An option without a value; false where `name` is none.
bool parseSwitch(std::string_view name, RenderOptions& options)
{
    if (name == "--validate")
        options.validate = true;
    else if (name == "-v" || name == "--verbose")
        options.verbose = true;
    else if (name == "-h" || name == "--help")
        options.help = true;
    else if (name == "--fit")
    {
        options.camera.reset();
        options.scene_camera.reset();
    }
    else
        return false;
    return true;
}

} // namespace

Result<RenderOptions> parseOptions(std::span<const char* const> arguments)
{
    RenderOptions options;
    for (size_t i = 0; i < arguments.size(); ++i)
    {
        std::string_view name = arguments[i];
        if (name.size() < 2 || name[0] != '-')
        {
            if (!options.pack.empty())
                return usage(quoted(name) + " is one file too many");
            options.pack = name;
            continue;
        }
        if (parseSwitch(name, options))
            continue;
        // --name value, or --name=value
        const size_t equals = name.starts_with("--") ? name.find('=') : std::string_view::npos;
        const ValueOption* option = findValueOption(name.substr(0, equals));
        if (option == nullptr)
            return usage("unknown option " + quoted(name));
        if (equals == std::string_view::npos && i + 1 == arguments.size())
            return usage(std::string(name) + " needs a value");
        HEARTH_TRY(option->parse(equals == std::string_view::npos ? arguments[++i] : name.substr(equals + 1),
                                 options));
    }
    if (options.help)
        return options;
    if (options.pack.empty())
        return usage("no pack is named");
    if (options.output.empty())
        return usage("no output is named (-o IMAGE.png)");
    if (!options.camera_path.empty() && options.frames != 1)
        return usage("--frames and --camera-path exclude each other");
    if (options.view == shared::kViewShadowMaps && options.shadows.options.max_maps == 0)
        return usage("--view shadow-maps needs --shadows");
    return options;
}

} // namespace hearth::viewer
