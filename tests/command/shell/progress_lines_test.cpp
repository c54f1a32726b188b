// Tests the progress lines of cooks in logs, with a clock that the test sets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/progress_lines.h"

#include <gtest/gtest.h>

namespace hearth::command
{

namespace
{

using graph::Action;
using graph::ActionOutcome;
using graph::Outcome;

/// Two sources with three cookers each, and the pack.
graph::Graph villageGraph()
{
    graph::Graph graph;
    graph.source_count = 2;
    const auto add = [&](const char* cooker, size_t source, const char* subject)
    {
        Action action;
        action.cooker = cooker;
        action.source = source;
        action.subject = subject;
        action.outputs = {std::string(cooker) + ".part"};
        graph.actions.push_back(action);
    };
    for (const char* cooker : {"import", "textures", "clusters"})
    {
        add(cooker, 0, "house.glb");
        add(cooker, 1, "tree.glb");
    }
    add("link", 2, "village.hearth");
    return graph;
}

class Progress : public ::testing::Test
{
protected:
    const Action& action(const std::string& cooker, size_t source) const
    {
        for (const Action& action : graph.actions)
            if (action.cooker == cooker && action.source == source)
                return action;
        ADD_FAILURE() << cooker << " of " << source;
        return graph.actions.front();
    }

    void end(const std::string& cooker, size_t source, Outcome ending = Outcome::cooked)
    {
        ActionOutcome outcome;
        outcome.ending = ending;
        outcome.result.seconds = 1.5;
        progress.ended(action(cooker, source), outcome);
    }

    void run(const std::string& cooker, size_t source)
    {
        progress.starting(action(cooker, source));
        end(cooker, source);
    }

    graph::Graph graph = villageGraph();
    std::vector<std::string> lines;
    std::chrono::steady_clock::time_point now{};
    ProgressLines progress{graph, [this](const std::string& line) { lines.push_back(line); },
                           [this] { return now; }};
};

using Lines = std::vector<std::string>;

} // namespace

TEST_F(Progress, hasALineForEachSourceThatIsDone)
{
    for (const char* cooker : {"import", "textures"})
        for (const size_t source : {0u, 1u})
            run(cooker, source);
    EXPECT_EQ(lines, Lines()) << "no line for a cooker";
    end("clusters", 0, Outcome::cached);
    EXPECT_EQ(lines, Lines{"source        3.00 s    2 cookers  house.glb"});
    run("clusters", 1);
    run("link", 2);
    EXPECT_EQ(lines, (Lines{"source        3.00 s    2 cookers  house.glb",
                            "source        4.50 s    3 cookers  tree.glb"}))
        << "the pack's line is the last of the cook";
}

TEST_F(Progress, saysNothingOfSourcesThatAreCachedOrHaveFailed)
{
    for (const char* cooker : {"import", "textures", "clusters"})
        end(cooker, 0, Outcome::cached);
    run("import", 1);
    end("textures", 1, Outcome::failed);
    run("clusters", 1);
    EXPECT_EQ(lines, Lines());
}

TEST_F(Progress, aResultThatTheCacheHasLostGivesNoSecondLine)
{
    for (const char* cooker : {"import", "textures", "clusters"})
        run(cooker, 0);
    EXPECT_EQ(lines.size(), 1u);
    run("import", 0);
    EXPECT_EQ(lines.size(), 1u);
}

TEST_F(Progress, saysEveryTenSecondsHowFarItIs)
{
    progress.starting(action("import", 0));
    progress.starting(action("import", 1));
    const auto passes = [&](int milliseconds)
    {
        now += std::chrono::milliseconds(milliseconds);
        progress.waiting();
    };
    passes(9999);
    EXPECT_EQ(lines, Lines());
    passes(1);
    EXPECT_EQ(lines, Lines{"so far       10.00 s       0 of 7  import house.glb, import tree.glb"});
    lines.clear();
    passes(1000);
    end("import", 0);
    passes(8999);
    EXPECT_EQ(lines, Lines());
    passes(1);
    EXPECT_EQ(lines, Lines{"so far       20.00 s       1 of 7  import tree.glb"});
}

TEST_F(Progress, namesNoMoreThanFitsOnALine)
{
    for (const char* cooker : {"import", "textures", "clusters"})
        for (const size_t source : {0u, 1u})
            progress.starting(action(cooker, source));
    now += kProgressInterval;
    progress.waiting();
    EXPECT_EQ(lines, Lines{"so far       10.00 s       0 of 7  import house.glb, import tree.glb, textures "
                           "house.glb and 3 more"});
}

} // namespace hearth::command
