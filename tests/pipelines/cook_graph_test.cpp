// Tests the action graph of a cook, and its JSON.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/graph/causes.h"
#include "pipelines/graph/cook_graph.h"
#include "pipelines/graph/journal.h"
#include "pipelines/graph/lists.h"
#include "pipelines/graph/plan_json.h"
#include "pipelines/graph/skip_source.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hearth::graph
{

namespace
{

using Words = std::vector<std::string>;

CookSettings allSettings()
{
    CookSettings settings;
    settings.sources = {"props/a.obj"};
    settings.output = "out/a.hearth";
    settings.lods_of_source = {{"2=b.obj", "1=low/a=b.obj"}};
    settings.values_of_source = {{{"animation.error", {"0.5", ""}},
                                  {"textures.max_size", {"64", ""}},
                                  {"textures.families", {"[\"astc\",\"bc\"]", ""}},
                                  {"textures.quality", {"\"draft\"", ""}},
                                  {"clusters.influences", {"4", ""}},
                                  {"visibility.mode", {"\"on\"", ""}},
                                  {"visibility.quality", {"\"draft\"", ""}},
                                  {"visibility.occluders", {"\"mesh\"", ""}},
                                  {"visibility.distance", {"2.5", ""}},
                                  {"visibility.power", {"1", ""}},
                                  {"visibility.poses", {"[\"Run@0.5,1\",\"Walk\"]", ""}},
                                  {"visibility.refine", {"true", ""}}}};
    settings.values_of_pack = {{"bricks.mode", {"\"on\"", ""}},
                               {"bricks.voxel_size", {"0.25", ""}},
                               {"bricks.memory", {"1048576", ""}}};
    return settings;
}

/// Return the command line of each action, with files named after their roles.
std::vector<Words> getCommands(const Graph& graph)
{
    std::vector<Words> commands;
    for (const Action& action : graph.actions)
    {
        ActionPaths paths;
        for (const Input& input : action.inputs)
            paths.inputs.push_back(input.action == kNoAction
                                       ? input.path
                                       : "{" + graph.actions[input.action].outputs.front() + "}");
        for (const std::string& output : action.outputs)
            paths.outputs.push_back("{" + output + "}");
        commands.push_back(commandLine(action, "bin", paths));
    }
    return commands;
}

} // namespace

TEST(SkipSource, leavesTheOthersAsTheyAre)
{
    CookSettings settings;
    settings.sources = {"a.obj", "props/b.obj", "c.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"bricks.mode", {"\"on\"", ""}}};
    settings.values_of_source.assign(3, {{"visibility.mode", {"\"off\"", ""}}});
    Graph graph = makeCookGraph(settings).value();
    const Graph whole = graph;
    const std::vector<Failure> failures{
        {65, "props/b.obj|line 3: error: is bad [E1101] hint: mend it", 1, true, false},
        {65, "c.obj: error: is not asked about [E1101]", 2, true, false}};
    skipSource(graph, 1, failures);
    const std::vector<Words> commands = getCommands(graph);
    const size_t bricks = graph.actions.size() - 2;
    EXPECT_EQ(sourcesRead(graph, graph.actions[bricks]), (std::vector<size_t>{0, 2}));
    EXPECT_EQ(sourcesRead(graph, graph.actions.back()), (std::vector<size_t>{0, 2}));
    EXPECT_EQ(graph.actions[bricks].inputs.size(), whole.actions[bricks].inputs.size() / 3 * 2);
    EXPECT_EQ(commands.back(),
              (Words{"bin/hearth-link", "{import.part}", "{clusters.part}", "{texels.part}",
                     "{skinning.part}", "{import.part}", "{clusters.part}", "{texels.part}",
                     "{skinning.part}", "--bricks", "{bricks.part}", "-o", "{pack.hearth}", "--skipped",
                     R"({"source":"b.obj","code":"E1101","pointer":"line 3","text":"is bad"})"}));
    const std::vector<Words> before = getCommands(whole);
    EXPECT_TRUE(std::equal(before.begin(), before.end() - 2, commands.begin()));
    // the parts that remain are those of the other sources, in order
    for (const Input& input : graph.actions.back().inputs)
        EXPECT_NE(input.action == kNoAction ? 0 : graph.actions[input.action].source, 1u);
}

