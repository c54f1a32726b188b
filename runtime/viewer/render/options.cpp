// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/render/options.h"

#include "runtime/viewer/text.h"

#include <algorithm>

namespace hearth::viewer
{

namespace
{

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
        return usageError("--hzb: " + quoted(text) + " is none of previous, none, noise:SEED");
    return success();
}

/// Parse "N,N,..."
Status parseMeshes(std::string_view text, RenderOptions& options)
{
    options.meshes.clear();
    for (size_t at = 0; at <= text.size();)
    {
        const size_t end = std::min(text.find(',', at), text.size());
        const auto number = parseNumber<uint32_t>(text.substr(at, end - at));
        if (!number)
            return usageError("--meshes: " + quoted(text) + " is not a list of numbers of meshes");
        options.meshes.push_back(*number);
        at = end + 1;
    }
    return success();
}

/// Parse "VIEW,VIEW,..."
Status parseViews(std::string_view text, RenderOptions& options)
{
    options.views.clear();
    for (size_t at = 0; at <= text.size();)
    {
        const size_t end = std::min(text.find(',', at), text.size());
        const std::string_view name = text.substr(at, end - at);
        const auto names = viewNames();
        const auto view = std::find_if(names.begin(), names.end(),
                                       [&](const Named<uint32_t>& known) { return known.name == name; });
        if (view == names.end() || view->value == shared::kViewOverdraw)
            return usageError("--views: " + quoted(name) + " is no view that can be drawn beside others");
        options.views.push_back(*view);
        at = end + 1;
    }
    return success();
}

Status parseSheet(std::string_view text, RenderOptions& options)
{
    if (text != "on" && text != "off")
        return usageError("--sheet: " + quoted(text) + " is neither on nor off");
    options.sheet = text == "on" ? SheetChoice::on : SheetChoice::off;
    return success();
}

Status parsePasses(std::string_view text, RenderOptions& options)
{
    if (text != "text" && text != "json")
        return usageError("--passes: " + quoted(text) + " is neither text nor json");
    options.passes = text == "text" ? PassesFormat::text : PassesFormat::json;
    return success();
}

Status parseAntiAliasing(std::string_view text, RenderOptions& options)
{
    if (text != "samples" && text != "temporal")
        return usageError("--anti-aliasing: " + quoted(text) + " is neither samples nor temporal");
    options.is_filtered = text == "temporal";
    return success();
}

/// Check what the temporal filter excludes, and set what it implies.
/// has_samples  --samples is given
Status checkFilter(RenderOptions& options, bool has_samples)
{
    if (!options.is_filtered)
        return success();
    if (has_samples && options.samples != 1)
        return usageError("--samples and --anti-aliasing temporal exclude each other");
    if (writesLinear(options) || options.settings.render_size)
        return usageError(
            "--anti-aliasing temporal excludes linear colours (-o IMAGE.exr) and --render-size");
    options.samples = 1;
    options.settings.is_filtered = true;
    return success();
}

Status parseSamples(std::string_view text, RenderOptions& options)
{
    const auto number = parseNumber<uint32_t>(text);
    if (!number || (*number != 1 && *number != 4 && *number != 16 && *number != 64))
        return usageError("--samples: " + quoted(text) + " is none of 1, 4, 16, 64");
    options.samples = *number;
    return success();
}

} // namespace

bool writesLinear(const RenderOptions& options)
{
    return options.output.ends_with(".exr");
}

bool fitsWholeScene(const RenderOptions& options)
{
    const auto viewNeedsBricks = [](const Named<uint32_t>& view)
    { return shared::viewNeedsBricks(view.value); };
    return !options.camera && !options.scene_camera && options.camera_path.empty() &&
           options.meshes.empty() && options.frames == 1 && !options.animation.clip &&
           options.visibility.empty() && !writesLinear(options) &&
           !shared::viewNeedsBricks(options.settings.view) &&
           std::none_of(options.views.begin(), options.views.end(), viewNeedsBricks);
}

