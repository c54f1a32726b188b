// Tests plans of distributed builds: distribution of sources over shards, the shard of a job, and the
// validation of plans.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/farm/emit.h"
#include "pipelines/farm/measurements.h"
#include "pipelines/farm/plan.h"
#include "pipelines/farm/shard_index.h"
#include "pipelines/farm/shard_record.h"
#include "pipelines/farm/shards.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <numeric>
#include <random>

namespace hearth::farm
{

namespace
{

using test::Sandbox;

double findLongest(const Shards& shards, const std::vector<double>& seconds)
{
    double longest = 0;
    for (const std::vector<size_t>& shard : shards)
        longest = std::max(longest, std::accumulate(shard.begin(), shard.end(), 0.0,
                                                    [&](double sum, size_t s) { return sum + seconds[s]; }));
    return longest;
}

/// Return the minimum time of the longest shard, by trying every distribution.
double findBest(const std::vector<double>& seconds, size_t count)
{
    double best = std::numeric_limits<double>::infinity();
    std::vector<size_t> shard_of(seconds.size(), 0);
    for (;;)
    {
        std::vector<double> load(count);
        for (size_t i = 0; i < seconds.size(); ++i)
            load[shard_of[i]] += seconds[i];
        best = std::min(best, *std::max_element(load.begin(), load.end()));
        size_t digit = 0;
        while (digit < shard_of.size() && ++shard_of[digit] == count)
            shard_of[digit++] = 0;
        if (digit == shard_of.size())
            return best;
    }
}

/// Folder with sources and cookers, and a plan for them.
class PlanFile : public ::testing::Test
{
protected:
    PlanFile()
    {
        for (const char* name : {"a.obj", "b.obj", "c.obj", "wood.png"})
            folder.write(name, name);
        for (const char* cooker :
             {"import", "textures", "estimates", "budget", "texels", "clusters", "skinning", "neighbours",
              "visibility", "specular", "probe", "bricks", "receivers", "reflections", "link"})
            folder.write(std::string("hearth-") + cooker, cooker, true);
    }

    Result<Plan> make(const Request& request, const ShardingOptions& sharing = {2, {}})
    {
        graph::FileHashes hashes(folder.path());
        graph::ActionCache actions(cache, hashes, folder.path());
        return makePlan(request, folder.path(), sharing, folder.path(), actions, hashes);
    }

    Request request()
    {
        const Assignments settings{"clusters.influences=4", "visibility.mode=on"};
        return {{folder / "a.obj", folder / "b.obj", folder / "c.obj"},
                {{}, {"1=" + folder / "b.obj"}, {}},
                {settings, settings, settings},
                {"bricks.voxel_size=2"}};
    }

    Status check(const Plan& plan, const std::vector<size_t>& sources)
    {
        graph::FileHashes hashes(folder.path());
        graph::ActionCache actions(cache, hashes, folder.path());
        return checkPlan(plan, sources, folder.path(), actions, hashes);
    }

