// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/extract/extract.h"
#include "pipelines/command/extract/extract_bricks.h"
#include "pipelines/command/extract/extract_gltf.h"
#include "pipelines/command/extract/extract_probe.h"
#include "pipelines/command/extract/extract_proxy.h"
#include "pipelines/command/extract/extract_receivers.h"
#include "pipelines/command/extract/extract_specular.h"
#include "pipelines/command/extract/extract_texture.h"
#include "pipelines/command/shell/verb_tools.h"
#include "pipelines/command/shell/verbs.h"

#include <cmath>

namespace hearth::command
{

void addExtract(cli::CommandLine& app, VerbAction& run)
{
    cli::CommandLine& verb = app.addSubcommand(
        "extract", "Write a pack as glTF, a level of detail of a mesh or its proxy as PLY, a "
                   "texture as KTX2, a light probe, receivers, or a table as CSV");
    struct Options
    {
        std::string file;
        uint32_t mesh = 0;
        float error = 0;
        bool has_lods = false;
        std::string part;
        std::string animation;
        double time = 0;
        TextureExtraction texture;
        std::optional<uint32_t> probe;
        uint32_t proxy = 0;
        std::string texel_format;
        std::string output;
    };
    auto options = std::make_shared<Options>();
    verb.addOption("FILE", options->file, "pack").required();
    const cli::Option mesh =
        verb.addOption("--mesh", options->mesh, "index of the mesh; without it a .glb has the whole scene");
    const cli::Option error =
        verb.addOption("--error", options->error,
                       "largest error in the mesh's own units; 0: the source's triangles, as in a .glb "
                       "without it");
    cli::Option lods =
        verb.addFlag("--lods", options->has_lods, "add the coarser levels to a .glb, as MSFT_lod");
    const cli::Option part =
        verb.addOption("--part", options->part,
                       "instead of a mesh; specular: its table, bricks: the faces of all solid voxels")
            .choices({"specular", "bricks"})
            .excludes(mesh);
    const cli::Option texture =
        verb.addOption("--texture", options->texture.texture,
                       "instead of a mesh; a texture with its mips: its name, or its index if it has none")
            .excludes(mesh)
            .excludes(part);
    const cli::Option probe =
        verb.addOptionalNumber("--probe", options->probe, "all",
                               "instead of a mesh; all light probes, or the one of an index: .csv means and "
                               "extremes of their mips, .exr and .png the faces of one side by side")
            .excludes(mesh)
            .excludes(part)
            .excludes(texture);
    const cli::Option proxy = verb.addOption("--proxy", options->proxy,
                                             "instead of a mesh; the proxy of an index, as .ply, or as .obj "
                                             "with a group for each material")
                                  .excludes(mesh)
                                  .excludes(part)
                                  .excludes(texture)
                                  .excludes(probe);
    const cli::Option receivers =
        verb.addFlag("--receivers",
                     "instead of a mesh; the baked light of receivers with all lamps on, as .exr or .png")
            .excludes(mesh)
            .excludes(part)
            .excludes(texture)
            .excludes(probe)
            .excludes(proxy);
    verb.addOption("--as", options->texel_format, "decode the texture, for programs that lack its format")
        .choices({"rgba8"})
        .needs(texture);
    verb.addFlag("--zstd", options->texture.is_compressed, "compress each mip of the texture").needs(texture);
    cli::Option animation = verb.addOption("--animation", options->animation,
                                           "clip that poses the mesh: its name, or its index if it has none");
    animation.needs(mesh);
    verb.addOption("--time", options->time, "seconds from the start of the clip").needs(animation);
    verb.addOption("-o,--output", options->output, "GLB, PLY, OBJ, KTX2, CSV, EXR or PNG file to write")
        .required();
    verb.setFooter("Examples:\n"
                   "  hearth extract village.hearth -o village.glb\n"
                   "  hearth extract village.hearth --mesh 0 --error 0.01 -o cut.ply");
    verb.setCheck(
        [options, mesh, error, lods, animation, part, texture, probe, proxy, receivers]
        {
            const size_t others =
                part.count() + texture.count() + probe.count() + proxy.count() + receivers.count();
            if (isGltfName(options->output))
                return others > 0              ? "a .glb holds meshes: leave --part, --texture, --probe, "
                                                 "--proxy and --receivers out, or write another kind of file"
                       : animation.count() > 0 ? "a .glb holds all clips: leave --animation out"
                                               : "";
            if (lods.count() > 0)
                return "--lods needs an output that ends in .glb";
            if (mesh.count() + others == 0)
                return "--mesh is required, or an output that ends in .glb";
            if (mesh.count() > 0 && error.count() == 0)
                return "--mesh requires --error";
            return error.count() > 0 && mesh.count() == 0 ? "--error requires --mesh" : "";
        });
    verb.setAction(
        [options, mesh, part, texture, probe, proxy, receivers, animation, &run]
        {
            run = [options, mesh, part, texture, probe, proxy, receivers, animation]
            {
                if (receivers.count() > 0)
                {
                    const Status status = extractReceivers(options->file, options->output);
                    return status.ok() ? 0 : printError(status.error());
                }
                if (proxy.count() > 0)
                {
                    const Status status = extractProxy(options->file, options->proxy, options->output);
                    return status.ok() ? 0 : printError(status.error());
                }
                if (probe.count() > 0)
                {
                    const Status status = extractProbe(options->file, options->probe, options->output);
                    return status.ok() ? 0 : printError(status.error());
                }
                if (texture.count() > 0)
                {
                    options->texture.is_decoded = !options->texel_format.empty();
                    const Status status = extractTexture(options->file, options->texture, options->output);
                    return status.ok() ? 0 : printError(status.error());
                }
                if (part.count() > 0)
                {
                    const Status status = options->part == "bricks"
                                              ? extractBricks(options->file, options->output)
                                              : extractSpecular(options->file, options->output);
                    return status.ok() ? 0 : printError(status.error());
                }
                if (!(options->error >= 0) || !std::isfinite(options->error))
                    return printUsageError("--error must be a number from 0 on");
                if (!std::isfinite(options->time))
                    return printUsageError("--time must be a number");
                if (isGltfName(options->output))
                {
                    const auto cut = mesh.count() > 0 ? std::optional(options->mesh) : std::nullopt;
                    return printResult(extractGltf(options->file, {cut, options->error, options->has_lods},
                                                   options->output));
                }
                std::optional<ClipTime> clip;
                if (animation.count() > 0)
                    clip = ClipTime{options->animation, options->time};
                const Status status =
                    extractCut(options->file, options->mesh, options->error, clip, options->output);
                return status.ok() ? 0 : printError(status.error());
            };
        });
}

} // namespace hearth::command