std::string renderHelp()
{
    return std::string(
               "Usage: hearth-render PACK -o IMAGE.png [options]\n"
               "Draw a pack without a window.\n"
               "\n"
               "  -o, --output FILE       the image, PNG, or JPEG where it ends in .jpg; where it ends in "
               ".exr the\n"
               "                          linear colours as OpenEXR, in half floats: of the lit scene, "
               "without\n"
               "                          --exposure, --bloom, --photo-filter and tone curve\n") +
           drawHelp() +
           "\n"
           "      --camera-path FILE  an image for each line of FILE, written as for --camera: "
           "IMAGE-0000.png, ...\n"
           "      --meshes N,N,...    an image of each of these meshes alone, at its first instance:\n"
           "                          IMAGE-0000.png, ... in the order of the list\n"
           "      --sheet on|off      a contact sheet: each asset of the pack alone in a cell, with its name "
           "and size;\n"
           "                          the default if they overlap and no option says what to draw\n"
           "      --views VIEW,...    each image in each of these views: IMAGE-VIEW.png, or "
           "IMAGE-VIEW-0000.png;\n"
           "                          not overdraw\n"
           "      --animation CLIP    in the pose of a clip, by its name or number\n"
           "      --time SECONDS      of the clip and of flickering lights, default 0; beyond its keys a "
           "clip "
           "rests\n"
           "      --blend CLIP,SECONDS,WEIGHT\n"
           "                          a second clip, and how much of it, 0 to 1\n"
           "      --time-step SECONDS by which all times go on from frame to frame of --camera-path or "
           "--frames\n"
           "      --samples N         of each pixel: 1, 4 (the default), 16 or 64: smoother leaves and "
           "wires\n"
           "      --anti-aliasing samples|temporal\n"
           "                          temporal: filter 32 frames of one sample, as games do; of a camera "
           "path "
           "32 of the\n"
           "                          first image, then one an image\n"
           "      --stats FILE        counts and times of the passes as JSON\n"
           "      --frames N          draw N times; the times are medians\n"
           "      --dump-visibility FILE\n"
           "                          what each pixel shows: \"HVIS\", then 32-bit words: width, height, "
           "slot count;\n"
           "                          instance and cluster of each slot; for each pixel slot * 128 + "
           "triangle or -1\n"
           "      --hzb START         the depths that occlusion culling starts a frame with: previous "
           "(default), none,\n"
           "                          or noise:SEED; the image stays the same\n"
           "      --passes text|json  print the passes of a frame, what each loads and stores, bytes a "
           "pixel, "
           "warnings\n"
           "                          and memory, and draw nothing\n"
           "      --name-device       print which device would draw, and draw nothing; needs no pack\n"
           "\n"
           "With --budget an image waits for all that it wants, those of a camera path do not.\n"
           "Example: hearth-render rock.hearth -o rock.png --size 1920x1080 --samples 16\n"
           "Exit codes: 0, 2 usage, 65 malformed pack, 66 missing, 70 no device or a defect, 73 cannot "
           "write, 74 I/O\n";
}

Result<RenderOptions> parseRenderOptions(std::span<const char* const> arguments)
{
    RenderOptions options;
    CommandLine command_line;
    addDrawOptions(command_line, options);
    for (const char* name : {"-o", "--output"})
        command_line.addText(name, options.output);
    command_line.addText("--camera-path", options.camera_path);
    command_line.addValue("--meshes", [&](std::string_view text) { return parseMeshes(text, options); });
    command_line.addValue("--views", [&](std::string_view text) { return parseViews(text, options); });
    command_line.addValue("--sheet", [&](std::string_view text) { return parseSheet(text, options); });
    addAnimationOptions(command_line, options.animation);
    bool has_samples = false;
    command_line.addValue("--samples",
                          [&](std::string_view text)
                          {
                              has_samples = true;
                              return parseSamples(text, options);
                          });
    command_line.addValue("--anti-aliasing",
                          [&](std::string_view text) { return parseAntiAliasing(text, options); });
    command_line.addText("--stats", options.stats);
    command_line.addValue("--frames",
                          [&](std::string_view text) { return parseFrames(text, options.frames); });
    command_line.addText("--dump-visibility", options.visibility);
    command_line.addValue("--hzb", [&](std::string_view text) { return parsePyramid(text, options); });
    command_line.addValue("--passes", [&](std::string_view text) { return parsePasses(text, options); });
    command_line.addSwitch("--name-device", options.print_device_name);
    HEARTH_TRY(command_line.parse(arguments, options.pack));
    if (options.help || options.print_device_name)
        return options;
    if (options.pack.empty())
        return usageError("no pack is named");
    if (!options.visibility.empty() && has_samples && options.samples != 1)
        return usageError("--dump-visibility needs --samples 1: it shows one triangle in each pixel");
    if (!options.visibility.empty())
        options.samples = 1;
    HEARTH_TRY(checkFilter(options, has_samples));
    options.settings.keeps_radiance = writesLinear(options);
    if (writesLinear(options) && (options.settings.view != shared::kViewFinal || !options.views.empty() ||
                                  options.settings.render_size))
        return usageError("--view, --views and --render-size draw no linear colours (-o IMAGE.exr)");
    HEARTH_TRY(checkDrawOptions(options));
    if (options.output.empty() && options.passes == PassesFormat::none)
        return usageError("no output is named (-o IMAGE.png)");
    if (!options.animation.clip && options.animation.blended)
        return usageError("--blend needs --animation");
    if (!options.camera_path.empty() && options.frames != 1)
        return usageError("--frames and --camera-path exclude each other");
    if (!options.views.empty() && options.frames != 1)
        return usageError("--views and --frames exclude each other");
    if (!options.meshes.empty() && (!options.camera_path.empty() || options.frames != 1 || options.camera ||
                                    options.scene_camera || options.animation.clip))
        return usageError("--meshes excludes cameras, --frames and --animation");
    if (options.sheet == SheetChoice::on && !fitsWholeScene(options))
        return usageError("--sheet on excludes cameras, --meshes, --frames, --animation, --dump-visibility, "
                          "OpenEXR and views "
                          "of bricks");
    return options;
}

} // namespace hearth::viewer
