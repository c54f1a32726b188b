// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/draw_options.h"

#include "formats/base/text.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/text.h"

#include <algorithm>

namespace hearth::viewer
{

namespace
{

constexpr std::string_view kDrawHelp =
    "      --size WxH          pixels, default 1280x720\n"
    "      --camera PX,PY,PZ,TX,TY,TZ,FOV\n"
    "                          eye and target in metres, full vertical angle in degrees\n"
    "      --scene-camera N    the camera N of the pack, the first is 0\n"
    "      --fit               frame the whole scene (default)\n"
    "      --error-pixels E    largest error on the screen, default 1; 0 draws the source triangles\n"
    "      --lod-curve D:F,... factor F on the error at D metres, linear between; no factor may grow faster "
    "than\n"
    "                          the distance. Example: 0:1,50:1,500:0.4\n"
    "      --view VIEW         one of these:\n%VIEWS%"
    "      --ambient-occlusion MODE\n"
    "                          of the sky, in packs with visibility: exact (default), smoothstep, quadratic, "
    "off\n"
    "      --specular-occlusion MODE\n"
    "                          of the sky's mirror image, the same: fit (default), table (the pack's, else "
    "the fit),\n"
    "                          off\n"
    "      --gi off|on         global illumination, in packs with bricks (default: on); off: a constant "
    "sky\n"
    "      --lights METHOD     one of these:\n%LIGHTS%"
    "      --light-lists gpu|cpu\n"
    "                          which processor lists the lights of cells, default gpu; the lists are the "
    "same\n"
    "      --shadows SETTINGS  on (default), off, or some of maps=N (as many as the lights take, 64 at "
    "most),\n"
    "                          texels=N (1024), kernel=N (1: 3x3), depth=BITS (32; 16: half the memory, "
    "where that\n"
    "                          does not show, else 32), bias=B (2: how much coarser than the image), "
    "splits=N (4),\n"
    "                          near=M, far=M (metres, where the splits begin and end; as the scene does).\n"
    "                          Example: texels=2048,bias=4\n"
    "      --shadow-sphere X,Y,Z,RADIUS[,LIGHT]\n"
    "                          finer shadows there, of all lights or of one; may be given several times\n"
    "      --shaded-area AREA  where each material is shaded: frame, tiles (64x64 pixels where it is "
    "seen), "
    "or\n"
    "                          automatic (default), which takes tiles in scenes of many materials; the "
    "image\n"
    "                          stays the same\n"
    "      --materials depth|id\n"
    "                          how shading finds the pixels of a material: by the depth test, with numbers "
    "of "
    "materials\n"
    "                          in the depth (default), or by number, which keeps the depth; the image stays "
    "the "
    "same\n"
    "      --frame WAY         render passes of a frame: merged (subpasses), separate (for drivers that fail "
    "at "
    "subpasses\n"
    "                          or do not merge them), one-set (subpasses with one descriptor set), or "
    "automatic (default),\n"
    "                          which takes what is known to work on the device; the image stays the same\n"
    "      --cull TESTS        all (default), none, or some of instances,frustum,cone,occlusion; the "
    "image\n"
    "                          stays the same. last-frame: all, but hides what an earlier frame's depth "
    "hides, "
    "in one\n"
    "                          pass: what comes into view may be missing for a frame or two\n"
    "      --budget BYTES      stream the geometry through so much memory, K, M or G behind the number for "
    "KiB, MiB, "
    "GiB\n"
    "      --device NAME       part of the name of the graphics device\n"
    "      --validate          run the Vulkan validation layer; any message is an error\n"
    "  -v, --verbose           say which device draws\n"
    "  -h, --help\n";

/// Return the views with their notes, in lines of help.
std::string viewsHelp()
{
    constexpr size_t kIndent = 26, kWidth = 110;
    std::string text, line(kIndent, ' ');
    for (const shared::DebugView& view : shared::kDebugViews)
    {
        std::string item = view.name;
        if (view.note[0] != '\0')
            item += " (" + std::string(view.note) + ")";
        item += &view == &shared::kDebugViews.back() ? "" : ", ";
        if (line.size() + item.size() > kWidth)
        {
            text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
            line.assign(kIndent, ' ');
        }
        line += item;
    }
    return text + line + "\n";
}

/// Return the light methods in lines of help.
std::string lightMethodsHelp()
{
    constexpr size_t kIndent = 26, kNameWidth = 20;
    std::string text;
    for (const gpu::LightMethodFacts& method : gpu::kLightMethods)
    {
        std::string name(method.name);
        name.resize(std::max(kNameWidth, name.size() + 1), ' ');
        text += std::string(kIndent, ' ') + name + std::string(method.summary) + "\n";
    }
    return text;
}

Status parseLightMethod(std::string_view text, FrameSettings& settings)
{
    const std::optional<gpu::LightMethod> method = gpu::findLightMethod(text);
    if (!method)
    {
        std::string names;
        for (const gpu::LightMethodFacts& facts : gpu::kLightMethods)
            names += (names.empty() ? "" : ", ") + std::string(facts.name);
        return usageError("--lights: " + quoted(text) + " is none of " + names);
    }
    settings.light_method = *method;
    return success();
}

Status parseLightLister(std::string_view text, FrameSettings& settings)
{
    if (text != "gpu" && text != "cpu")
        return usageError("--light-lists: " + quoted(text) + " is neither gpu nor cpu");
    settings.light_lister = text == "cpu" ? gpu::LightLister::cpu : gpu::LightLister::gpu;
    return success();
}

/// Join names: "a, b, c".
template <typename T>
std::string list(std::span<const Named<T>> choices)
{
    std::string text;
    for (const Named<T>& choice : choices)
        text += (text.empty() ? "" : ", ") + std::string(choice.name);
    return text;
}

/// Return the value of that name, or nullptr.
template <typename T>
const T* findNamed(std::span<const Named<T>> choices, std::string_view name)
{
    const auto found =
        std::find_if(choices.begin(), choices.end(), [&](const Named<T>& c) { return c.name == name; });
    return found == choices.end() ? nullptr : &found->value;
}

template <typename T>
Status parseChoice(const std::string& option, std::span<const Named<T>> choices, std::string_view text,
                   T& value)
{
    const T* chosen = findNamed(choices, text);
    if (chosen == nullptr)
        return usageError(option + ": " + quoted(text) + " is none of " + list(choices));
    value = *chosen;
    return success();
}

Status parseSize(std::string_view text, DrawOptions& options)
{
    constexpr uint32_t kMaxSide = 16384;
    const auto parts = splitText(text, 'x');
    if (parts.size() == 2)
    {
        const auto width = parseNumber<uint32_t>(parts[0]);
        const auto height = parseNumber<uint32_t>(parts[1]);
        if (width && height && *width >= 1 && *height >= 1 && *width <= kMaxSide && *height <= kMaxSide)
        {
            options.width = *width;
            options.height = *height;
            return success();
        }
    }
    return usageError("--size: " + quoted(text) + " is not WxH with sides of 1 to 16384");
}

Status parseCameraOption(std::string_view text, DrawOptions& options)
{
    options.camera = parseCamera(text);
    if (!options.camera)
        return usageError("--camera: " + quoted(text) +
                          " is not PX,PY,PZ,TX,TY,TZ,FOV with eye and target apart and 1 to 170 degrees");
    return success();
}

Status parseSceneCamera(std::string_view text, DrawOptions& options)
{
    options.scene_camera = parseNumber<uint32_t>(text);
    if (!options.scene_camera)
        return usageError("--scene-camera: " + quoted(text) + " is not the index of a camera");
    return success();
}

Status parseCull(std::string_view text, FrameSettings& settings)
{
    settings.occludes_by_last_frame = text == "last-frame";
    settings.cull_flags = text == "all" || text == "last-frame" ? shared::kCullEverything : 0;
    if (settings.cull_flags != 0 || text == "none")
        return success();
    for (const std::string_view part : splitText(text, ','))
    {
        const uint32_t* test = findNamed(cullTestNames(), part);
        if (test == nullptr)
            return usageError("--cull: " + quoted(part) +
                              " is neither all nor none nor last-frame nor one of " + list(cullTestNames()));
        settings.cull_flags |= *test;
    }
    return success();
}

Status parseMaterialTest(std::string_view text, FrameSettings& settings)
{
    gpu::MaterialTest test{};
    HEARTH_TRY(parseChoice("--materials", materialTestNames(), text, test));
    settings.material_test = test;
    return success();
}

Status parseFrameWay(std::string_view text, FrameSettings& settings)
{
    return parseChoice("--frame", frameWayNames(), text, settings.way);
}

Status parseGi(std::string_view text, FrameSettings& settings)
{
    if (text != "on" && text != "off")
        return usageError("--gi: " + quoted(text) + " is neither off nor on");
    settings.gi = text == "on";
    return success();
}

Status parseErrorPixels(std::string_view text, FrameSettings& settings)
{
    const auto number = parseNumber<float>(text);
    if (!number || *number < 0)
        return usageError("--error-pixels: " + quoted(text) + " is not a number from 0");
    settings.error_pixels = *number;
    return success();
}

Status parseLodCurve(std::string_view text, FrameSettings& settings)
{
    settings.lod_curve.clear();
    for (const std::string_view part : splitText(text, ','))
    {
        const auto knot = splitText(part, ':');
        const auto distance = parseNumber<float>(knot.front());
        const auto factor = parseNumber<float>(knot.back());
        if (knot.size() != 2 || !distance || !factor)
            return usageError("--lod-curve: " + quoted(part) + " is not DISTANCE:FACTOR");
        settings.lod_curve.push_back({*distance, *factor});
    }
    shared::FrameView scratch{};
    if (const Status set = setLodCurve(scratch, settings.lod_curve); !set.ok())
        return usageError("--lod-curve: " + set.error().detail);
    return success();
}

Status parseBudget(std::string_view text, DrawOptions& options)
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
        return usageError("--budget: " + quoted(text) + " is not a number of bytes from 1 to 1024G");
    options.geometry_budget = *number << shift;
    return success();
}

} // namespace

