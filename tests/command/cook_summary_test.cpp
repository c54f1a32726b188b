// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_summary.h"

#include "pipelines/command/shell/messages.h"

#include <gtest/gtest.h>

namespace hearth::command
{

using Lines = std::vector<std::string>;

TEST(CookSummary, repeatsFailuresThatOtherLinesCameAfter)
{
    CookSummary summary;
    const auto fail = [&](const std::string& line)
    {
        printMessage(line);
        summary.addFailure(line);
    };
    EXPECT_EQ(summary.lines(), Lines());
    printMessage("before");
    fail("a.glb: error: is bad [E1101]");
    fail("b.glb: error: is bad [E1101]");
    EXPECT_EQ(summary.lines(), Lines()) << "nobody can overlook them";
    printMessage("after");
    EXPECT_EQ(summary.lines(),
              (Lines{"all failures again:", "a.glb: error: is bad [E1101]", "b.glb: error: is bad [E1101]"}));
}

TEST(CookSummary, countsWarningsByTheirCodes)
{
    CookSummary summary;
    for (const char* source : {"a.glb", "b.glb"})
    {
        summary.addWarning(source + std::string(": warning: no wood.png [W1302] hint: find it"), false);
        summary.addWarning(source + std::string("|/extras: warning: left out [W1400]"), true);
    }
    summary.addWarning("c.glb: warning: left out [W1400]", false);
    EXPECT_EQ(
        summary.lines(),
        (Lines{
            "3 warnings: 2 W1302 (an image is missing; a placeholder is drawn), 1 W1400 (a part of the "
            "source is not kept)",
            "2 warnings of unchanged sources, as in the cook before: 2 W1400; hearth cook -v lists them"}));
}

} // namespace hearth::command