    Sandbox folder;
    cache::Cache cache{{}, [](const Error&) {}};
};

} // namespace

TEST(Shards, takeAtMostFourThirdsOfTheBest)
{
    std::mt19937 random(5);
    for (int round = 0; round < 40; ++round)
    {
        const size_t count = 2 + random() % 2;
        std::vector<double> seconds(1 + random() % 8);
        for (double& s : seconds)
            s = 1 + static_cast<double>(random() % 100);
        const Shards shards = distribute(seconds, count);
        ASSERT_EQ(shards.size(), count);
        const double bound = 4.0 / 3 - 1 / (3 * static_cast<double>(count));
        EXPECT_LE(findLongest(shards, seconds), findBest(seconds, count) * bound * (1 + 1e-12));
    }
}

TEST(Shards, haveEachSourceOnceAndInOrder)
{
    EXPECT_EQ(distribute(std::vector<double>{5, 4, 3, 3, 3}, 2), (Shards{{0, 3}, {1, 2, 4}}));
    EXPECT_EQ(distribute(std::vector<double>{1, 1, 1}, 2), (Shards{{0, 2}, {1}})) << "the first of equals";
    EXPECT_EQ(distribute(std::vector<double>{1}, 3), (Shards{{0}, {}, {}}));
}

TEST(Shards, areAsManyAsHaveAMinuteToDo)
{
    EXPECT_EQ(chooseShardCount(std::vector<double>{1, 2}), 1u);
    EXPECT_EQ(chooseShardCount(std::vector<double>(10, 30.0)), 5u);
    EXPECT_EQ(chooseShardCount(std::vector<double>{1000, 1000}), 2u) << "a source is not shared";
    EXPECT_EQ(chooseShardCount({}), 1u);
}

TEST(ShardIndex, isWhatIsSaidFirst)
{
    using Variables = std::map<std::string, std::string>;
    const auto index = [](const std::string& option, const Variables& variables)
    {
        const Result<size_t> shard =
            shardIndex(option, 7,
                       [&](const char* name) -> const char*
                       {
                           const auto found = variables.find(name);
                           return found == variables.end() ? nullptr : found->second.c_str();
                       });
        return shard.ok() ? static_cast<int>(*shard) : -exitCode(shard.error());
    };
    Variables all{{"SLURM_ARRAY_TASK_ID", "3"},
                  {"SLURM_ARRAY_TASK_MIN", "1"},
                  {"SLURM_ARRAY_TASK_MAX", "7"},
                  {"JOB_COMPLETION_INDEX", "3"},
                  {"AWS_BATCH_JOB_ARRAY_INDEX", "4"},
                  {"SGE_TASK_ID", "7"},
                  {"SGE_TASK_FIRST", "2"},
                  {"SGE_TASK_LAST", "8"},
                  {"PBS_ARRAY_INDEX", "6"}};
    EXPECT_EQ(index("1/7", all), 1);
    EXPECT_EQ(index("", all), 2) << "Slurm, counted from 1";
    all.erase("SLURM_ARRAY_TASK_ID");
    EXPECT_EQ(index("", all), 3);
    all.erase("JOB_COMPLETION_INDEX");
    EXPECT_EQ(index("", all), 4);
    all.erase("AWS_BATCH_JOB_ARRAY_INDEX");
    EXPECT_EQ(index("", all), 5) << "Grid Engine, counted from 2";
    all["SGE_TASK_ID"] = "undefined";
    EXPECT_EQ(index("", all), 6);
    EXPECT_EQ(index("", {}), -2);
    for (const char* wrong : {"7/7", "0/6", "1", "1/", "/7", "-1/7", "1/7x", "1 /7", "x"})
        EXPECT_EQ(index(wrong, all), -2) << wrong;
    EXPECT_EQ(index("", {{"JOB_COMPLETION_INDEX", "7"}}), -2);
    EXPECT_EQ(index("", {{"PBS_ARRAY_INDEX", "two"}}), -2);
    // part of an array that is submitted again must not be taken for the whole array
    EXPECT_EQ(
        index("",
              {{"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_MIN", "3"}, {"SLURM_ARRAY_TASK_MAX", "5"}}),
        -2);
    EXPECT_EQ(index("", {{"SLURM_ARRAY_TASK_ID", "2"},
                         {"SLURM_ARRAY_TASK_MIN", "0"},
                         {"SLURM_ARRAY_TASK_MAX", "6"},
                         {"SLURM_ARRAY_TASK_STEP", "2"}}),
              -2);
}

TEST_F(PlanFile, isSharedOutByTimesOfBefore)
{
    const Request asked = request();
    const auto asset = [&](size_t source, double import_seconds, double clusters_seconds)
    {
        return Json{
            {"source", asked.sources[source]},
            {"stages",
             {{{"stage", "import"},
               {"state", "cooked"},
               {"seconds", import_seconds},
               {"peak_rss_bytes", 300}},
              {{"stage", "clusters"},
               {"state", "cached"},
               {"seconds", clusters_seconds},
               {"peak_rss_bytes", 3000}},
              {{"stage", "visibility"}, {"state", "failed"}, {"seconds", 1e6}, {"peak_rss_bytes", 1}}}}};
    };
    const Json report{
        {"schema", "hearth.report/1"},
        {"assets", {asset(0, 20, 80), asset(2, 5, 25)}},
        {"link", {{"stage", "link"}, {"state", "cooked"}, {"seconds", 7}, {"peak_rss_bytes", 30}}}};
    const auto measured = readMeasurements(report.dump(), "report.json");
    ASSERT_TRUE(measured.ok());
    EXPECT_EQ(countMeasured(*measured, asked.sources), 2u);

    const auto by_size = make(asked, {std::nullopt, {}});
    const auto by_times = make(asked, {std::nullopt, *measured});
    ASSERT_TRUE(by_size.ok() && by_times.ok());
    EXPECT_EQ(by_size->shards, (Shards{{0, 1, 2}})) << "small files";
    EXPECT_EQ(by_times->shards, (Shards{{0}, {1, 2}})) << "130 s and a bit";
    EXPECT_TRUE(parsePlan(planText(*by_times), "plan.json").ok());
    ASSERT_EQ(by_times->graph.actions.size(), by_size->graph.actions.size());
    for (size_t i = 0; i < by_times->graph.actions.size(); ++i)
    {
        const graph::Action& action = by_times->graph.actions[i];
        const graph::Estimate& before = by_size->graph.actions[i].estimate;
        const bool is_known =
            action.cooker == "link" ||
            ((action.cooker == "import" || action.cooker == "clusters") && action.source != 1);
        if (!is_known)
        {
            EXPECT_EQ(action.estimate.seconds, before.seconds) << action.cooker << " " << action.subject;
            EXPECT_EQ(action.estimate.memory_bytes, before.memory_bytes) << action.cooker;
        }
        else if (action.cooker == "clusters")
        {
            EXPECT_EQ(action.estimate.seconds, action.source == 0 ? 80 : 25);
            EXPECT_EQ(action.estimate.memory_bytes, 4000u) << "a third more";
        }
        else
            EXPECT_EQ(action.estimate.memory_bytes, action.cooker == "link" ? 40u : 400u);
    }
}

TEST(Measured, isOfReportsAlone)
{
    const auto findFault = [](const std::string& report)
    {
        const auto measured = readMeasurements(report, "report.json");
        if (measured.ok())
            return std::string("taken");
        EXPECT_EQ(exitCode(measured.error()), 65);
        EXPECT_EQ(measured.error().file, "report.json");
        return measured.error().detail;
    };
    const auto withStage = [](const std::string& seconds, const std::string& bytes)
    {
        return R"({"schema": "hearth.report/1", "assets": [{"source": "a", "stages": [{"stage": "import", "state":
                  "cooked", "seconds": )" +
               seconds + R"(, "peak_rss_bytes": )" + bytes + "}]}]}";
    };
    EXPECT_EQ(findFault(withStage("1", "1")), "taken");
    EXPECT_EQ(findFault(withStage("-1", "1")), "has a time or memory that no machine has");
    EXPECT_EQ(findFault(withStage("1e300", "1")), "has a time or memory that no machine has");
    EXPECT_EQ(findFault(withStage("1", "-1")), "has a time or memory that no machine has");
    EXPECT_EQ(findFault(withStage("1", "1e17")), "has a time or memory that no machine has");
    EXPECT_TRUE(findFault(withStage("\"1\"", "1")).starts_with("is no report of hearth cook: "));
    EXPECT_TRUE(findFault(R"({"schema": "hearth.report/1"})").starts_with("is no report of hearth cook: "));
    for (const char* other : {"", "[]", "{}", R"({"schema": "hearth.plan/1"})"})
        EXPECT_EQ(findFault(other), "is no report that hearth cook --report wrote as JSON") << other;
}

