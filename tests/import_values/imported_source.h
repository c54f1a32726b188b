// Imports a source by the real hearth-import and compares the part with the source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/import_values/compare_part.h"
#include "tests/support/sandbox.h"

namespace hearth::test
{

/// Return the comparison of a source with its part; one difference if hearth-import fails.
/// path  of the source; absolute, or in the folder
inline Comparison importAndCompare(Sandbox& folder, const std::string& path, const std::string& name)
{
    const std::string part = folder / "source.part";
    // clips as they are: the compression has tests of its own
    const ProgramEnd end =
        folder.run({HEARTH_BIN "/hearth-import", path, "-o", part, "--set", "animation.error=0"});
    if (end.exit_code == 0)
        return comparePart(path.starts_with("/") ? path : folder / path, part, name);
    Comparison failed(name);
    failed.fail("hearth-import ends with " + std::to_string(end.exit_code) + ": " + end.err);
    return failed;
}

} // namespace hearth::test