TEST(CookGraph, readsTheFileOfASetting)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"bricks.mode", {"\"off\"", ""}},
                               {"environment.file", {"\"skies/noon.hdr\"", ""}}};
    settings.values_of_source.assign(1, {{"visibility.mode", {"\"off\"", ""}}});
    const Graph graph = makeCookGraph(settings).value();
    const std::vector<Words> commands = getCommands(graph);
    EXPECT_EQ(commands.at(commands.size() - 2),
              (Words{"bin/hearth-probe", "skies/noon.hdr", "-o", "{probe.part}"}));
    EXPECT_EQ(commands.back(), (Words{"bin/hearth-link", "{import.part}", "{clusters.part}", "{texels.part}",
                                      "{skinning.part}", "--probe", "{probe.part}", "-o", "{pack.hearth}"}));
    settings.values_of_pack["environment.file"].text = "\"off\"";
    EXPECT_EQ(makeCookGraph(settings)->actions.size(), graph.actions.size() - 1);
}

TEST(CookGraph, skiesOfSourcesHaveTheSizeOfThePacks)
{
    CookSettings settings;
    settings.sources = {"a.glb"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"environment.sky_size", {"1024", ""}}};
    settings.values_of_source.assign(1, {{"import.sky", {"\"on\"", ""}}});
    EXPECT_EQ(getCommands(makeCookGraph(settings).value()).front(),
              (Words{"bin/hearth-import", "a.glb", "--sky-size", "1024", "-o", "{import.part}", "--sky", "on",
                     "--stats", "{import.json}"}));
    settings.values_of_pack["environment.file"].text = "\"noon.hdr\"";
    settings.values_of_source[0]["import.sky"].text = "\"off\"";
    EXPECT_EQ(getCommands(makeCookGraph(settings).value()).front(),
              (Words{"bin/hearth-import", "a.glb", "-o", "{import.part}", "--sky", "off", "--stats",
                     "{import.json}"}))
        << "an image of the sky imports no source again";
}

TEST(CookGraph, lightsBricksByTheProbeOfTheSky)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"environment.file", {"\"noon.hdr\"", ""}}};
    settings.values_of_source.assign(1, {{"visibility.mode", {"\"off\"", ""}}});
    const std::vector<Words> commands = getCommands(makeCookGraph(settings).value());
    EXPECT_EQ(commands.at(commands.size() - 2),
              (Words{"bin/hearth-bricks", "{import.part}", "{clusters.part}", "{textures.part}", "--probe",
                     "{probe.part}", "-o", "{bricks.part}", "--if-needed", "--stats", "{bricks.json}"}));
}

TEST(CookGraph, bakesReceiversUnderTheProbeOfTheSkyWithBricks)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"environment.file", {"\"noon.hdr\"", ""}},
                               {"receivers.mode", {"\"on\"", ""}},
                               {"receivers.lights", {"3", ""}}};
    settings.values_of_source.assign(1, {{"visibility.mode", {"\"off\"", ""}}});
    const std::vector<Words> commands = getCommands(makeCookGraph(settings).value());
    EXPECT_EQ(commands.front(), (Words{"bin/hearth-import", "a.obj", "--receivers", "16", "-o",
                                       "{import.part}", "--stats", "{import.json}"}));
    EXPECT_EQ(commands.at(commands.size() - 2),
              (Words{"bin/hearth-receivers", "{import.part}", "{clusters.part}", "{textures.part}", "--probe",
                     "{probe.part}", "--bricks", "{bricks.part}", "-o", "{receivers.part}", "--lights", "3",
                     "--stats", "{receivers.json}"}));
    EXPECT_EQ(commands.back(),
              (Words{"bin/hearth-link", "{import.part}", "{clusters.part}", "{texels.part}",
                     "{skinning.part}", "--probe", "{probe.part}", "--bricks", "{bricks.part}", "--receivers",
                     "{receivers.part}", "-o", "{pack.hearth}"}));
}