TEST_F(PlanFile, comesBack)
{
    const Result<Plan> plan = make(request());
    ASSERT_TRUE(plan.ok()) << formatMessage(plan.error());
    const std::string text = planText(*plan);
    EXPECT_EQ(planText(*make(request())), text) << "the same plan";
    const Result<Plan> again = parsePlan(text, "plan.json");
    ASSERT_TRUE(again.ok()) << formatMessage(again.error());
    EXPECT_EQ(planText(*again), text);
    EXPECT_EQ(again->hash_of_file.size(), 3u);
    EXPECT_EQ(again->shards.size(), 2u);
    EXPECT_FALSE(again->processor.empty()) << "rays are traced";
}

TEST_F(PlanFile, isRefusedWhereItIsNotWhatACookWouldBe)
{
    const std::string text = planText(*make(request()));
    const auto changed = [&](const std::function<void(Json&)>& change)
    {
        Json plan = Json::parse(text).value();
        change(plan);
        return plan.dump();
    };
    const auto getPlace = [](const std::string& plan)
    {
        const Result<Plan> parsed = parsePlan(plan, "plan.json");
        if (parsed.ok())
            return std::string("taken");
        EXPECT_EQ(exitCode(parsed.error()), 65);
        EXPECT_EQ(parsed.error().file, "plan.json");
        return parsed.error().where;
    };
    EXPECT_EQ(getPlace(changed([](Json&) {})), "taken");

    struct Row
    {
        std::string where;
        std::function<void(Json&)> change;
    };
    const std::vector<Row> rows{
        // programs and command lines
        {"/actions/0/cooker", [](Json& p) { p["actions"][0]["cooker"] = "../../bin/sh"; }},
        {"/actions/0/words/0", [](Json& p) { p["actions"][0]["words"][0] = "-o/etc/passwd"; }},
        {"/actions/2/words/-", [](Json& p) { p["actions"][2]["words"].push_back("--debug-output"); }},
        {"/actions/0/outputs/0", [](Json& p) { p["actions"][0]["outputs"][0] = "../../../etc/cron.d/x"; }},
        {"/actions/0/inputs/0/path", [](Json& p) { p["actions"][0]["inputs"][0]["path"] = "/etc/shadow"; }},
        {"/actions/0/inputs/0", [](Json& p) { p["actions"][0]["inputs"] = Json::array(); }},
        {"/actions/0/subject", [](Json& p) { p["actions"][0].erase("subject"); }},
        {"/cook", [](Json& p) { p["cook"]["settings"][0].push_back("clusters.output=1"); }},
        {"/cook", [](Json& p) { p["cook"]["settings"][0].push_back("clusters.influences=2"); }},
        {"/cook", [](Json& p) { p["cook"]["settings"].erase(0); }},
        {"/cook", [](Json& p) { p["cook"]["sources"][0] = "--depfile=/etc/passwd"; }},
        {"/cook", [](Json& p) { p["cook"]["settings"][0][0] = "visibility.poses=--debug-output"; }},
        {"/cook", [](Json& p) { p["cook"]["settings"][0][0] = "visibility.poses=['-o']"; }},
        {"/cook", [](Json& p) { p["cook"]["pack"][0] = "--launcher=sh"; }},
        {"/cook", [](Json& p) { p["cook"]["lods"][0].push_back("1=-o"); }},
        {"/cookers", [](Json& p) { p["cookers"]["sh"] = Json(p["cookers"]["import"]); }},
        {"/cookers", [](Json& p) { p["cookers"].erase("link"); }},
        {"/cookers", [](Json& p) { p["cookers"]["import"] = "whatever"; }},
        // contents
        {"/files", [](Json& p) { p["files"][p["files"].items()[0].key] = "x"; }},
        {"/files", [](Json& p) { p["files"].erase(p["files"].items()[0].key); }},
        {"/files", [](Json& p) { p["files"]["more.obj"] = std::string(64, 'a'); }},
        {"/found",
         [](Json& p) {
             p["found"] = {{{"action", 1}, {"files", {{"source/x", "absent"}}}}};
         }},
        {"/processor", [](Json& p) { p.erase("processor"); }},
        {"/folder", [](Json& p) { p["folder"] = "relative"; }},
        // shards
        {"/shards", [](Json& p) { p["shards"] = Json::array(); }},
        {"/shards",
         [](Json& p) {
             p["shards"] = {{0, 1}, {1, 2}};
         }},
        {"/shards",
         [](Json& p) {
             p["shards"] = {{0, 1}};
         }},
        {"/shards",
         [](Json& p) {
             p["shards"] = {{2, 1, 0}};
         }},
        {"/shards",
         [](Json& p) {
             p["shards"] = {{0, 1, 2, 3}};
         }},
        // numbers
        {"/actions", [](Json& p) { p["actions"][0]["estimate"]["memory_bytes"] = -1; }},
        {"/actions", [](Json& p) { p["actions"][0]["estimate"]["seconds"] = -1; }},
        {"/actions", [](Json& p) { p["actions"][0]["estimate"].erase("seconds"); }},
        {"/actions", [](Json& p) { p["actions"] = Json::array(); }},
        {"/sources", [](Json& p) { p["sources"] = 4; }},
        {"/schema", [](Json& p) { p["schema"] = "hearth.plan/2"; }},
        {"/run", [](Json& p) { p["run"] = "rm"; }},
        {"/cook/run", [](Json& p) { p["cook"]["run"] = "rm"; }},
        {"", [](Json& p) { p.erase("shards"); }},
        {"", [](Json& p) { p.erase("cook"); }},
        {"", [](Json& p) { p["folder"] = 7; }},
        {"/shards", [](Json& p) { p["shards"][0][0] = -1; }},
        {"", [](Json& p) { p["cook"]["sources"][0] = std::string("a.obj\0.exe", 10); }},
    };
    for (const Row& row : rows)
        EXPECT_EQ(getPlace(changed(row.change)), row.where) << "row " << &row - rows.data();
    EXPECT_EQ(getPlace("[]"), "");
    EXPECT_EQ(parsePlan(text.substr(0, text.size() / 2), "plan.json").error().issue, Issue::json_syntax);
    EXPECT_EQ(parsePlan(std::string(100000, '['), "plan.json").error().issue, Issue::json_syntax);
}

