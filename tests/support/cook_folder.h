// Runs the real hearth and hearth-link with small scripts in place of the other cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hearth::test
{

/// Folder to cook in. The programs lie elsewhere, so that the folder shows all files that cooking leaves
/// behind.
class Cook : public ::testing::Test
{
protected:
    Cook();

    ProgramEnd cook(std::vector<std::string> arguments,
                    const std::vector<std::string>& environment = {"TMPDIR="})
    {
        return folder.run(command(std::move(arguments)), environment);
    }

    std::vector<std::string> command(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), {programs / "hearth", "cook"});
        return withoutLightCookers(std::move(arguments));
    }

    /// Check that the cook failed with one error line, and left neither outputs nor temporary files.
    void expectFailure(const ProgramEnd& end, int exit_code, const std::string& part_of_message);

    Sandbox programs;
    Sandbox folder;
};

} // namespace hearth::test
