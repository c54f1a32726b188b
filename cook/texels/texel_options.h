// Options of the programs that read a textures part: what its images shall become.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/command_line/command_line.h"
#include "cook/texels/texel_request.h"

#include <string>
#include <vector>

namespace hearth::texels
{

/// Values of the options that all programs of a textures part have.
struct TexelArguments
{
    std::string import_part;
    std::string textures_part;
    std::vector<std::string> families;
    std::string quality = "normal";
    bool strict = false;
    std::vector<std::string> rules; ///< lines of TOML
    size_t jobs = 0;
};

/// Add the options, bound to `arguments`.
void addTexelOptions(cli::CommandLine& app, TexelArguments& arguments);

/// Parse the values of the options. errors: usage, and those of parseTextureRules
Result<TexelOptions> parseTexelOptions(const TexelArguments& arguments);

/// Return the name of the import part without folders: the input's name in JSON.
std::string inputName(const TexelArguments& arguments);

} // namespace hearth::texels
