// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/draw_options.h"

#include "formats/base/text.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

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
    "      --prepass exact|classic|encoded\n"
    "                          as --lights prepass, classic-prepass, encoded-prepass; hearth-render prints "
    "how far\n"
    "                          the images of the last two are off\n"
    "      --daylight ELEVATION,AZIMUTH[,TURBIDITY]\n"
    "                          sun and clear sky in place of the scene's: degrees of the sun above the "
    "horizon, and\n"
    "                          from -z towards +x; haze from 2.5 to 8 (default 3: clear)\n"
    "      --light NAME=SCALE  a light by its name, SCALE times as bright: a number, or R,G,B; its baked "
    "light too,\n"
    "                          and that of a mesh that emits; may be given several times\n"
    "      --light-lists gpu|cpu\n"
    "                          which processor lists the lights of cells, default gpu; the lists are the "
    "same\n"
    "      --receiver-update compute|points\n"
    "                          how texels of baked light are written, default compute; they are the same\n"
    "      --shadows SETTINGS  on (default), off, or some of maps=N (as many as the lights take, 64 at "
    "most),\n"
    "                          texels=N (1024), kernel=N (1: 3x3), depth=BITS (32; 16: half the memory, "
    "where that\n"
    "                          does not show, else 32), bias=B (2: how much coarser than the image), "
    "splits=N (4),\n"
    "                          near=M, far=M (metres, where the splits begin and end; as the scene does).\n"
    "                          Example: texels=2048,bias=4\n"
    "      --shadow-casters clusters|proxies\n"
    "                          what casts shadows, default clusters; proxies: of rigid, opaque meshes that "
    "have one\n"
    "                          (hearth cook --proxy-from); faster where they have fewer triangles than the "
    "image\n"
    "      --shadow-sphere X,Y,Z,RADIUS[,LIGHT]\n"
    "                          finer shadows there, of all lights or of one; may be given several times\n"
    "      --exposure STOPS|auto[,STOPS]\n"
    "                          brightness in stops, 1 is twice as bright; auto: follows the light of the "
    "image\n"
    "      --bloom STRENGTH[,add]\n"
    "                          glow of bright parts: the share of the light that spreads, 0.05 shows; add: "
    "without\n"
    "                          taking it away\n"
    "      --photo-filter RRGGBB[,DENSITY]\n"
    "                          coloured glass before the lens, as bright: colour in hexadecimal sRGB, "
    "density "
    "0 to 1\n"
    "                          (default 0.25). Example: ec8a00 is warm\n"
    "      --render-size WxH   draw so many pixels, and enlarge or reduce them to --size\n"
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
    "      --budget BYTES      stream geometry and textures through so much memory, K, M or G behind the "
    "number "
    "for KiB, MiB, GiB\n"
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

Result<VkExtent2D> parseSize(const std::string& option, std::string_view text)
{
    constexpr uint32_t kMaxSide = 16384;
    const auto parts = splitText(text, 'x');
    if (parts.size() == 2)
    {
        const auto width = parseNumber<uint32_t>(parts[0]);
        const auto height = parseNumber<uint32_t>(parts[1]);
        if (width && height && *width >= 1 && *height >= 1 && *width <= kMaxSide && *height <= kMaxSide)
            return VkExtent2D{*width, *height};
    }
    return usageError(option + ": " + quoted(text) + " is not WxH with sides of 1 to 16384");
}

Status parseImageSize(std::string_view text, DrawOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(const VkExtent2D size, parseSize("--size", text));
    options.width = size.width;
    options.height = size.height;
    return success();
}

Status parseRenderSize(std::string_view text, FrameSettings& settings)
{
    HEARTH_ASSIGN_OR_RETURN(settings.render_size, parseSize("--render-size", text));
    return success();
}

Status parseExposure(std::string_view text, gpu::PostSettings& post)
{
    constexpr float kMaxStops = 32; // beyond, half floats have no light left to show
    const auto parts = splitText(text, ',');
    const bool is_automatic = parts.front() == "auto";
    const auto stops =
        is_automatic && parts.size() == 1 ? std::optional(0.0f) : parseNumber<float>(parts.back());
    if (!stops || std::abs(*stops) > kMaxStops || parts.size() > (is_automatic ? 2u : 1u))
        return usageError("--exposure: " + quoted(text) +
                          " is no number from -32 to 32, nor auto, nor auto and such a number");
    post.exposure_stops = *stops;
    post.automatic_exposure.reset();
    if (is_automatic)
        post.automatic_exposure.emplace();
    return success();
}

Status parseBloom(std::string_view text, gpu::Bloom& bloom)
{
    const auto parts = splitText(text, ',');
    const auto strength = parseNumber<float>(parts.front());
    const bool adds = parts.size() == 2 && parts.back() == "add";
    if (!strength || *strength < 0 || *strength > 1 || (parts.size() > 1 && !adds))
        return usageError("--bloom: " + quoted(text) + " is no number from 0 to 1, or one with \",add\"");
    bloom = {*strength, adds ? gpu::BloomMode::add : gpu::BloomMode::mix};
    return success();
}