TEST(CookGraph, linksTheProbesOfTheSkyAndOfTheScene)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"bricks.mode", {"\"off\"", ""}},
                               {"environment.file", {"\"noon.hdr\"", ""}},
                               {"reflections.probes", {"[\"1,2,3\",\"4,5,6\"]", ""}}};
    settings.values_of_source.assign(1, {{"visibility.mode", {"\"off\"", ""}}});
    const std::vector<Words> commands = getCommands(makeCookGraph(settings).value());
    EXPECT_EQ(
        commands.at(commands.size() - 2),
        (Words{"bin/hearth-reflections", "{import.part}", "{clusters.part}", "{textures.part}", "--probe",
               "{probe.part}", "-o", "{reflections.part}", "--at", "1,2,3", "--at", "4,5,6"}));
    EXPECT_EQ(commands.back(), (Words{"bin/hearth-link", "{import.part}", "{clusters.part}", "{texels.part}",
                                      "{skinning.part}", "--probe", "{probe.part}", "--probe",
                                      "{reflections.part}", "-o", "{pack.hearth}"}));
}

TEST(CookGraph, passesSettingsToEveryCooker)
{
    const std::vector<Words> commands = getCommands(makeCookGraph(allSettings()).value());
    ASSERT_EQ(commands.size(), 9u);
    EXPECT_EQ(commands[0],
              (Words{"bin/hearth-import", "props/a.obj", "--lod", "1=low/a=b.obj", "--lod", "2=b.obj", "-o",
                     "{import.part}", "--set", "animation.error=0.5", "--stats", "{import.json}"}));
    EXPECT_EQ(commands[1], (Words{"bin/hearth-clusters", "{import.part}", "-o", "{clusters.part}", "--set",
                                  "clusters.influences=4", "--no-discrete-lods", "--visibility", "--stats",
                                  "{clusters.json}"}));
    EXPECT_EQ(commands[2], (Words{"bin/hearth-textures", "{import.part}", "-o", "{textures.part}",
                                  "--max-size", "64", "--stats", "{textures.json}"}));
    EXPECT_EQ(commands[3], (Words{"bin/hearth-texels", "{import.part}", "{textures.part}", "-o",
                                  "{texels.part}", "--family", "astc", "--family", "bc", "--quality", "draft",
                                  "--stats", "{texels.json}", "--image", "{texels.png}"}));
    EXPECT_EQ(commands[4],
              (Words{"bin/hearth-skinning", "{import.part}", "{clusters.part}", "-o", "{skinning.part}"}));
    EXPECT_EQ(commands[5], (Words{"bin/hearth-visibility",
                                  "{import.part}",
                                  "{clusters.part}",
                                  "-o",
                                  "{visibility.part}",
                                  "--quality",
                                  "draft",
                                  "--occluders",
                                  "mesh",
                                  "--distance",
                                  "2.5",
                                  "--power",
                                  "1",
                                  "--poses",
                                  "Run@0.5,1",
                                  "--poses",
                                  "Walk",
                                  "--refine-cones",
                                  "--no-noise-estimate",
                                  "--stats",
                                  "{visibility.json}",
                                  "--image",
                                  "{visibility.png}"}));
    EXPECT_EQ(commands[6], (Words{"bin/hearth-specular", "-o", "{specular.part}"}));
    EXPECT_EQ(commands[7], (Words{"bin/hearth-bricks", "{import.part}", "{clusters.part}", "{textures.part}",
                                  "-o", "{bricks.part}", "--voxel-size", "0.25", "--memory", "1048576",
                                  "--stats", "{bricks.json}"}));
    EXPECT_EQ(commands[8], (Words{"bin/hearth-link", "{import.part}", "{visibility.part}", "{texels.part}",
                                  "{skinning.part}", "--specular", "{specular.part}", "--bricks",
                                  "{bricks.part}", "-o", "{pack.hearth}"}));
}

