// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/messages.h"

#include "formats/base/result.h"
#include "pipelines/command/shell/progress.h"

#include <gtest/gtest.h>

namespace hearth::command
{

TEST(PartsOf, everyMessageComesApartAsItWasPutTogether)
{
    for (const Error& error :
         {Error{Issue::gltf_value, "a b.glb", "/meshes/0", "is [bad]: error: so"},
          Error{Issue::usage, "", "", "what"}, Error{Issue::dropped, "a.glb", "", "left out"},
          Error{Issue::profile_key, "hearth.toml", "line 2, column 3, x", "odd [E12] thing"}})
    {
        const MessageParts parts = splitMessage(formatMessage(error));
        const IssueInfo& info = issueInfo(error.issue);
        const bool warns = info.kind == IssueClass::warning;
        EXPECT_EQ(parts.severity, warns ? "warning" : "error");
        EXPECT_EQ(parts.file, error.file);
        EXPECT_EQ(parts.where, error.where);
        EXPECT_EQ(parts.text, error.detail);
        EXPECT_EQ(parts.code, (warns ? "W" : "E") + std::to_string(static_cast<unsigned>(error.issue)));
        EXPECT_EQ(parts.hint, info.hint);
    }
    const MessageParts note = splitMessage("import  0.10 s  a.glb");
    EXPECT_EQ(note.severity, "note");
    EXPECT_EQ(note.text, "import  0.10 s  a.glb");
    EXPECT_EQ(note.code, "");
}

TEST(BarText, growsWithTheWorkAndKeepsToTheLine)
{
    EXPECT_EQ(barText(0, 812, "import a.glb", 60), "[                        ]   0/812  import a.glb");
    EXPECT_EQ(barText(406, 812, "", 60), "[############            ] 406/812  ");
    EXPECT_EQ(barText(812, 812, "", 60), "[########################] 812/812  ");
    for (const size_t columns : {0u, 1u, 10u, 40u, 80u})
        EXPECT_LT(barText(3, 5, std::string(200, 'x'), columns).size(), columns + (columns == 0 ? 1 : 0));
}

} // namespace hearth::command