std::string drawHelp()
{
    std::string help(kDrawHelp);
    const auto insert = [&](std::string_view mark, const std::string& lines)
    { help.replace(help.find(mark), mark.size(), lines); };
    insert("%VIEWS%", viewsHelp());
    insert("%LIGHTS%", lightMethodsHelp());
    return help;
}

void addDrawOptions(CommandLine& command_line, DrawOptions& options)
{
    FrameSettings& settings = options.settings;
    command_line.addValue("--size", [&](std::string_view text) { return parseSize(text, options); });
    command_line.addValue("--camera",
                          [&](std::string_view text) { return parseCameraOption(text, options); });
    command_line.addValue("--scene-camera",
                          [&](std::string_view text) { return parseSceneCamera(text, options); });
    command_line.addValue("--error-pixels",
                          [&](std::string_view text) { return parseErrorPixels(text, settings); });
    command_line.addValue("--lod-curve",
                          [&](std::string_view text) { return parseLodCurve(text, settings); });
    command_line.addValue("--view", [&](std::string_view text)
                          { return parseChoice("--view", viewNames(), text, settings.view); });
    command_line.addValue("--ambient-occlusion",
                          [&](std::string_view text) {
                              return parseChoice("--ambient-occlusion", ambientOcclusionNames(), text,
                                                 settings.ambient_occlusion);
                          });
    command_line.addValue("--specular-occlusion",
                          [&](std::string_view text) {
                              return parseChoice("--specular-occlusion", specularOcclusionNames(), text,
                                                 settings.specular_occlusion);
                          });
    command_line.addValue("--gi", [&](std::string_view text) { return parseGi(text, settings); });
    command_line.addValue("--lights",
                          [&](std::string_view text) { return parseLightMethod(text, settings); });
    command_line.addValue("--light-lists",
                          [&](std::string_view text) { return parseLightLister(text, settings); });
    command_line.addValue(
        "--shaded-area", [&](std::string_view text)
        { return parseChoice("--shaded-area", shadedAreaNames(), text, settings.shaded_area); });
    command_line.addValue("--materials",
                          [&](std::string_view text) { return parseMaterialTest(text, settings); });
    command_line.addValue("--frame", [&](std::string_view text) { return parseFrameWay(text, settings); });
    command_line.addValue("--shadows",
                          [&](std::string_view text) { return parseShadows(text, options.shadows); });
    command_line.addValue("--shadow-sphere",
                          [&](std::string_view text) { return parseShadowSphere(text, options.shadows); });
    command_line.addValue("--cull", [&](std::string_view text) { return parseCull(text, settings); });
    command_line.addValue("--budget", [&](std::string_view text) { return parseBudget(text, options); });
    command_line.addText("--device", options.device);
    command_line.addSwitch("--validate", options.validate);
    for (const char* name : {"-v", "--verbose"})
        command_line.addSwitch(name, options.verbose);
    for (const char* name : {"-h", "--help"})
        command_line.addSwitch(name, options.help);
    command_line.addSwitch("--fit",
                           [&]
                           {
                               options.camera.reset();
                               options.scene_camera.reset();
                           });
}

