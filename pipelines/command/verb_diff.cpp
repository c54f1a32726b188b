// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/open_pack.h"
#include "pipelines/command/pack_diff.h"
#include "pipelines/command/picture_diff.h"
#include "pipelines/command/verb_tools.h"
#include "pipelines/command/verbs.h"

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
    std::string picture; ///< empty: none
    std::string camera;
    std::string scene_camera;
    std::string size = "1280x720";
    std::string view = "final";
};

PictureOptions pictureOptions(const DiffOptions& options)
{
    PictureOptions picture{options.picture, {"--size", options.size, "--view", options.view}};
    const bool is_of_scene = options.camera.empty();
    picture.view.insert(picture.view.end(), {is_of_scene ? "--scene-camera" : "--camera",
                                             is_of_scene ? options.scene_camera : options.camera});
    return picture;
}

int diff(const DiffOptions& options)
{
    const auto a = openPack(options.a);
    if (!a.ok())
        return fail(a.error());
    const auto b = openPack(options.b);
    if (!b.ok())
        return fail(b.error());
    const Result<PackDiff> difference = diffPacks(*a, *b);
    if (!difference.ok())
        return fail(difference.error());
    PictureFigures picture;
    if (!options.picture.empty())
    {
        const PictureDiff drawn = diffPictures(options.a, options.b, pictureOptions(options));
        if (drawn.exit_code != 0)
        {
            std::fprintf(stderr, "%s\n", drawn.error.c_str());
            return drawn.exit_code;
        }
        picture = {options.picture, drawn.figures};
    }
    const int printed =
        printResult(options.format == "json" ? diffJson(*difference, options.a, options.b, picture)
                                             : diffText(*difference, picture));
    return printed == 0 && !difference->isSame() ? kDifferent : printed;
}

} // namespace

void addDiff(cli::CommandLine& app, Work& run)
{
    cli::CommandLine& verb =
        app.addSubcommand("diff", "Say what differs between two packs, by what it means");
    auto options = std::make_shared<DiffOptions>();
    verb.addOption("A", options->a, "pack").required();
    verb.addOption("B", options->b, "pack").required();
    addFormat(verb, options->format);
    const cli::Option picture = verb.addOption("--picture", options->picture,
                                               "draw both, and write a heat map of how they differ: a PNG");
    const cli::Option camera =
        verb.addOption("--camera", options->camera,
                       "PX,PY,PZ,TX,TY,TZ,FOV: from where it is drawn, as for hearth-render")
            .needs(picture);
    const cli::Option scene_camera = verb.addOption("--scene-camera", options->scene_camera,
                                                    "N: from the packs' own cameras of that number")
                                         .needs(picture)
                                         .excludes(camera);
    verb.addOption("--size", options->size, "of the picture").needs(picture).showDefault();
    verb.addOption("--view", options->view, "what is drawn: final, clusters, lod, ...")
        .needs(picture)
        .showDefault();
    verb.setFooter("Examples:\n"
                   "  hearth diff before.hearth after.hearth\n"
                   "  hearth diff before.hearth after.hearth --picture heat.png --scene-camera 0\n"
                   "Exit code 0: they are the same; 1: they differ.");
    verb.setAction(
        [options, camera, scene_camera, &run]
        {
            run = [options, camera, scene_camera]
            {
                if (!options->picture.empty() && camera.count() + scene_camera.count() == 0)
                    return usageError("--picture needs --camera or --scene-camera");
                return diff(*options);
            };
        });
}

} // namespace hearth::command
