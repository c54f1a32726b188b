// Programs of OpenImageIO, as a second opinion.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/sandbox.h"

#include <sstream>
#include <string>
#include <vector>

namespace hearth::test
{

/// Run a program of OpenImageIO with words that blanks separate.
inline ProgramEnd runTool(Sandbox& folder, const std::string& words)
{
    std::istringstream stream("/usr/bin/" + words);
    std::vector<std::string> command;
    for (std::string word; stream >> word;)
        command.push_back(word);
    return folder.run(command);
}

/// Return oiiotool's words for an image of noise.
/// range  "min=A:max=B"
/// size   "WIDTHxHEIGHT"
inline std::string noise(const std::string& range, int seed, int channel_count,
                         const std::string& size = "64x64")
{
    return " --pattern noise:type=uniform:" + range + ":seed=" + std::to_string(seed) + " " + size + " " +
           std::to_string(channel_count);
}

} // namespace hearth::test
