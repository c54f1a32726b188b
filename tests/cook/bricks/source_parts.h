// Makes the parts of a source that the cookers of bricks read, with the real programs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "cook/tools/open_part.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

namespace hearth::bricks
{

/// Make and open the parts of a file in the folder. Failures are those of the test.
inline SourceParts makeSourceParts(test::Sandbox& folder, const std::string& source)
{
    const auto run = [&](const char* program, std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), std::string(HEARTH_BIN "/") + program);
        const test::ProgramEnd end = folder.run(arguments);
        EXPECT_EQ(end.exit_code, 0) << program << ": " << end.err;
    };
    run("hearth-import", {source, "-o", "import.part"});
    run("hearth-clusters", {"import.part", "-o", "clusters.part"});
    run("hearth-textures", {"import.part", "-o", "textures.part"});
    const auto open = [&](const char* part) { return tools::openPart(folder / part).value(); };
    return {open("import.part"), open("clusters.part"), open("textures.part")};
}

} // namespace hearth::bricks
