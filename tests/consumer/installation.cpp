// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/consumer/installation.h"

#include <filesystem>

namespace hearth::test
{

std::unique_ptr<Sandbox> Installation::folder_;

void Installation::SetUpTestSuite()
{
    folder_ = std::make_unique<Sandbox>();
    run(HEARTH_CMAKE " --install " HEARTH_BUILD_FOLDER " --prefix \"$PWD/first\"");
    // an installation may be moved
    std::filesystem::rename(folder() / "first", folder() / "prefix");
}

void Installation::TearDownTestSuite()
{
    folder_.reset();
}

ProgramEnd Installation::shell(const std::string& command)
{
    return folder().run({"/bin/sh", "-c", command});
}

std::string Installation::run(const std::string& command)
{
    const ProgramEnd end = shell(command);
    EXPECT_EQ(end.exit_code, 0) << command << "\n" << end.out << end.err;
    return end.out + end.err;
}

} // namespace hearth::test
