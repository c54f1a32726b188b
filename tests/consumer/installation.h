// Hearth, installed: once for all tests of the program, and moved since.
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

    /// Run a command of the shell in the folder, where "prefix" is the installation.
    static ProgramEnd shell(const std::string& command);
    /// The same, which ends well; returns what it wrote to stdout and stderr.
    static std::string run(const std::string& command);

    static Sandbox& folder() { return *folder_; }

private:
    static std::unique_ptr<Sandbox> folder_;
};

} // namespace hearth::test
