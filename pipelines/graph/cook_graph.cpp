// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/cook_graph.h"

#include "cook/tools/lod_files.h"
#include "pipelines/graph/estimate.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::graph
{

namespace
{

/// Return the command-line flags of hearth-visibility.
std::vector<std::string> visibilityFlags(const VisibilityOptions& options)
{
    std::vector<std::string> flags{"--quality", options.quality, "--occluders", options.occluders};
    if (options.distance > 0)
        flags.insert(flags.end(), {"--distance", fmt::format("{}", options.distance), "--power",
                                   fmt::format("{}", options.power)});
    for (const std::string& pose : options.poses)
        flags.insert(flags.end(), {"--poses", pose});
    if (options.refine)
        flags.emplace_back("--refine-cones");
    return flags;
}

Action makeAction(const std::string& cooker, size_t source, const std::string& subject)
{
    Action action;
    action.cooker = cooker;
    action.source = source;
    action.subject = subject;
    return action;
}

void addFlags(Action& action, const std::vector<std::string>& flags)
{
    for (const std::string& flag : flags)
        action.words.push_back({Word::Kind::text, flag, 0});
}

void addInput(Action& action, Input input, const std::string& before_path = "")
{
    action.words.push_back({Word::Kind::input, before_path, action.inputs.size()});
    action.inputs.push_back(std::move(input));
}

void addOutput(Action& action, const std::string& flag, const std::string& name)
{
    action.words.push_back({Word::Kind::text, flag, 0});
    action.words.push_back({Word::Kind::output, "", action.outputs.size()});
    action.outputs.push_back(name);
}

/// Return an input that is the first output of an earlier action.
Input partInput(const Graph& graph, size_t action)
{
    return {"part of " + graph.actions[action].cooker, action, ""};
}

/// Return partInput with the source's index in its role, for actions that read parts of several sources.
Input sourcePartInput(const Graph& graph, size_t action)
{
    Input part = partInput(graph, action);
    part.role += fmt::format(" {}", graph.actions[action].source);
    return part;
}

/// Append the source's actions and return the indices of the actions whose parts the link reads, in this
/// order: import, clusters (visibility, where enabled), textures, skinning. errors: those of parseLodFiles.
Result<std::vector<size_t>> addSource(Graph& graph, size_t index, const CookSettings& settings)
{
    const std::string& source = settings.sources[index];
    const SourceSettings arguments =
        settings.settings_of_source.empty() ? SourceSettings() : settings.settings_of_source[index];
    HEARTH_ASSIGN_OR_RETURN(const std::vector<tools::LodFile> lods,
                            tools::parseLodFiles(settings.lods_of_source.empty()
                                                     ? std::vector<std::string>()
                                                     : settings.lods_of_source[index]));
    /// Add an action that runs hearth-`kind` over the parts of earlier actions.
    const auto add = [&](const std::string& kind, const std::vector<size_t>& inputs)
    {
        Action action = makeAction(kind, index, source);
        for (const size_t input : inputs)
            addInput(action, partInput(graph, input));
        if (inputs.empty())
            addInput(action, {"source", kNoAction, source});
        addOutput(action, "-o", kind + ".part");
        graph.actions.push_back(std::move(action));
        return graph.actions.size() - 1;
    };
    std::vector<Action>& actions = graph.actions;

    const size_t import_action = add("import", {});
    actions[import_action].finds_files = true;
    for (const tools::LodFile& lod : lods)
    {
        addFlags(actions[import_action], {"--lod"});
        addInput(actions[import_action], {fmt::format("lod {}", lod.level), kNoAction, lod.path},
                 fmt::format("{}=", lod.level));
    }
    addFlags(actions[import_action], arguments.import);
    const size_t textures = add("textures", {import_action});
    addFlags(actions[textures], arguments.textures);
    const size_t clusters = add("clusters", {import_action});
    addFlags(actions[clusters], arguments.clusters);
    addOutput(actions[import_action], "--stats", kImportStatistics);
    addOutput(actions[textures], "--stats", kTexturesStatistics);
    addOutput(actions[clusters], "--stats", kClustersStatistics);
    // the comparison with discrete LODs and the noise estimate for rays would take a third as long as the
    // work itself
    addFlags(actions[clusters], {"--no-manual-lods"});
    const size_t skinning = add("skinning", {import_action, clusters});
    if (!arguments.visibility)
        return std::vector{import_action, clusters, textures, skinning};
    addFlags(actions[clusters], {"--visibility"});
    const size_t visibility = add("visibility", {import_action, clusters});
    actions[visibility].depends_on_processor = true;
    addFlags(actions[visibility], visibilityFlags(*arguments.visibility));
    addOutput(actions[visibility], "--stats", kVisibilityStatistics);
    addFlags(actions[visibility], {"--no-noise-estimate"});
    addOutput(actions[visibility], "--picture", kVisibilityPicture);
    return std::vector{import_action, visibility, textures, skinning};
}

/// Add the action that makes the specular table, which shading with visibility needs; it depends on no
/// source.
size_t addSpecular(Graph& graph, const CookSettings& settings)
{
    Action specular = makeAction("specular", settings.sources.size(), settings.output);
    addOutput(specular, "-o", "specular.part");
    graph.actions.push_back(std::move(specular));
    return graph.actions.size() - 1;
}

/// Add the action that makes the grid of bricks of all sources' scenes.
size_t addBricks(Graph& graph, const CookSettings& settings)
{
    Action bricks = makeAction("bricks", settings.sources.size(), settings.output);
    for (size_t source = 0; source < settings.sources.size(); ++source)
        for (const char* kind : {"import", "clusters", "textures"})
            for (size_t i = 0; i < graph.actions.size(); ++i)
                if (graph.actions[i].source == source && graph.actions[i].cooker == kind)
                    addInput(bricks, sourcePartInput(graph, i));
    addOutput(bricks, "-o", "bricks.part");
    if (settings.bricks->voxel_size)
        addFlags(bricks, {"--voxel-size", fmt::format("{}", *settings.bricks->voxel_size)});
    if (settings.bricks->memory_bytes)
        addFlags(bricks, {"--memory", fmt::format("{}", *settings.bricks->memory_bytes)});
    if (settings.bricks->bounces)
    {
        bricks.depends_on_processor = true;
        addFlags(bricks, {"--bake", fmt::format("{}", *settings.bricks->bounces)});
    }
    addOutput(bricks, "--stats", kBrickStatistics);
    graph.actions.push_back(std::move(bricks));
    return graph.actions.size() - 1;
}

/// Add the link action.
/// inputs  actions whose parts the link reads, in this order
void addLink(Graph& graph, const std::vector<size_t>& inputs, const CookSettings& settings)
{
    Action link = makeAction("link", settings.sources.size(), settings.output);
    for (const size_t input : inputs)
        addInput(link, sourcePartInput(graph, input));
    const auto hasVisibility = [](const SourceSettings& arguments)
    { return arguments.visibility.has_value(); };
    if (std::any_of(settings.settings_of_source.begin(), settings.settings_of_source.end(), hasVisibility))
    {
        const size_t specular = addSpecular(graph, settings);
        addFlags(link, {"--specular"});
        addInput(link, partInput(graph, specular));
    }
    if (settings.bricks)
    {
        const size_t bricks = addBricks(graph, settings);
        addFlags(link, {"--bricks"});
        addInput(link, partInput(graph, bricks));
    }
    addOutput(link, "-o", "pack.hearth");
    graph.actions.push_back(std::move(link));
}

} // namespace

Result<Graph> makeCookGraph(const CookSettings& settings)
{
    HEARTH_ASSERT(settings.settings_of_source.empty() ||
                  settings.settings_of_source.size() == settings.sources.size());
    HEARTH_ASSERT(settings.lods_of_source.empty() ||
                  settings.lods_of_source.size() == settings.sources.size());
    Graph graph;
    graph.source_count = settings.sources.size();
    std::vector<size_t> inputs;
    for (size_t i = 0; i < settings.sources.size(); ++i)
    {
        HEARTH_ASSIGN_OR_RETURN(const std::vector<size_t> parts, addSource(graph, i, settings));
        inputs.insert(inputs.end(), parts.begin(), parts.end());
    }
    addLink(graph, inputs, settings);
    addEstimates(graph);
    return graph;
}

} // namespace hearth::graph
