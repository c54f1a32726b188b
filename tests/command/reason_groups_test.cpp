// Tests how hearth why groups reasons that several sources share.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/reason_groups.h"
#include "pipelines/command/shell/name_list.h"

#include <gtest/gtest.h>

namespace hearth::command
{

namespace
{

graph::Action makeAction(const std::string& cooker, const std::string& subject)
{
    graph::Action action;
    action.cooker = cooker;
    action.subject = subject;
    return action;
}

} // namespace

TEST(ReasonGroups, haveALineForEachReason)
{
    ReasonGroups groups;
    for (const char* source : {"a.glb", "b.glb", "c.glb", "d.glb", "e.glb"})
    {
        groups.add(makeAction("import", source), "", {"forced"});
        groups.add(makeAction("clusters", source), "", {"import runs before it", "it failed last time"});
    }
    groups.add(makeAction("import", "f.glb"), " (failed)", {"forced"});
    groups.add(makeAction("link", "x.hearth"), "", {"forced"});
    EXPECT_EQ(groups.text(), "  import     5 sources (a.glb, b.glb, c.glb and 2 more): forced\n"
                             "  clusters   5 sources (a.glb, b.glb, c.glb and 2 more): import runs before "
                             "it; it failed last time\n"
                             "  import     f.glb (failed): forced\n"
                             "  link       x.hearth: forced\n");
}

TEST(ReasonGroups, areTheSameWhereEachSourceNamesItself)
{
    ReasonGroups groups;
    groups.add(makeAction("import", "a.glb"), "", {"a.glb: its content has changed"});
    groups.add(makeAction("textures", "a.glb"), "", {"what import made of a.glb: its content has changed"});
    groups.add(makeAction("import", "b.glb"), "", {"b.glb: its content has changed"});
    groups.add(makeAction("textures", "b.glb"), "", {"what import made of b.glb: its content has changed"});
    groups.add(makeAction("import", "c.glb"), "", {"wood.png: its content has changed"});
    groups.add(makeAction("skinning", "a.glb"), "", {"a.glb: is read now"});
    EXPECT_EQ(groups.text(),
              "  import     2 sources (a.glb, b.glb): its content has changed\n"
              "  textures   2 sources (a.glb, b.glb): what import made of it: its content has changed\n"
              "  import     c.glb: wood.png: its content has changed\n"
              "  skinning   a.glb: a.glb: is read now\n");
}

TEST(NameList, namesTheFirstFew)
{
    EXPECT_EQ(namesText({}), "");
    EXPECT_EQ(namesText({"a"}), "a");
    EXPECT_EQ(namesText({"a", "b", "c", "d"}), "a, b, c, d");
    EXPECT_EQ(namesText({"a", "b", "c", "d", "e"}), "a, b, c and 2 more");
}

} // namespace hearth::command