TEST(CookGraph, linksProxiesOfTheSourcesThatHaveThem)
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj", "c.obj"};
    settings.output = "all.hearth";
    const settings::Values plain{{"visibility.mode", {"\"off\"", ""}}, {"textures.families", {"[]", ""}}};
    settings.values_of_source.assign(3, plain);
    settings.values_of_source[1]["proxy.from"] = {"\"clean\"", ""};
    settings.values_of_source[1]["proxy.error"] = {"0.01", ""};
    settings.values_of_source[2]["proxy.from"] = {"\"wrap\"", ""};
    settings.values_of_source[2]["proxy.alpha"] = {"0.1", ""};
    settings.values_of_source[2]["proxy.triangles"] = {"300", ""};
    settings.values_of_pack = {{"bricks.mode", {"\"off\"", ""}}};
    const std::vector<Words> commands = getCommands(makeCookGraph(settings).value());
    const auto has = [&](const Words& words) { return std::ranges::find(commands, words) != commands.end(); };
    EXPECT_TRUE(has({"bin/hearth-proxy", "{import.part}", "{clusters.part}", "-o", "{proxy.part}", "--error",
                     "0.01", "--stats", "{proxy.json}"}));
    EXPECT_TRUE(has({"bin/hearth-wrap", "{import.part}", "-o", "{wrap.part}", "--alpha", "0.1", "--triangles",
                     "300", "--stats", "{wrap.json}"}));
    EXPECT_TRUE(has({"bin/hearth-proxy", "{import.part}", "{clusters.part}", "{wrap.part}", "-o",
                     "{proxy.part}", "--triangles", "300", "--stats", "{proxy.json}"}));
    Words link{"bin/hearth-link"};
    for (int source = 0; source < 3; ++source)
        link.insert(link.end(), {"{import.part}", "{clusters.part}", "{textures.part}", "{skinning.part}"});
    link.insert(link.end(),
                {"--proxies", "1={proxy.part}", "--proxies", "2={proxy.part}", "-o", "{pack.hearth}"});
    EXPECT_EQ(commands.back(), link);
}

TEST(CookGraph, takesProxiesOfArtistsFromTheImportUnlessThereIsMoreToDo)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "a.hearth";
    settings.values_of_source = {{{"visibility.mode", {"\"off\"", ""}}}};
    settings.values_of_pack = {{"bricks.mode", {"\"off\"", ""}}};
    const auto find = [&](const std::string& program)
    {
        for (const Words& words : getCommands(makeCookGraph(settings).value()))
            if (words[0] == program)
                return words;
        return Words{};
    };
    settings::Values& values = settings.values_of_source[0];
    EXPECT_TRUE(find("bin/hearth-proxy").empty()) << "by default it costs no step";
    values["proxy.bindings"] = {"true", ""};
    EXPECT_EQ(find("bin/hearth-proxy"),
              (Words{"bin/hearth-proxy", "{import.part}", "{clusters.part}", "-o", "{proxy.part}",
                     "--authored", "--bindings", "--stats", "{proxy.json}"}));
    values["proxy.from"] = {"\"source\"", ""};
    EXPECT_TRUE(find("bin/hearth-proxy").empty());
    const Words import = find("bin/hearth-import");
    EXPECT_NE(std::ranges::search(import, Words{"--proxies", "off"}).begin(), import.end());
    values["import.proxies"] = {"[\"hull.obj\"]", ""};
    EXPECT_FALSE(makeCookGraph(settings).ok()) << "one leaves out what the other names";
    values.erase("proxy.from");
    const Words named = find("bin/hearth-import");
    EXPECT_NE(std::ranges::search(named, Words{"--proxy", "hull.obj"}).begin(), named.end());
}

