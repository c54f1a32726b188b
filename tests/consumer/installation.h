// Installs Hearth once for all tests of the program, then moves the installation.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace hearth::test
{

class Installation : public ::testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();

    /// Run a shell command in the folder, in which "prefix" is the installation.
    static ProgramEnd shell(const std::string& command);
    /// Run a shell command that must succeed; return its output on stdout and stderr.
    static std::string run(const std::string& command);

    static Sandbox& folder() { return *folder_; }

private:
    static std::unique_ptr<Sandbox> folder_;
};

} // namespace hearth::test
