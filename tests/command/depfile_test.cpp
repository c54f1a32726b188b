// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/depfile.h"

#include <gtest/gtest.h>

namespace hearth::command
{

namespace
{

std::string escapedName(const std::string& name)
{
    const std::string text = depfileText("out", {name}, {}).value();
    const std::string before = "out: \\\n  ";
    EXPECT_TRUE(text.starts_with(before) && text.ends_with("\n")) << text;
    return text.substr(before.size(), text.size() - before.size() - 1);
}

} // namespace

TEST(Depfile, hasARuleAndAnEmptyOneForEachFileThatWasFound)
{
    EXPECT_EQ(depfileText("a.hearth", {"a.obj", "b.toml"}, {"/x/a.mtl", "/x/a.png"}).value(),
              "a.hearth: \\\n  a.obj \\\n  b.toml \\\n  /x/a.mtl \\\n  /x/a.png\n\n/x/a.mtl:\n\n/x/a.png:\n");
    EXPECT_EQ(depfileText("my packs/a.hearth", {"a.obj"}, {"old $.png"}).value(),
              "my\\ packs/a.hearth: \\\n  a.obj \\\n  old\\ $$.png\n\nold\\ $$.png:\n");
}

// as `gcc -MD` 12 writes these names; the colon as make wants it, which otherwise reads a static pattern
TEST(Depfile, escapesAsMakeReads)
{
    EXPECT_EQ(escapedName("plain-1.0_(a)[b]%@~,+.png"), "plain-1.0_(a)[b]%@~,+.png");
    EXPECT_EQ(escapedName("a b\tc"), "a\\ b\\\tc");
    EXPECT_EQ(escapedName("a#b"), "a\\#b");
    EXPECT_EQ(escapedName("$a$$"), "$$a$$$$");
    EXPECT_EQ(escapedName("c:/a"), "c\\:/a");
    // backslashes count only before blanks
    EXPECT_EQ(escapedName("a\\b"), "a\\b");
    EXPECT_EQ(escapedName("a\\ b\\\\ c"), "a\\\\\\ b\\\\\\\\\\ c");
    EXPECT_EQ(escapedName("\xc3\xbc.png"), "\xc3\xbc.png");
}

TEST(Depfile, refusesALineBreak)
{
    EXPECT_FALSE(depfileText("a\n.hearth", {}, {}).ok());
    EXPECT_FALSE(depfileText("a.hearth", {"b\n"}, {}).ok());
    const auto found = depfileText("a.hearth", {}, {"\nc.png"});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().issue, Issue::usage);
}

} // namespace hearth::command