TEST(CookGraph, givesBricksTheProxiesOfSourcesUnlessLightMayLeakIn)
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj"};
    settings.output = "all.hearth";
    const settings::Values plain{{"visibility.mode", {"\"off\"", ""}}, {"textures.families", {"[]", ""}}};
    settings.values_of_source.assign(2, plain);
    settings.values_of_source[1]["proxy.from"] = {"\"clean\"", ""};
    settings.values_of_pack = {{"bricks.mode", {"\"on\"", ""}}};
    Words bricks{"bin/hearth-bricks"};
    for (int source = 0; source < 2; ++source)
        bricks.insert(bricks.end(), {"{import.part}", "{clusters.part}", "{textures.part}"});
    const auto hasBricks = [&](const Words& proxies)
    {
        Words words = bricks;
        words.insert(words.end(), proxies.begin(), proxies.end());
        words.insert(words.end(), {"-o", "{bricks.part}", "--stats", "{bricks.json}"});
        return std::ranges::count(getCommands(makeCookGraph(settings).value()), words) == 1;
    };
    EXPECT_TRUE(hasBricks({"--proxies", "1={proxy.part}"}));
    settings.values_of_pack["bricks.inside"] = {"\"proxies\"", ""};
    EXPECT_TRUE(hasBricks({"--proxies", "1={proxy.part}"}));
    settings.values_of_pack["bricks.inside"] = {"\"source\"", ""};
    EXPECT_TRUE(hasBricks({}));
}

TEST(CookGraph, givesVisibilityTheProxiesThatItUses)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "a.hearth";
    settings.values_of_source = {{{"proxy.from", {"\"clean\"", ""}}}};
    const auto readsProxies = [&]
    {
        for (const Words& words : getCommands(makeCookGraph(settings).value()))
            if (words[0] == "bin/hearth-visibility")
                return std::ranges::search(words, Words{"--proxies", "{proxy.part}"}).begin() != words.end();
        return false;
    };
    settings::Values& values = settings.values_of_source[0];
    EXPECT_FALSE(readsProxies());
    values["visibility.proxies"] = {"\"fit\"", ""};
    EXPECT_TRUE(readsProxies());
    values["visibility.proxies"] = {"\"all\"", ""};
    EXPECT_TRUE(readsProxies());
    values["proxy.from"] = {"\"authored\"", ""};
    EXPECT_FALSE(readsProxies()) << "those of artists are in the import part";
}

TEST(CookGraph, linksPlainTexturesWhereNoFamilyIsWanted)
{
    CookSettings settings = allSettings();
    settings.values_of_source[0]["textures.families"].text = "[]";
    const std::vector<Words> commands = getCommands(makeCookGraph(settings).value());
    ASSERT_EQ(commands.size(), 8u);
    EXPECT_EQ(commands[7][3], "{textures.part}");
}

TEST(CookGraph, linksEverySourceInOrder)
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj", "a.obj"};
    settings.output = "all.hearth";
    const Graph graph = makeCookGraph(settings).value();
    ASSERT_EQ(graph.actions.size(), 22u) << "six of each source; neighbours, specular, bricks, link";
    const Action& link = graph.actions.back();
    EXPECT_EQ(link.cooker, "link");
    EXPECT_EQ(link.subject, "all.hearth");
    ASSERT_EQ(link.inputs.size(), 14u);
    for (size_t i = 0; i < 12; ++i)
        EXPECT_EQ(graph.actions[link.inputs[i].action].source, i / 4);
}

TEST(CookGraph, readsNeighboursWhereThePackHasOtherSources)
{
    const auto countNeighbours = [](const std::vector<std::string>& sources, const char* occluders)
    {
        CookSettings settings;
        settings.sources = sources;
        settings.values_of_source.assign(
            sources.size(), {{"visibility.occluders", {"\"" + std::string(occluders) + "\"", ""}}});
        const Graph graph = makeCookGraph(settings).value();
        return std::ranges::count_if(graph.actions,
                                     [](const Action& action) { return action.lister != kNoAction; });
    };
    EXPECT_EQ(countNeighbours({"a.obj"}, "pack"), 0);
    EXPECT_EQ(countNeighbours({"a.obj", "b.obj"}, "pack"), 2);
    EXPECT_EQ(countNeighbours({"a.obj", "b.obj"}, "source"), 0);
    EXPECT_EQ(countNeighbours({"a.obj", "b.obj"}, "mesh"), 0);
}