TEST_F(PlanFile, isNotCookedFromSomethingElse)
{
    const Plan plan = *make(request());
    EXPECT_TRUE(check(plan, {0, 1, 2}).ok());
    folder.write("b.obj", "edited");
    EXPECT_EQ(check(plan, {0, 1, 2}).error().issue, Issue::plan_stale);
    EXPECT_EQ(check(plan, {1}).error().file, folder / "b.obj");
    EXPECT_TRUE(check(plan, {0, 2}).ok()) << "what others cook is no matter";
    folder.write("b.obj", "b.obj");
    folder.write("hearth-clusters", "another build", true);
    EXPECT_EQ(check(plan, {0}).error().issue, Issue::plan_build);
    folder.write("hearth-clusters", "clusters", true);
    folder.write("hearth-link", "another build", true);
    EXPECT_TRUE(check(plan, {0}).ok()) << "a shard does not link";
    EXPECT_EQ(check(plan, {0, 1, 2}).error().issue, Issue::plan_build);
    folder.write("hearth-link", "link", true);
    Plan of_others = plan;
    of_others.processor = "pdp11";
    EXPECT_EQ(check(of_others, {0}).error().issue, Issue::plan_processor);
    Plan with_texture = plan;
    with_texture.found_of_action[0] = {{"found source/wood.png", plan.hash_of_file.begin()->second}};
    EXPECT_EQ(check(with_texture, {0}).error().issue, Issue::plan_stale);
    EXPECT_NE(check(with_texture, {0}).error().detail.find("wood.png"), std::string::npos);
    std::filesystem::remove(folder / "c.obj");
    EXPECT_EQ(check(plan, {2}).error().issue, Issue::input_missing);
    EXPECT_EQ(make(request()).error().issue, Issue::input_missing);
}

