// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/open_pack.h"
#include "pipelines/command/inspect/diff_camera.h"
#include "pipelines/command/inspect/image_diff.h"
#include "pipelines/command/inspect/pack_diff.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

#include <cstdio>

namespace hearth::command
{

namespace
{

constexpr int kDifferent = 1;

struct DiffOptions
{
    std::string a;
    std::string b;
    std::string format = "text";
    bool shows_hashes = false;
    std::string image; ///< empty: none
    std::string camera;
    std::string scene_camera;
    std::string size = "1280x720";
    std::string view = "final";
};

ImageDiffOptions makeImageDiffOptions(const DiffOptions& options, const formats::PackView& a,
                                      const formats::PackView& b)
{
    ImageDiffOptions image{options.image, {"--size", options.size, "--view", options.view}};
    if (!options.scene_camera.empty())
        image.view.insert(image.view.end(), {"--scene-camera", options.scene_camera});
    else
        image.view.insert(
            image.view.end(),
            {"--camera", options.camera.empty() ? makeDiffCamera(a, b, options.size) : options.camera});
    return image;
}

int diff(const DiffOptions& options)
{
    const auto a = openPack(options.a);
    if (!a.ok())
        return printError(a.error());
    const auto b = openPack(options.b);
    if (!b.ok())
        return printError(b.error());
    const Result<PackDiff> difference = diffPacks(*a, *b);
    if (!difference.ok())
        return printError(difference.error());
    ImageFigures image;
    if (!options.image.empty())
    {
        const ImageDiff drawn = diffImages(options.a, options.b, makeImageDiffOptions(options, *a, *b));
        if (drawn.exit_code != 0)
        {
            std::fprintf(stderr, "%s\n", drawn.error.c_str());
            return drawn.exit_code;
        }
        image = {options.image, drawn.figures};
    }
    const int printed =
        printResult(options.format == "json" ? diffJson(*difference, options.a, options.b, image)
                                             : diffText(*difference, image, options.shows_hashes));
    return printed == 0 && !difference->isSame() ? kDifferent : printed;
}

} // namespace

void addDiff(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("diff", "Say what differs between two packs, by what it means");
    auto options = std::make_shared<DiffOptions>();
    verb.addOption("A", options->a, "pack").required();
    verb.addOption("B", options->b, "pack").required();
    addFormat(verb, options->format);
    verb.addFlag("--hashes", options->shows_hashes,
                 "show the hashes of texels, geometry and the like, not only that they differ");
    const cli::Option image = verb.addOption("--image", options->image,
                                             "draw both, and write a heat map of how they differ: a PNG; "
                                             "all of the scene is in view, unless a camera is given");
    const cli::Option camera =
        verb.addOption("--camera", options->camera,
                       "PX,PY,PZ,TX,TY,TZ,FOV: from where it is drawn, as for hearth-render")
            .needs(image);
    verb.addOption("--scene-camera", options->scene_camera, "N: from the packs' own cameras of that number")
        .needs(image)
        .excludes(camera);
    verb.addOption("--size", options->size, "of the image").needs(image).showDefault();
    verb.addOption("--view", options->view, "what is drawn: final, clusters, lod, ...")
        .needs(image)
        .showDefault();
    verb.setFooter("Examples:\n"
                   "  hearth diff before.hearth after.hearth\n"
                   "  hearth diff before.hearth after.hearth --image heat.png\n"
                   "Exit code 0: they are the same; 1: they differ.");
    verb.setAction([options, &run] { run = [options] { return diff(*options); }; });
}

} // namespace hearth::command