namespace
{

/// Graph of three sources, of which the middle one bakes no visibility.
Graph neighbourGraph()
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj", "c.obj"};
    settings.output = "all.hearth";
    settings.values_of_source.resize(3);
    settings.values_of_source[1] = {{"visibility.mode", {"\"off\"", ""}}};
    return makeCookGraph(settings).value();
}

size_t findAction(const Graph& graph, const std::string& cooker, size_t source)
{
    const auto found = std::ranges::find_if(graph.actions, [&](const Action& action)
                                            { return action.cooker == cooker && action.source == source; });
    return static_cast<size_t>(found - graph.actions.begin());
}

/// Return the inputs of an action as "cooker source", from the first dynamic one.
Words listDynamicInputs(const Graph& graph, const Action& action)
{
    Words inputs;
    for (size_t i = 2; i < action.inputs.size(); ++i)
    {
        const Action& producer = graph.actions[action.inputs[i].action];
        inputs.push_back(producer.cooker + " " + std::to_string(producer.source));
    }
    return inputs;
}

} // namespace

TEST(NeighbourInputs, areThePartsOfTheListedSources)
{
    Graph graph = neighbourGraph();
    const Graph before = graph;
    const size_t lister = findAction(graph, "neighbours", 3);
    const size_t a = findAction(graph, "visibility", 0), c = findAction(graph, "visibility", 2);
    ASSERT_LT(c, graph.actions.size());
    ASSERT_EQ(findAction(graph, "visibility", 1), graph.actions.size());
    for (const Input& input : graph.actions[lister].inputs)
        EXPECT_EQ(graph.actions[input.action].outputs[input.output], "import.json");
    ASSERT_TRUE(applyList(graph, lister, "1 2\n\n1\n"));
    EXPECT_EQ(listDynamicInputs(graph, graph.actions[a]),
              (Words{"import 1", "clusters 1", "import 2", "clusters 2"}));
    EXPECT_EQ(listDynamicInputs(graph, graph.actions[c]), (Words{"import 1", "clusters 1"}));
    const Words command = getCommands(graph)[c];
    EXPECT_EQ(Words(command.end() - 3, command.end()),
              (Words{"--neighbours", "{import.part}", "{clusters.part}"}));
    for (const Action& action : graph.actions)
        for (const Input& input : action.inputs)
            EXPECT_TRUE(input.action == kNoAction ||
                        input.action < static_cast<size_t>(&action - graph.actions.data()));
    // another list replaces it
    ASSERT_TRUE(applyList(graph, lister, "\n\n0\n"));
    EXPECT_EQ(listDynamicInputs(graph, graph.actions[a]), Words());
    EXPECT_EQ(listDynamicInputs(graph, graph.actions[c]), (Words{"import 0", "clusters 0"}));
    removeListed(graph, lister);
    EXPECT_EQ(planJson(graph), planJson(before));
}

TEST(NeighbourInputs, haveTheSameRecordWhateverElseThePackHas)
{
    Graph graph = neighbourGraph();
    CookSettings more;
    more.sources = {"z.obj", "a.obj", "b.obj", "c.obj"};
    more.output = "more.hearth";
    Graph larger = makeCookGraph(more).value();
    ASSERT_TRUE(applyList(graph, findAction(graph, "neighbours", 3), "1\n\n\n"));
    ASSERT_TRUE(applyList(larger, findAction(larger, "neighbours", 4), "\n2\n\n\n"));
    const std::vector<std::string> hashes{"import", "clusters", "import b", "clusters b"};
    EXPECT_EQ(makeRecord(graph.actions[findAction(graph, "visibility", 0)], "v", hashes),
              makeRecord(larger.actions[findAction(larger, "visibility", 1)], "v", hashes));
}