Status checkDrawOptions(const DrawOptions& options)
{
    if (options.settings.view == shared::kViewShadowMaps && options.shadows.options.max_maps == 0)
        return usageError("--view shadow-maps needs --shadows on");
    return success();
}

Status checkPack(const DrawOptions& options, const formats::PackView& pack)
{
    if (shared::viewNeedsBricks(options.settings.view) && pack.brickGrid().empty())
        return Error{Issue::usage, pack.name(), "",
                     "--view: the pack has no bricks (hearth cook --bricks makes them)"};
    return success();
}

Status parseFrames(std::string_view text, uint32_t& frames)
{
    const auto number = parseNumber<uint32_t>(text);
    if (!number || *number < 1 || *number > 10000)
        return usageError("--frames: " + quoted(text) + " is not a number from 1 to 10000");
    frames = *number;
    return success();
}

Result<shared::Camera> chooseCamera(const DrawOptions& options, const formats::PackView& pack,
                                    const pack::PosePlayer& player)
{
    if (options.camera)
        return *options.camera;
    if (!options.scene_camera)
        return fitCamera(pack, player,
                         static_cast<float>(options.width) / static_cast<float>(options.height));
    const std::span<const formats::CameraRecord> cameras = pack.cameras();
    if (*options.scene_camera >= cameras.size())
        return Error{Issue::usage, pack.name(), "",
                     "--scene-camera " + std::to_string(*options.scene_camera) + ": the pack has " +
                         std::to_string(cameras.size()) + " cameras"};
    if (cameras[*options.scene_camera].type != static_cast<uint32_t>(formats::CameraType::perspective))
        return Error{Issue::usage, pack.name(), "", "--scene-camera: only perspective cameras can be drawn"};
    return sceneCamera(pack, *options.scene_camera);
}

} // namespace hearth::viewer
