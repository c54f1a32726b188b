// Tests hearth-view without a display: one line on stderr, and the exit code for a machine that lacks
// something.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/cooked_sample.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>

namespace hearth::roundtrip
{

namespace
{

/// Environment of a machine without a screen, for this process and its children.
class NoDisplay : public testing::Test
{
protected:
    void SetUp() override
    {
        for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_RUNTIME_DIR"})
        {
            if (const char* value = std::getenv(name))
                before_.emplace_back(name, value);
            ::unsetenv(name);
        }
    }

    void TearDown() override
    {
        ::unsetenv("DISPLAY");
        for (const auto& [name, value] : before_)
            ::setenv(name.c_str(), value.c_str(), 1);
    }

    /// The single line that hearth-view writes to stderr.
    std::string view() const
    {
        const ProgramEnd end = runProgram(HEARTH_VIEW_PROGRAM, {sample_.packPath(), "--frames", "1"});
        EXPECT_EQ(end.exit_code, 70);
        EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
        return end.errors;
    }

private:
    const CookedSample& sample_ = cookedSample({"rock", 150000});
    std::vector<std::pair<std::string, std::string>> before_;
};

} // namespace

TEST_F(NoDisplay, isSaidWithWhatToDo)
{
    const std::string said = view();
    EXPECT_NE(said.find("there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set"), std::string::npos)
        << said;
    EXPECT_NE(said.find("[E4007] hint: set DISPLAY"), std::string::npos) << said;
    EXPECT_NE(said.find("hearth-render"), std::string::npos) << said;
}

TEST_F(NoDisplay, namesADisplayThatDoesNotAnswer)
{
    ::setenv("DISPLAY", ":987", 1);
    const std::string said = view();
    EXPECT_NE(said.find("error: there is no display at DISPLAY=:987"), std::string::npos) << said;
    EXPECT_NE(said.find("[E4007]"), std::string::npos) << said;
}

} // namespace hearth::roundtrip