TEST(NeighbourInputs, areRefusedWhereTheListIsMalformed)
{
    Graph graph = neighbourGraph();
    const Graph before = graph;
    const size_t lister = findAction(graph, "neighbours", 3);
    for (const char* list : {"", "\n\n", "\n\n\n\n", "\n\n", "3\n\n\n", "-1\n\n\n", "1  2\n\n\n", "1 \n\n\n",
                             "a\n\n\n", "99999999999999999999\n\n\n", "\n\n1"})
    {
        EXPECT_FALSE(applyList(graph, lister, list)) << list;
        EXPECT_EQ(planJson(graph), planJson(before)) << list;
    }
}

TEST(BudgetWords, areTheListedFormatsOfASourcesOwnTextures)
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj", "c.obj"};
    settings.output = "out.hearth";
    settings.values_of_source.resize(3);
    settings.values_of_source[1]["textures.families"].text = "[]";
    const Graph without = makeCookGraph(settings).value();
    EXPECT_EQ(findAction(without, "estimates", 0), without.actions.size());
    EXPECT_EQ(findAction(without, "budget", 3), without.actions.size());
    settings.values_of_pack = {{"textures.budget", {"50331648", ""}}};
    Graph graph = makeCookGraph(settings).value();
    const Graph before = graph;
    const size_t budget = findAction(graph, "budget", 3);
    ASSERT_LT(budget, graph.actions.size());
    EXPECT_EQ(getCommands(graph)[budget],
              (Words{"bin/hearth-budget", "{estimates.json}", "{estimates.json}", "-o", "{budget.txt}",
                     "--bytes", "50331648", "--stats", "{budget.json}"}))
        << "textures of a source that stay plain are not shared with";
    const size_t a = findAction(graph, "texels", 0), c = findAction(graph, "texels", 2);
    EXPECT_EQ(graph.actions[a].lister, budget);
    EXPECT_EQ(findAction(graph, "texels", 1), graph.actions.size());
    const Words plain = getCommands(graph)[c];
    ASSERT_TRUE(applyList(graph, budget, "\n0=astc-6x6-srgb 1=eac-rg11-unorm\n"));
    EXPECT_EQ(getCommands(graph)[a], getCommands(before)[a]);
    Words expected = plain;
    expected.insert(expected.end(), {"--format", "0=astc-6x6-srgb", "--format", "1=eac-rg11-unorm"});
    EXPECT_EQ(getCommands(graph)[c], expected);
    ASSERT_TRUE(applyList(graph, budget, "0=bc7-srgb\n\n"));
    EXPECT_EQ(getCommands(graph)[c], plain) << "another list replaces it";
    removeListed(graph, budget);
    EXPECT_EQ(planJson(graph), planJson(before));
    for (const char* list : {"", "\n", "\n\n\n", "0=a", "0=a\n1=b", "0=a  1=b\n\n", " 0=a\n\n", "0=a \n\n"})
        EXPECT_FALSE(applyList(graph, budget, list)) << list;
    EXPECT_EQ(planJson(graph), planJson(before));
}

TEST(BudgetWords, areThoseOfASourceAlone)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.output = "out.hearth";
    settings.values_of_pack = {{"textures.budget", {"1000", ""}}};
    const Graph graph = makeCookGraph(settings).value();
    EXPECT_EQ(graph.actions[findAction(graph, "texels", 0)].lister, findAction(graph, "budget", 1));
    const Words link = getCommands(graph).back();
    EXPECT_EQ(Words(link.end() - 2, link.end()), (Words{"--texture-budget", "1000"}));
    EXPECT_EQ(findAction(graph, "neighbours", 1), graph.actions.size());
}

TEST(CookGraph, refusesLevelsOfDetailThatAreNone)
{
    CookSettings settings;
    settings.sources = {"a.obj"};
    settings.lods_of_source = {{"one=b.obj"}};
    EXPECT_EQ(makeCookGraph(settings).error().issue, Issue::usage);
}

