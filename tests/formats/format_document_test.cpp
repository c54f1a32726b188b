// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/format_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace hearth::test
{

using namespace formats;

namespace
{

std::string document()
{
    std::ifstream file(HEARTH_FORMAT_DOCUMENT, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST(FormatDocument, hasFreshTables)
{
    EXPECT_EQ(document(), regenerateTables(document()))
        << "run build/release/bin/format_dump formats/FORMAT.md";
}

TEST(FormatDocument, hasEveryTable)
{
    const std::string text = document();
    for (const std::string_view name : formatTableNames())
        EXPECT_NE(text.find("<!-- table " + std::string(name) + " -->"), std::string::npos) << name;
}

TEST(FormatDocument, hasNoTableOfAnUnknownName)
{
    const std::string text = document();
    constexpr std::string_view kBegin = "<!-- table ";
    for (size_t at = text.find(kBegin); at != std::string::npos; at = text.find(kBegin, at + 1))
    {
        const size_t name = at + kBegin.size();
        EXPECT_TRUE(formatTable(text.substr(name, text.find(" -->", name) - name)).has_value())
            << text.substr(at, 40);
    }
}

TEST(WithFreshTables, replacesWhatStandsInTheBlocks)
{
    const std::string fresh = regenerateTables("a\n<!-- table Range -->\nstale\n<!-- end -->\nb\n");
    EXPECT_EQ(fresh,
              "a\n<!-- table Range -->\n" + formatTable("Range").value_or("none") + "<!-- end -->\nb\n");
    EXPECT_NE(fresh.find("| 4 | 4 | count | u32 | number of records |"), std::string::npos) << fresh;
    EXPECT_EQ(regenerateTables("no block <!-- table Range -->\n"), "no block <!-- table Range -->\n");
}

} // namespace hearth::test