/// Parse "RRGGBB" of hexadecimal digits in sRGB. Returns a linear colour.
std::optional<Float3> parseColor(std::string_view text)
{
    uint32_t digits = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), digits, 16);
    if (text.size() != 6 || error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    const auto linear = [&](uint32_t shift)
    {
        const float encoded = static_cast<float>(digits >> shift & 255u) / 255;
        return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
    };
    return Float3{linear(16), linear(8), linear(0)};
}

Status parsePhotoFilter(std::string_view text, gpu::PhotoFilter& filter)
{
    constexpr float kUsualDensity = 0.25f; // of image editors
    const auto parts = splitText(text, ',');
    const std::optional<Float3> color = parseColor(parts.front());
    const auto density = parts.size() == 1 ? std::optional(kUsualDensity) : parseNumber<float>(parts.back());
    if (!color || parts.size() > 2 || !density || *density < 0 || *density > 1)
        return usageError("--photo-filter: " + quoted(text) + " is not RRGGBB[,DENSITY]");
    filter = {*color, *density};
    return success();
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

Status parseDaylight(std::string_view text, std::optional<shared::Daylight>& daylight)
{
    const auto numbers = parseNumbers(text);
    if (!numbers || numbers->size() < 2 || numbers->size() > 3)
        return usageError("--daylight: " + quoted(text) +
                          " is not ELEVATION,AZIMUTH or ELEVATION,AZIMUTH,TURBIDITY");
    shared::Daylight parsed{.elevation_deg = numbers->at(0), .azimuth_deg = numbers->at(1)};
    if (numbers->size() == 3)
        parsed.turbidity = numbers->at(2);
    if (const Status checked = shared::checkDaylight(parsed); !checked.ok())
        return usageError("--daylight: " + checked.error().detail);
    daylight = parsed;
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
    options.memory_budget = *number << shift;
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
    command_line.addValue("--size", [&](std::string_view text) { return parseImageSize(text, options); });
    command_line.addValue("--render-size",
                          [&](std::string_view text) { return parseRenderSize(text, settings); });
    command_line.addValue("--exposure",
                          [&](std::string_view text) { return parseExposure(text, settings.post); });
    command_line.addValue("--bloom",
                          [&](std::string_view text) { return parseBloom(text, settings.post.bloom); });
    command_line.addValue("--photo-filter", [&](std::string_view text)
                          { return parsePhotoFilter(text, settings.post.photo_filter); });
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
    command_line.addValue("--daylight",
                          [&](std::string_view text) { return parseDaylight(text, options.daylight); });
    command_line.addValue("--light", [&](std::string_view text) { return parseLamp(text, options.lamps); });
    command_line.addValue("--lights",
                          [&](std::string_view text) {
                              return parseChoice("--lights", lightMethodNames(), text, settings.light_method);
                          });
    command_line.addValue("--prepass",
                          [&](std::string_view text)
                          {
                              static constexpr Named<gpu::LightMethod> kMethods[] = {
                                  {"exact", gpu::LightMethod::prepass},
                                  {"classic", gpu::LightMethod::classic_prepass},
                                  {"encoded", gpu::LightMethod::encoded_prepass}};
                              return parseChoice("--prepass",
                                                 std::span<const Named<gpu::LightMethod>>(kMethods), text,
                                                 settings.light_method);
                          });
    command_line.addValue(
        "--light-lists", [&](std::string_view text)
        { return parseChoice("--light-lists", lightListerNames(), text, settings.light_lister); });
    command_line.addValue(
        "--receiver-update", [&](std::string_view text)
        { return parseChoice("--receiver-update", receiverUpdateNames(), text, settings.receiver_update); });
    command_line.addValue(
        "--shaded-area", [&](std::string_view text)
        { return parseChoice("--shaded-area", shadedAreaNames(), text, settings.shaded_area); });
    command_line.addValue("--materials",
                          [&](std::string_view text) { return parseMaterialTest(text, settings); });
    command_line.addValue("--frame", [&](std::string_view text) { return parseFrameWay(text, settings); });
    command_line.addValue("--shadows",
                          [&](std::string_view text) { return parseShadows(text, options.shadows); });
    command_line.addValue("--shadow-casters",
                          [&](std::string_view text) { return parseShadowCasters(text, options.shadows); });
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
    const gpu::LightMethodFacts& lights = gpu::lightMethodFacts(options.settings.light_method);
    if (lights.path != gpu::LightPath::materials &&
        options.settings.material_test == gpu::MaterialTest::depth)
        return usageError("--lights " + std::string(lights.name) +
                          " needs --materials id: its lights read the depth of the scene");
    return success();
}

Status checkPack(const DrawOptions& options, const formats::PackView& pack)
{
    if (shared::viewNeedsBricks(options.settings.view) && pack.brickGrid().empty())
        return Error{Issue::usage, pack.name(), "",
                     "--view: the pack has no bricks (hearth cook --bricks makes them)"};
    if (options.settings.view == shared::kViewReceivers && pack.receiverAtlases().empty())
        return Error{Issue::usage, pack.name(), "", "--view: the pack has no receivers of baked light"};
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
    return sceneCamera(pack, *options.scene_camera);
}

} // namespace hearth::viewer