TEST(ShardRecord, comesBack)
{
    ShardRecord record;
    record.exit_code = 65;
    record.seconds = 1.5;
    record.machine = "w1";
    record.errors = {"one", "two\nlines"};
    record.actions = {
        {4, graph::Outcome::cooked, {{{std::string(64, 'a'), 7}, {std::string(64, 'b'), 8}}, {}, 2, 0, 9}},
        {5, graph::Outcome::skipped, {}}};
    const cache::Fields fields = recordFields(record);
    const auto again = parseRecord(fields);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(recordFields(*again), fields);
    EXPECT_EQ(again->actions[0].result.outputs[1].bytes, 8u);
    for (size_t i = 0; i < fields.size(); ++i)
    {
        cache::Fields damaged = fields;
        damaged[i].first = "strange";
        EXPECT_FALSE(parseRecord(damaged).has_value()) << fields[i].first;
    }
    EXPECT_NE(recordKey("h", 1, Step::complete), recordKey("h", 11, Step::complete));
    EXPECT_NE(recordKey("h", 1, Step::complete), recordKey("h", 1, Step::prepare));
}

TEST(ShellQuoted, isOneWordToAShell)
{
    Sandbox folder;
    for (const std::string word :
         {"plain-/_.:=,+@%1", "", "two words", "it's", "'", "$HOME `id` \"x\" \\", "a;b&c|d>e\nf", "*", "~"})
    {
        const test::ProgramEnd end = folder.run({"/bin/sh", "-c", "printf %s " + quoteForShell(word)});
        EXPECT_EQ(end.out, word);
    }
}

} // namespace hearth::farm
