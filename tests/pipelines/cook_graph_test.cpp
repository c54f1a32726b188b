// Tests the action graph of a cook, and its JSON.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/graph/causes.h"
#include "pipelines/graph/cook_graph.h"
#include "pipelines/graph/journal.h"
#include "pipelines/graph/plan_json.h"
#include "pipelines/graph/skip_source.h"

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
                                  {"clusters.influences", {"4", ""}},
                                  {"visibility.enabled", {"true", ""}},
                                  {"visibility.quality", {"\"draft\"", ""}},
                                  {"visibility.occluders", {"\"asset\"", ""}},
                                  {"visibility.distance", {"2.5", ""}},
                                  {"visibility.power", {"1", ""}},
                                  {"visibility.poses", {"[\"Run@0.5,1\",\"Walk\"]", ""}},
                                  {"visibility.refine", {"true", ""}}}};
    settings.values_of_pack = {{"bricks.enabled", {"true", ""}},
                               {"bricks.voxel_size", {"0.25", ""}},
                               {"bricks.memory", {"1048576", ""}},
                               {"bricks.bake", {"2", ""}}};
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
    settings.values_of_pack = {{"bricks.enabled", {"true", ""}}};
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
              (Words{"bin/hearth-link", "{import.part}", "{clusters.part}", "{textures.part}",
                     "{skinning.part}", "{import.part}", "{clusters.part}", "{textures.part}",
                     "{skinning.part}", "--bricks", "{bricks.part}", "-o", "{pack.hearth}", "--skipped",
                     R"({"source":"b.obj","code":"E1101","pointer":"line 3","text":"is bad"})"}));
    const std::vector<Words> before = getCommands(whole);
    EXPECT_TRUE(std::equal(before.begin(), before.end() - 2, commands.begin()));
    // the parts that remain are those of the other sources, in order
    for (const Input& input : graph.actions.back().inputs)
        EXPECT_NE(input.action == kNoAction ? 0 : graph.actions[input.action].source, 1u);
}

TEST(CookGraph, passesSettingsToEveryCooker)
{
    const std::vector<Words> commands = getCommands(makeCookGraph(allSettings()).value());
    ASSERT_EQ(commands.size(), 8u);
    EXPECT_EQ(commands[0],
              (Words{"bin/hearth-import", "props/a.obj", "--lod", "1=low/a=b.obj", "--lod", "2=b.obj", "-o",
                     "{import.part}", "--set", "animation.error=0.5", "--stats", "{import.json}"}));
    EXPECT_EQ(commands[1], (Words{"bin/hearth-clusters", "{import.part}", "-o", "{clusters.part}", "--set",
                                  "clusters.influences=4", "--no-discrete-lods", "--visibility", "--stats",
                                  "{clusters.json}"}));
    EXPECT_EQ(commands[2], (Words{"bin/hearth-textures", "{import.part}", "-o", "{textures.part}",
                                  "--max-size", "64", "--stats", "{textures.json}"}));
    EXPECT_EQ(commands[3],
              (Words{"bin/hearth-skinning", "{import.part}", "{clusters.part}", "-o", "{skinning.part}"}));
    EXPECT_EQ(commands[4], (Words{"bin/hearth-visibility",
                                  "{import.part}",
                                  "{clusters.part}",
                                  "-o",
                                  "{visibility.part}",
                                  "--quality",
                                  "draft",
                                  "--occluders",
                                  "asset",
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
    EXPECT_EQ(commands[5], (Words{"bin/hearth-specular", "-o", "{specular.part}"}));
    EXPECT_EQ(commands[6], (Words{"bin/hearth-bricks", "{import.part}", "{clusters.part}", "{textures.part}",
                                  "-o", "{bricks.part}", "--voxel-size", "0.25", "--memory", "1048576",
                                  "--bake", "2", "--stats", "{bricks.json}"}));
    EXPECT_EQ(commands[7], (Words{"bin/hearth-link", "{import.part}", "{visibility.part}", "{textures.part}",
                                  "{skinning.part}", "--specular", "{specular.part}", "--bricks",
                                  "{bricks.part}", "-o", "{pack.hearth}"}));
}

TEST(CookGraph, linksEverySourceInOrder)
{
    CookSettings settings;
    settings.sources = {"a.obj", "b.obj", "a.obj"};
    settings.output = "all.hearth";
    const Graph graph = makeCookGraph(settings).value();
    ASSERT_EQ(graph.actions.size(), 13u);
    const Action& link = graph.actions.back();
    EXPECT_EQ(link.cooker, "link");
    EXPECT_EQ(link.subject, "all.hearth");
    ASSERT_EQ(link.inputs.size(), 12u);
    for (size_t i = 0; i < link.inputs.size(); ++i)
        EXPECT_EQ(graph.actions[link.inputs[i].action].source, i / 4);
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
    const Action& visibility = now.actions[4];
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