TEST(PlanJson, comesBack)
{
    const Graph graph = makeCookGraph(allSettings()).value();
    const std::string json = planJson(graph);
    EXPECT_EQ(Json::parse(json).value()["schema"], "hearth.plan/1");
    const Result<Graph> again = parsePlan(json, "plan.json");
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(planJson(*again), json);
    EXPECT_EQ(getCommands(*again), getCommands(graph));
    // with inputs that are statistics, and dynamic ones
    Graph neighbours = neighbourGraph();
    ASSERT_TRUE(applyList(neighbours, findAction(neighbours, "neighbours", 3), "1 2\n\n1\n"));
    const std::string expanded = planJson(neighbours);
    ASSERT_TRUE(parsePlan(expanded, "plan.json").ok());
    EXPECT_EQ(planJson(*parsePlan(expanded, "plan.json")), expanded);
}

TEST(PlanJson, refusesWhatDoesNotHoldTogether)
{
    const std::string json = planJson(makeCookGraph(allSettings()).value());
    const auto refused = [](const Json& plan)
    {
        const Result<Graph> graph = parsePlan(plan.dump(), "plan.json");
        return !graph.ok() && graph.error().file == "plan.json";
    };
    Json plan = Json::parse(json).value();
    EXPECT_FALSE(refused(plan));
    const auto withChange = [&](const auto& change)
    {
        Json changed = plan;
        change(changed);
        return changed;
    };
    EXPECT_TRUE(refused(withChange([](auto& p) { p["schema"] = "hearth.plan/2"; })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"] = Json::array(); })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1].erase("cooker"); })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1]["inputs"][0]["action"] = 1; })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1]["words"][0]["input"] = 1; })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1]["outputs"] = Json::array(); })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1]["source"] = "no number"; })));
    EXPECT_TRUE(refused(withChange([](auto& p) { p["actions"][1]["words"][0] = 7; })));
    EXPECT_EQ(parsePlan("{", "plan.json").error().issue, Issue::json_syntax);
}

TEST(Journal, comesBack)
{
    Journal journal;
    journal.folder = "/here";
    journal.output = "/there/a.hearth";
    journal.output_cause = "it was not there";
    journal.graph = makeCookGraph(allSettings()).value();
    journal.actions.resize(journal.graph.actions.size());
    journal.actions[1] = {Outcome::failed, {"one", "two"}, {{"cooker", "textures"}, {"word", "tab\t"}}};
    journal.actions[2].ending = Outcome::cached;
    const std::string text = journalText(journal);
    const auto again = parseJournal(text);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(journalText(*again), text);
    EXPECT_EQ(again->actions[1].causes.size(), 2u);
    EXPECT_EQ(again->actions[1].record, journal.actions[1].record);
    EXPECT_EQ(parseJournal(text.substr(0, text.size() - 1)), std::nullopt);
    EXPECT_EQ(parseJournal(""), std::nullopt);
}

TEST(Causes, tellParametersApart)
{
    CookSettings settings = allSettings();
    const Graph before = makeCookGraph(settings).value();
    Journal journal;
    journal.graph = before;
    for (const Action& action : before.actions)
        journal.actions.push_back(
            {Outcome::cooked,
             {},
             makeRecord(action, "v", std::vector<std::string>(action.inputs.size(), "h"))});
    settings.values_of_source[0]["visibility.quality"].text = "\"high\"";
    settings.values_of_source[0].erase("visibility.distance");
    settings.values_of_source[0].erase("visibility.power");
    const Graph now = makeCookGraph(settings).value();
    const Action& visibility = now.actions[5];
    ASSERT_EQ(visibility.cooker, "visibility");
    ActionState state;
    state.record = makeRecord(visibility, "v", {"h", "other"});
    EXPECT_EQ(findCauses(visibility, now, state, journal),
              (std::vector<std::string>{"parameter --quality: draft -> high",
                                        "parameter --distance 2.5: no longer given",
                                        "parameter --power 1: no longer given",
                                        "what clusters made of props/a.obj: its content has changed"}));
    EXPECT_EQ(findCauses(visibility, now, state, std::nullopt),
              std::vector<std::string>{"never cooked into this pack before"});
}

} // namespace hearth::graph
