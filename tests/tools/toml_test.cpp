// Tests the TOML reader: all kinds of value, their line numbers, and errors for invalid text.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/toml.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::tools
{

namespace
{

TomlNode parsed(std::string_view text)
{
    TomlError fault;
    const std::optional<TomlNode> root = parseToml(text, fault);
    EXPECT_TRUE(root.has_value()) << fault.text;
    return root.value_or(TomlNode());
}

} // namespace

TEST(Toml, becomesPlainData)
{
    const TomlNode root = parsed("whole = -3\nnumber = 0.5\ntext = \"\\u00e9\"\nflag = true\n"
                                 "day = 1979-05-27\nnone = nan\nlist = [1, [\"x\"], {b = 2, a = 1}]\n");
    ASSERT_TRUE(root.isTable());
    EXPECT_EQ(root.find("whole")->whole, -3);
    EXPECT_EQ(root.find("number")->number, 0.5);
    EXPECT_EQ(root.find("text")->text, "\xC3\xA9");
    EXPECT_EQ(root.find("flag")->kind, TomlKind::flag);
    EXPECT_TRUE(root.find("flag")->flag);
    EXPECT_EQ(root.find("day")->kind, TomlKind::time);
    EXPECT_TRUE(std::isnan(root.find("none")->number));
    EXPECT_EQ(root.find("else"), nullptr);
    const TomlNode& list = *root.find("list");
    ASSERT_TRUE(list.isArray());
    ASSERT_EQ(list.children.size(), 3u);
    EXPECT_TRUE(list.children[0].isWhole());
    EXPECT_TRUE(list.children[1].children.at(0).isText());
    EXPECT_EQ(list.find("b"), nullptr) << "no table";
    const TomlNode& table = list.children[2];
    EXPECT_EQ(table.children.at(0).key + table.children.at(1).key, "ab") << "by key";
    EXPECT_EQ(table.find("b")->whole, 2);
}

TEST(Toml, knowsNumbersThatADoubleHas)
{
    const TomlNode root = parsed("a = 9007199254740992\nb = 9007199254740993\nc = 1.5\nd = \"1\"\n");
    EXPECT_EQ(root.find("a")->asNumber(), 9007199254740992.0);
    EXPECT_EQ(root.find("b")->asNumber(), std::nullopt);
    EXPECT_EQ(root.find("c")->asNumber(), 1.5);
    EXPECT_EQ(root.find("d")->asNumber(), std::nullopt);
}

TEST(Toml, knowsWhereAValueStands)
{
    const TomlNode root = parsed("[a]\nb = [1,\n  2]\n");
    const TomlNode& list = *root.find("a")->find("b");
    EXPECT_EQ(list.line, 2u);
    EXPECT_EQ(list.column, 5u);
    EXPECT_EQ(list.children.at(1).line, 3u);
    EXPECT_EQ(list.children.at(1).column, 3u);
}

TEST(Toml, saysWhyATextIsNone)
{
    TomlError fault;
    EXPECT_FALSE(parseToml("a = 1\na = 2\n", fault).has_value());
    EXPECT_EQ(fault.line, 2u);
    EXPECT_EQ(fault.column, 5u);
    EXPECT_NE(fault.text.find("cannot redefine"), std::string::npos) << fault.text;
}

} // namespace hearth::tools
